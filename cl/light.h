// What reaches a point from one light, through all that is transparent on the way.
#ifndef FACET_LIGHT_H
#define FACET_LIGHT_H

#include "elementary.h"
#include "media.h"
#include "surface.h"

// T, what reaches a point: the product of Kt over the surfaces crossed and of A^(s/D) over the way inside;
// 0 as soon as something opaque stands between. `media` surround `start`; `distance` is INFINITY for a
// directional light.
//
// A crossing at t adds -ln(Kt) and +-(end - t) sigma, + where a medium is entered; a medium around
// the start adds end * sigma. For a point light `end` is its distance, so that a medium around the
// light is counted up to it; for a directional one it is 0, as every medium is left again.
static inline float3 transmittance(const Scene* s, GEOMETRY positions, float3 start, float3 direction,
                                   float distance, bool is_point, Media media) {
#ifdef FACET_NO_TRANSPARENCY
  const Query q = traverse(s, positions, start, direction, 0.0f, distance, FACET_ANY);
  return q.triangle == FACET_NONE ? (float3)(1.0f) : (float3)(0.0f);
#else
  Query q = crossings(s, positions, start, direction, distance, is_point ? distance : 0.0f);
  if (q.triangle != FACET_NONE) return (float3)(0.0f);
  for (int k = 0; k < FACET_NESTING; ++k) {
    if (media.of[k] == FACET_NONE || !is_point) continue;
    __global const Material* m = &s->materials[media.of[k]];
    for (int c = 0; c < 3; ++c) q.depth[c] += fixed_depth(distance * m->sigma[c]);
  }
  float t[3];
  for (int c = 0; c < 3; ++c) {
    const long depth = q.depth[c] > 0 ? q.depth[c] : 0;
    t[c] = depth == 0 ? 1.0f : exp_strict(-(convert_float_rte(depth) * 2.3283064365386963e-10f));
  }
  return (float3)(t[0], t[1], t[2]);
#endif
}

// 1 / (a + b d + c d^2), at most 1.
static inline float falloff(__global const Light* light, float distance) {
  const float g = (light->falloff[0] + light->falloff[1] * distance) +
                  (light->falloff[2] * distance) * distance;
  return g > 1.0f ? 1.0f / g : 1.0f;
}

// The light's part of the radiance that leaves `f` against `d`. `media` surround the ray.
static inline float3 lit_by(const Scene* s, GEOMETRY positions, __global const Light* light,
                            const Surface* f, __global const Material* m, float3 d, Media media) {
  const bool is_point = light->kind == FACET_POINT_LIGHT;
  const float3 place = vec_global(light->position);
  float3 l = place;
  float scale = 1.0f;
  if (is_point) {
    const float3 way = place - f->p;
    const float distance = length3(way);
    l = way / distance;
    scale = falloff(light, distance);
  }
  const float facing = dot3(f->shading, l);
  if (!(facing > 0.0f)) return (float3)(0.0f);

  // A light that only the shading normal sees stands behind the surface: its way starts there.
  const bool is_above = dot3(f->geometric, l) > 0.0f;
  const float3 step = f->geometric * f->delta;
  const float3 start = is_above ? f->p + step : f->p - step;
#ifndef FACET_NO_TRANSPARENCY
  if (!is_above && m->transparent)
    media = f->is_front ? entered(s, media, f->material) : left(media, f->material);
#endif
  float3 direction = l;
  float distance = INFINITY;
  if (is_point) {
    const float3 way = place - start;
    distance = length3(way);
    direction = way / distance;
  }
  const float3 t = transmittance(s, positions, start, direction, distance, is_point, media);
  if (is_black(t)) return (float3)(0.0f);

  float3 reflected = vec_global(m->Kd) * facing;
#ifndef FACET_NO_SPECULAR
  float highlight = 0.0f;
  if (m->specular) {
    const float3 r = f->shading * (2.0f * facing) - l;
    const float along = dot3(r, -d);
    highlight = along > 0.0f ? pow_strict(along, m->Ns) : 0.0f;
  }
  reflected = reflected + vec_global(m->Ks) * highlight;
#endif
  return ((vec_global(light->colour) * scale) * t) * reflected;
}

#endif
