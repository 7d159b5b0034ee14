// What reaches a point from one light, through all that is transparent on the way.
#ifndef FACET_LIGHT_H
#define FACET_LIGHT_H

#include "elementary.h"
#include "media.h"
#include "surface.h"

// The way to a light.
typedef struct {
  float3 start, direction;
  float distance;  // INFINITY for a directional light
  bool is_point;
  Media media;  // around the start
} Way;

#ifdef FACET_NO_TRANSPARENCY
#define FACET_SHADOWS FACET_ANY
#else
#define FACET_SHADOWS FACET_CROSSINGS
#endif

// For a point light `end` is its distance, so that a medium around the light is counted up to it; for a
// directional one it is 0, as every medium is left again.
static inline float end_of(const Way* way) { return way->is_point ? way->distance : 0.0f; }

static inline Query shadow_query(const Scene* s, GEOMETRY positions, const Way* way) {
  return traverse_to(s, positions, way->start, way->direction, 0.0f, way->distance, end_of(way),
                     FACET_SHADOWS);
}

// T, what reaches a point: the product of Kt over the surfaces crossed and of A^(s/D) over the way inside;
// 0 as soon as something opaque stands between. `q` tells of the way.
//
// A crossing at t adds -ln(Kt) and +-(end - t) sigma, + where a medium is entered; a medium around
// the start adds end * sigma.
static inline float3 transmittance(const Scene* s, const Way* way, Query q) {
#ifdef FACET_NO_TRANSPARENCY
  return q.triangle == FACET_NONE ? (float3)(1.0f) : (float3)(0.0f);
#else
  if (q.triangle != FACET_NONE) return (float3)(0.0f);
  for (int k = 0; k < FACET_NESTING; ++k) {
    if (way->media.of[k] == FACET_NONE || !way->is_point) continue;
    __global const Material* m = &s->materials[way->media.of[k]];
    for (int c = 0; c < 3; ++c) q.depth[c] += fixed_depth(way->distance * m->sigma[c]);
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

// How a light stands to a surface.
typedef struct {
  Way way;
  float3 l;  // unit direction to it, and its cosine with the shading normal
  float facing;
  float scale;  // what its distance leaves of it
} Lighting;

// False if it stands behind the surface. `media` surround the ray that met it.
static inline bool faces_light(const Scene* s, __global const Light* light, const Surface* f,
                               __global const Material* m, Media media, Lighting* to) {
  const bool is_point = light->kind == FACET_POINT_LIGHT;
  const float3 place = vec_global(light->position);
  to->l = place;
  to->scale = 1.0f;
  if (is_point) {
    const float3 way = place - f->p;
    const float distance = length3(way);
    to->l = way / distance;
    to->scale = falloff(light, distance);
  }
  to->facing = dot3(f->shading, to->l);
  if (!(to->facing > 0.0f)) return false;

  // A light that only the shading normal sees stands behind the surface: its way starts there.
  const bool is_above = dot3(f->geometric, to->l) > 0.0f;
  const float3 step = f->geometric * f->delta;
  Way* w = &to->way;
  w->start = is_above ? f->p + step : f->p - step;
  w->media = media;
#ifndef FACET_NO_TRANSPARENCY
  if (!is_above && m->transparent)
    w->media = f->is_front ? entered(s, media, f->material) : left(media, f->material);
#endif
  w->is_point = is_point;
  w->direction = to->l;
  w->distance = INFINITY;
  if (is_point) {
    const float3 way = place - w->start;
    w->distance = length3(way);
    w->direction = way / w->distance;
  }
  return true;
}

// The light's part of the radiance that leaves `f` against `d`, given what comes through on its way.
static inline float3 lit_by(__global const Light* light, const Lighting* to, const Surface* f,
                            __global const Material* m, float3 d, float3 through) {
  if (is_black(through)) return (float3)(0.0f);
  float3 reflected = vec_global(m->Kd) * to->facing;
#ifndef FACET_NO_SPECULAR
  float highlight = 0.0f;
  if (m->specular) {
    const float3 r = f->shading * (2.0f * to->facing) - to->l;
    const float along = dot3(r, -d);
    highlight = along > 0.0f ? pow_strict(along, m->Ns) : 0.0f;
  }
  reflected = reflected + vec_global(m->Ks) * highlight;
#endif
  return ((vec_global(light->colour) * to->scale) * through) * reflected;
}

#endif
