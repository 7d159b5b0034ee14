// What a lane of a block holds that has no triangle (layout.h: TriangleBlock).
//
// It repeats corners of the block's first triangle: a, a, b. No ray meets it, by triangle.h. With the sheared
// corners p, p, q the edge functions are those of (q, p) and (p, q), of opposite signs or both 0, and 0: either some
// differ, or det is 0, for which no triangle is met. Where underflow makes a sign 0, |det| is below 2^-63, and
// t is held, which refuses it.
#ifndef FACET_BLOCKS_H
#define FACET_BLOCKS_H

#include "vec.h"

// Which corner of the first triangle an absent lane has as its corner k; a and b must not be one point, if
// the triangle has two.
static inline uint absent_corner(uint k, float3 p0, float3 p1) {
  const bool is_point = p0.x == p1.x && p0.y == p1.y && p0.z == p1.z;
  return k < 2u ? 0u : is_point ? 2u : 1u;
}

// What a macro makes of each lane. Written out: a loop would go by memory.
#define OF_LANES(of) of(0u), of(1u), of(2u), of(3u), of(4u), of(5u), of(6u), of(7u)

// A coordinate a vector, of eight corners.
static inline void lanes_from(const float4 p[FACET_BLOCK], float8* x, float8* y, float8* z) {
  const float8 a = (float8)(p[0], p[4]), b = (float8)(p[1], p[5]), c = (float8)(p[2], p[6]), d = (float8)(p[3], p[7]);
  const float8 ab_xy = (float8)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5);
  const float8 cd_xy = (float8)(c.s0, d.s0, c.s1, d.s1, c.s4, d.s4, c.s5, d.s5);
  const float8 ab_z = (float8)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7);
  const float8 cd_z = (float8)(c.s2, d.s2, c.s3, d.s3, c.s6, d.s6, c.s7, d.s7);
  *x = (float8)(ab_xy.s01, cd_xy.s01, ab_xy.s45, cd_xy.s45);
  *y = (float8)(ab_xy.s23, cd_xy.s23, ab_xy.s67, cd_xy.s67);
  *z = (float8)(ab_z.s01, cd_z.s01, ab_z.s45, cd_z.s45);
}

#endif
