// From a ray to its canonical hit: of all accepted triangles the one with the smallest (t,
// instance, triangle), whatever tree leads to it (box.h says why). Also: any hit, and all
// crossings between two points, for coloured shadows.
#ifndef FACET_TRAVERSE_H
#define FACET_TRAVERSE_H

#include "geometry.h"
#include "triangle.h"

typedef struct {
  __global const Node* restrict nodes;
  __global const Instance* restrict instances;  // in the order of the top tree's leaves
  __global const TriangleInfo* restrict infos;  // in leaf order
  __global const Material* restrict materials;
  volatile __global Faults* faults;
  float3 reach;
  uint root, instance_count, triangle_count;
} Scene;

static inline Scene scene_of(__global const World* w, __global const Node* nodes,
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

static inline void add_crossing(Query* q, __global const Material* m, float t, bool is_front) {
  const float inside = is_front ? q->t_end - t : -(q->t_end - t);
#ifdef FACET_COUNT_CROSSINGS
  q->entries += is_front;
  q->exits += !is_front;
#endif
  for (int c = 0; c < 3; ++c)
    q->depth[c] += fixed_depth(m->minus_ln_Kt[c]) + fixed_depth(inside * m->sigma[c]);
}

static inline uint instance_of(const Scene* s, uint place) {
#ifdef FACET_NO_INSTANCES
  return 0u;
#else
  return s->instances[place].id;
#endif
}

// Whether of two hits at one distance a triangle comes before the query's own.
static inline bool is_before(const Scene* s, uint place, uint slot, const Query* q) {
  const uint instance = instance_of(s, place), best = instance_of(s, q->place);
  return instance < best ||
         (instance == best && s->infos[slot].triangle < s->infos[q->slot].triangle);
}

// Tests one triangle; true if the query is answered.
static inline bool meet_triangle(const Scene* s, GEOMETRY positions, const Space* space, uint place,
                          Interval outer, uint slot, float tmin, uint mode, Query* q) {
  float3 p0, p1, p2;
  read_triangle(positions, slot, &p0, &p1, &p2);
  TriangleHit hit;
  if (!hit_triangle(space, p0, p1, p2, outer, tmin, q->t, mode == FACET_CROSSINGS, &hit)) return false;
  if (mode == FACET_CROSSINGS) {
    __global const Material* m = &s->materials[material_of(s, place, slot)];
    if (!m->transparent) {
      q->triangle = 0u;
      return true;
    }
    if (hit.is_counted) add_crossing(q, m, hit.t, hit.is_front);
    return false;
  }
  if (mode == FACET_ANY) {
    q->triangle = 0u;
    return true;
  }
  if (hit.t == q->t && q->slot != FACET_NONE && !is_before(s, place, slot, q)) return false;
  q->t = hit.t;
  q->place = place;
  q->slot = slot;
  return false;
}

// Takes the world's ray into an instance; false if it cannot meet it.
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

#ifdef FACET_TREE_NONE

static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                   Space* space, Query* q) {
  Interval outer = {-INFINITY, INFINITY};
#ifdef FACET_NO_INSTANCES
  for (uint slot = 0; slot < s->triangle_count; ++slot)
    if (meet_triangle(s, positions, space, 0u, outer, slot, tmin, mode, q)) return;
#else
  const Slabs world = space->slabs;
  for (uint place = 0; place < s->instance_count; ++place) {
    if (!enter_instance(s, place, o, d, world, &outer, space)) continue;
    const uint first = s->instances[place].first_triangle;
    for (uint k = 0; k < s->instances[place].triangle_count; ++k)
      if (meet_triangle(s, positions, space, place, outer, first + k, tmin, mode, q)) return;
  }
#endif
}

#else

// A child that waits, as one number that sorts by distance: the near end's bits, which order as
// the floats do because tmin is at least 0, above the child. Absent ones sort last.
#define FACET_ABSENT (~0ul)
static inline ulong waiting(float near, float far, uint child) {
  return near <= far ? (ulong)as_uint(near) << 32 | child : FACET_ABSENT;
}
static inline float near_of(ulong entry) { return as_float((uint)(entry >> 32)); }

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS ((ulong)FACET_NONE)

// Depth first, the nearest child first. A node leaves at most three children waiting, so three times
// the depth of the trees, and one for the mark, are enough for the stack: FACET_STACK is at least
// that (host/tracer/tree.cpp), and it cannot overflow.
static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  ulong stack[FACET_STACK];
  int top = 0;
  uint node = s->root;
  Interval outer = {-INFINITY, INFINITY};
  uint place = 0u;
  Sides side = near_sides(space->slabs);
#ifndef FACET_NO_INSTANCES
  bool is_inside = false;  // in an instance's tree
  const Slabs world = space->slabs;
