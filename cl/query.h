// What a search looks for and what it has found so far: the canonical hit, any hit, or all crossings
// between two points.
#ifndef FACET_QUERY_H
#define FACET_QUERY_H

#include "triangle.h"

typedef struct {
  __global const SceneNode* restrict nodes;
  __global const Instance* restrict instances;  // in the order of the top tree's leaves
  __global const TriangleInfo* restrict infos;  // in leaf order
  __global const Material* restrict materials;
  volatile __global Faults* faults;
  float3 reach;
  uint root, instance_count, triangle_count;
} Scene;

static inline Scene scene_of(__global const World* w, __global const SceneNode* nodes,
                      __global const Instance* instances, __global const TriangleInfo* infos,
                      __global const Material* materials, __global Faults* faults) {
  Scene s;
  s.nodes = nodes;
  s.instances = instances;
  s.infos = infos;
  s.materials = materials;
  s.faults = faults;
  s.reach = vec_global(w->reach);
  s.root = w->root;
  s.instance_count = w->instance_count;
  s.triangle_count = w->triangle_count;
  return s;
}

// What a traversal looks for; a literal wherever one starts, so that a compiler can drop the rest.
#define FACET_CLOSEST 0u   // the canonical hit
#define FACET_ANY 1u       // whether there is one
#define FACET_CROSSINGS 2u // the optical depth of what is transparent, until something is not

typedef struct {
  float t;
  uint place, slot;  // of the hit, in memory: instance and triangle in leaf order; FACET_NONE: none
  // Of the closest hit, once the search has ended (finish); triangle is FACET_NONE if nothing is met.
  uint instance, triangle;  // ids in the scene
  float u, v;
  // FACET_CROSSINGS: where media end that are still open, and what has been crossed, in units of
  // 2^-32 (an integer, so that the order of the crossings cannot reach the sum).
  float t_end;
  long depth[3];
#ifdef FACET_COUNT_CROSSINGS
  uint entries, exits;
#endif
} Query;

static inline uint material_of(const Scene* s, uint place, uint slot) {
#ifndef FACET_NO_INSTANCES
  const uint replaced = s->instances[place].material;
  if (replaced != FACET_NONE) return replaced;
#endif
  return s->infos[slot].material;
}

// A term of an optical depth as an integer. It is limited to 2^30, beyond which nothing is seen.
static inline long fixed_depth(float x) {
  const float limited = x > 1073741824.0f ? 1073741824.0f : x < -1073741824.0f ? -1073741824.0f : x;
  return convert_long_rte(limited * 4294967296.0f);
}

static inline void add_depth(long* depth, __global const Material* m, float t_end, float t, bool is_front) {
  const float inside = is_front ? t_end - t : -(t_end - t);
  for (int c = 0; c < 3; ++c)
    depth[c] += fixed_depth(m->minus_ln_Kt[c]) + fixed_depth(inside * m->sigma[c]);
}

static inline void add_crossing(Query* q, __global const Material* m, float t, bool is_front) {
#ifdef FACET_COUNT_CROSSINGS
  q->entries += is_front;
  q->exits += !is_front;
#endif
  add_depth(q->depth, m, q->t_end, t, is_front);
}

static inline uint instance_of(const Scene* s, uint place) {
#ifdef FACET_NO_INSTANCES
  return 0u;
#else
  return s->instances[place].id;
#endif
}

// Whether of two hits at one distance a triangle comes before the best so far.
static inline bool is_before(const Scene* s, uint place, uint slot, uint best_place, uint best_slot) {
  const uint instance = instance_of(s, place), best = instance_of(s, best_place);
  return instance < best ||
         (instance == best && s->infos[slot].triangle < s->infos[best_slot].triangle);
}

// Takes in that the query's ray meets the triangle in `slot` at t; true if the query is answered.
static inline bool take_hit(const Scene* s, uint place, uint slot, float t, bool is_front, bool is_counted,
                            uint mode, Query* q) {
  if (mode == FACET_CROSSINGS) {
    __global const Material* m = &s->materials[material_of(s, place, slot)];
    if (!m->transparent) {
      q->triangle = 0u;
      return true;
    }
    if (is_counted) add_crossing(q, m, t, is_front);
    return false;
  }
  if (mode == FACET_ANY) {
    q->triangle = 0u;
    return true;
  }
  // Of the triangles that are tested at once, one may lie beyond another that was just taken.
  if (t >= q->t && (t > q->t || (q->slot != FACET_NONE && !is_before(s, place, slot, q->place, q->slot)))) return false;
  q->t = t;
  q->place = place;
  q->slot = slot;
  return false;
}

// Tests the triangle in slot `first`, or in the wide layout those of that block; true if the query is
// answered.
static inline bool meet_triangles(const Scene* s, GEOMETRY positions, const Space* space, uint place,
                                  Interval outer, uint first, float tmin, uint mode, Query* q) {
  TriangleHits hits;
  const Rays ray = in_all_lanes(space);
  const Intervals each = {in_all(outer.near), in_all(outer.far)};
  const Triangles triangles = triangles_from(positions, first);
  const Real from = in_all(tmin), to = in_all(q->t);
  const Mask met = hit_triangles(&ray, triangles, each, from, to, mode == FACET_CROSSINGS, &hits);
  if (is_none(met | hits.is_doubtful)) return false;
  uint left = lanes_where(settle_doubts(&ray, positions, triangles, each, from, to, met, &hits));
  for (; left != 0u; left = without_first(left)) {
    const uint lane = first_lane(left);
    const bool is_crossing = mode == FACET_CROSSINGS;
    if (take_hit(s, place, FACET_LANES * first + lane, in_lane(hits.t, lane),
                 is_crossing && is_in(hits.is_front, lane),
                 is_crossing && is_in(hits.is_counted, lane), mode, q))
      return true;
  }
  return false;
}

// Takes the world's ray into an instance; false if it cannot meet it, and then space's slabs stay as they are.
static inline bool enter_instance(const Scene* s, uint place, float3 o, float3 d, const Slabs world,
                           Interval* outer, Space* space) {
  __global const Instance* i = &s->instances[place];
  *outer = box_interval(world, vec_global(i->lo), vec_global(i->hi));
  if (!(outer->near <= outer->far)) return false;
  if (space_of(space, map_point(i->object_from_world, o), map_vector(i->object_from_world, d),
               vec_global(i->reach)))
    return true;
  atomic_inc(&s->faults->refused);
  return false;
}

#endif
