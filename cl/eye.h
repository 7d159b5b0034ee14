// The rays from the camera.
#ifndef FACET_EYE_H
#define FACET_EYE_H

#include "vec.h"

// The unit direction through the sample in column i and row j of a pixel's grid.
static inline float3 eye_direction(__global const View* view, uint x, uint y, uint i, uint j) {
  const float n = (float)view->samples;
  const float sx = (float)x + ((float)i + 0.5f) / n;
  const float sy = (float)y + ((float)j + 0.5f) / n;
  return normalize3((vec_global(view->corner) + vec_global(view->dx) * sx) + vec_global(view->dy) * sy);
}

#endif
