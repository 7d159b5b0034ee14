// What many primitives are put in order by before single work-items build trees over them, in one program (serial.cl).
#define FACET_ANY_PRIMITIVES
#include "morton.cl"
#include "radix_buckets.cl"
#include "radix_serial.cl"
#include "subtrees.cl"
