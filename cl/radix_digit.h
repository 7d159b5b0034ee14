// The digits of a radix sort that work-groups do together, and the tiles that they do it by.
#ifndef FACET_RADIX_DIGIT_H
#define FACET_RADIX_DIGIT_H

// KEY is uint or ulong. A tile is GROUP work-items times ITEMS keys; GROUP is at least DIGITS.
#ifndef KEY
#define KEY uint
#endif
#ifndef GROUP
#define GROUP 256
#endif
#ifndef ITEMS
#define ITEMS 8
#endif
#define TILE (GROUP * ITEMS)
#define DIGIT_BITS 8u
#define DIGITS 256u

// `mask` leaves the bits that are sorted by, where a digit is the last and has fewer.
static inline uint digit_of(KEY key, uint shift, uint mask) { return (uint)(key >> shift) & mask; }

#endif
