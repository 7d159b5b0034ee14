// The media around a point: materials of the transparent objects that it lies in.
//
// Objects may lie within one another as deep as the scene says (scene.hpp: nesting). Light is bent
// as if the innermost object displaced the others, the innermost being the one entered last
// (Schmidt and Budge 2002, without their priorities); ways are dimmed by all of them, so that what
// passes does not depend on the order of the crossings (light.h).
#ifndef FACET_MEDIA_H
#define FACET_MEDIA_H

#include "traverse.h"

typedef struct {
  uint of[FACET_NESTING];  // innermost first, then FACET_NONE
} Media;

static inline Media no_media(void) {
  Media m;
  for (int k = 0; k < FACET_NESTING; ++k) m.of[k] = FACET_NONE;
  return m;
}

static inline Media media_of(__global const uint* of) {
  Media m;
  for (int k = 0; k < FACET_NESTING; ++k) m.of[k] = of[k];
  return m;
}

static inline bool is_empty(Media m) { return m.of[0] == FACET_NONE; }

// The index of refraction of the innermost; 1 outside of all.
static inline float index_of(const Scene* s, Media m) {
  return is_empty(m) ? 1.0f : s->materials[m.of[0]].Ni;
}

// What they take of light, a scene unit long: -ln by channel.
static inline float3 absorption(const Scene* s, Media m) {
  float3 sigma = vec_global(s->materials[m.of[0]].sigma);
  for (int k = 1; k < FACET_NESTING; ++k)
    if (m.of[k] != FACET_NONE) sigma = sigma + vec_global(s->materials[m.of[k]].sigma);
  return sigma;
}

// Inside one more. A list that is full forgets its outermost, and the fault is counted.
static inline Media entered(const Scene* s, Media m, uint material) {
  if (m.of[FACET_NESTING - 1] != FACET_NONE) atomic_inc(&s->faults->crowded);
  for (int k = FACET_NESTING - 1; k > 0; --k) m.of[k] = m.of[k - 1];
  m.of[0] = material;
  return m;
}

// Outside of the innermost object of that material; unchanged if there is none (a mesh that is not
// closed).
static inline Media left(Media m, uint material) {
  bool is_gone = false;
  for (int k = 0; k < FACET_NESTING; ++k) {
    is_gone = is_gone || m.of[k] == material;
    if (is_gone) m.of[k] = k + 1 < FACET_NESTING ? m.of[k + 1] : FACET_NONE;
  }
  return m;
}

// Where a ray is behind the surface that it crosses, and its index there over the one before. Leaving
// an object that is not the innermost bends nothing.
static inline Media crossed(const Scene* s, Media before, uint material, bool is_front, float* eta) {
  if (is_front) {
    *eta = index_of(s, before) / s->materials[material].Ni;
    return entered(s, before, material);
  }
  const Media behind = left(before, material);
  bool is_outer = false;
  for (int k = 1; k < FACET_NESTING; ++k) is_outer = is_outer || before.of[k] == material;
  is_outer = is_outer && before.of[0] != material;
  *eta = (is_outer ? index_of(s, before) : s->materials[material].Ni) / index_of(s, behind);
  return behind;
}

#endif
