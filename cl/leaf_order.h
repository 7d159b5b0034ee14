// What belongs to triangles, put into the order of leaves.
#ifndef FACET_LEAF_ORDER_H
#define FACET_LEAF_ORDER_H

#include "layout.h"

// Puts a triangle's three float4, and what it is, into a slot.
static inline void put_triangle(__global const float4* corners, __global const uint* materials, uint triangle,
                                __global float4* corners_out, __global TriangleInfo* infos, size_t slot) {
  for (size_t c = 0; c < 3; ++c) corners_out[3 * slot + c] = corners[3 * (size_t)triangle + c];
  TriangleInfo info;
  info.triangle = triangle;
  info.material = materials[triangle];
  infos[slot] = info;
}

// Of kernels that build trees over triangles: they put them into order, too, where FACET_IN_ORDER asks for it.
#ifdef FACET_IN_ORDER
#define LEAF_ORDER_ARGUMENTS                                                                             \
  , __global const uint *materials, __global float4 *corners_out, __global TriangleInfo *infos, uint slot
#define PUT_IN_ORDER(triangle, place) \
  put_triangle(primitives, materials, triangle, corners_out, infos, (size_t)slot + (place))
#else
#define LEAF_ORDER_ARGUMENTS
#define PUT_IN_ORDER(triangle, place)
#endif

#endif