#endif
  for (;;) {
    bool is_leaf = true;
    while (!(node & FACET_LEAF_BIT)) {
      __global const float4* faces = (__global const float4*)(s->nodes + node);
      const uint4 child = ((__global const uint4*)faces)[6];
      float4 near, far;
      child_intervals(space->slabs, side, faces, tmin, q->t, &near, &far);
      ulong a = waiting(near.x, far.x, child.x), b = waiting(near.y, far.y, child.y),
            c = waiting(near.z, far.z, child.z), e = waiting(near.w, far.w, child.w);
      // A sorting network: a <= b <= c <= e.
      const ulong ab = min(a, b), ba = max(a, b), ce = min(c, e), ec = max(c, e);
      a = min(ab, ce), e = max(ba, ec);
      const ulong p = max(ab, ce), r = min(ba, ec);
      b = min(p, r), c = max(p, r);
      if (e != FACET_ABSENT) stack[top++] = e;
      if (c != FACET_ABSENT) stack[top++] = c;
      if (b != FACET_ABSENT) stack[top++] = b;
      is_leaf = a != FACET_ABSENT;
      if (!is_leaf) break;
      node = (uint)a;
    }
    if (is_leaf) {
#ifndef FACET_NO_INSTANCES
      if (!is_inside) {
        place = FACET_LEAF_FIRST(node);
        if (enter_instance(s, place, o, d, world, &outer, space)) {
          is_inside = true;
          side = near_sides(space->slabs);
          stack[top++] = FACET_INSTANCE_ENDS;
          node = s->instances[place].root;
          continue;
        }
        space->slabs = world;
      } else
#endif
      {
        const uint slot = FACET_LEAF_FIRST(node), count = FACET_LEAF_COUNT(node);
        for (uint k = 0; k < count; ++k)
          if (meet_triangle(s, positions, space, place, outer, slot + k, tmin, mode, q)) return;
      }
    }
    ulong entry;
    do {
      if (top == 0) return;
      entry = stack[--top];
#ifndef FACET_NO_INSTANCES
      if (entry == FACET_INSTANCE_ENDS) {
        is_inside = false;
        space->slabs = world;
        side = near_sides(world);
      }
#endif
    } while (near_of(entry) > q->t || entry == FACET_INSTANCE_ENDS);
    node = (uint)entry;
  }
}

#endif

// Says which triangle the closest hit is on, and where. A search keeps no more of a hit than its t and
// its place in memory: registers that it has not to hold.
static inline void finish(const Scene* s, GEOMETRY positions, float3 o, float3 d, Space* space,
                          Query* q) {
  if (q->slot == FACET_NONE) return;
  q->triangle = s->infos[q->slot].triangle;
  q->instance = instance_of(s, q->place);
#ifndef FACET_NO_INSTANCES
  __global const Instance* i = &s->instances[q->place];
  space_of(space, map_point(i->object_from_world, o), map_vector(i->object_from_world, d),
           vec_global(i->reach));
#endif
  float3 p0, p1, p2;
  read_triangle(positions, q->slot, &p0, &p1, &p2);
  const float2 shares = shares_of(space, p0, p1, p2);
  q->u = shares.x;
  q->v = shares.y;
}

// A ray that cannot be used (triangle.h: space_of), or whose tmin or tmax is NaN, meets nothing and
// is counted; a negative tmin counts as 0. For a miss t is tmax. `end`: see light.h.
static inline Query traverse_to(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin,
                                float tmax, float end, uint mode) {
  Query q;
  q.t = tmax;
  q.place = q.slot = FACET_NONE;
  q.u = q.v = 0.0f;
  q.instance = q.triangle = FACET_NONE;
  q.depth[0] = q.depth[1] = q.depth[2] = 0;
  q.t_end = end;
#ifdef FACET_COUNT_CROSSINGS
  q.entries = q.exits = 0u;
#endif
  Space space;
  const float start = tmin < 0.0f ? 0.0f : tmin;
  if (start > tmax) return q;
  if (!(start <= tmax) || !space_of(&space, o, d, s->reach)) {
    atomic_inc(&s->faults->refused);
    return q;
  }
  if (s->triangle_count == 0u) return q;
  search(s, positions, o, d, start, mode, &space, &q);
  if (mode == FACET_CLOSEST) finish(s, positions, o, d, &space, &q);
  return q;
}

static inline Query traverse(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin,
                             float tmax, uint mode) {
  return traverse_to(s, positions, o, d, tmin, tmax, 0.0f, mode);
}

// All that is crossed from o on to `distance`; triangle is FACET_NONE unless something opaque is met.
static inline Query crossings(const Scene* s, GEOMETRY positions, float3 o, float3 d, float distance,
                              float end) {
  return traverse_to(s, positions, o, d, 0.0f, distance, end, FACET_CROSSINGS);
}

#endif
