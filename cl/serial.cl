// What single work-items build trees and the wide layout by, in one program: a CPU's driver takes 0.1 s for each,
// however short, and compiles a kernel when it is first launched. What many primitives take before is in
// serial_order.cl.
#define FACET_ANY_PRIMITIVES
#include "blocks.cl"
#include "fold.cl"
#include "order_few.cl"
#include "serial_tree.cl"
