// Where a triangle's corners are read from: float4 texels of an image2d, to go through the texture
// cache as the source design does, or a buffer. Three in a row belong to one triangle.
#ifndef FACET_GEOMETRY_H
#define FACET_GEOMETRY_H

#include "features.h"
#include "vec.h"

#ifdef FACET_GEOMETRY_IMAGE

#define GEOMETRY read_only image2d_t
#define FACET_IMAGE_BITS 13  // an image is 2^13 texels wide, which every full device allows

static inline float3 read_corner(GEOMETRY g, uint index) {
  const int2 at = (int2)((int)(index & ((1u << FACET_IMAGE_BITS) - 1u)), (int)(index >> FACET_IMAGE_BITS));
  return read_imagef(g, at).xyz;
}

#else

#define GEOMETRY __global const float4* restrict

static inline float3 read_corner(GEOMETRY g, uint index) { return g[index].xyz; }

#endif

// Corners 3 * slot to 3 * slot + 2; slots are triangles in leaf order, below 2^27.
static inline void read_triangle(GEOMETRY g, uint slot, float3* p0, float3* p1, float3* p2) {
  *p0 = read_corner(g, 3u * slot);
  *p1 = read_corner(g, 3u * slot + 1u);
  *p2 = read_corner(g, 3u * slot + 2u);
}

#endif
