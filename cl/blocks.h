// What a lane of a block holds that has no triangle (layout.h: TriangleBlock).
//
// It repeats corners of the block's first triangle: a, a, b. No ray meets it, by triangle.h. With the sheared
// corners p, p, q the rough edge functions are P - Q, Q - P and 0 with the same rounded P and Q: of
// opposite signs, unless P = Q. Then the exact ones, which are the difference of the two products' rounding
// errors, are opposite, too, or 0, and so is their sum. Whatever else its slot has is the first triangle's.
#ifndef FACET_BLOCKS_H
#define FACET_BLOCKS_H

#include "vec.h"

// Which corner of the first triangle an absent lane has as its corner k; a and b must not be one point, if
// the triangle has two.
static inline uint absent_corner(uint k, float3 p0, float3 p1) {
  const bool is_point = p0.x == p1.x && p0.y == p1.y && p0.z == p1.z;
  return k < 2u ? 0u : is_point ? 2u : 1u;
}

// Lane's coordinate, of eight corners.
#define LANES(p, axis) \
  (float8)(p[0].axis, p[1].axis, p[2].axis, p[3].axis, p[4].axis, p[5].axis, p[6].axis, p[7].axis)

#endif
