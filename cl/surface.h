// The point that a ray has met: where it is, how far that may be wrong, and its normals.
#ifndef FACET_SURFACE_H
#define FACET_SURFACE_H

#include "traverse.h"

typedef struct {
  float3 p;          // in the world
  float3 geometric;  // unit normal of the triangle's plane, against the ray
  float3 shading;    // unit normal, interpolated where the mesh is smooth, against the ray
  float delta;       // secondary rays start at p +- geometric * delta
  bool is_front;     // the ray comes from outside
  uint material;
} Surface;

// A normal of length 1, or `instead` where it has no direction. It is scaled by its largest
// component first: the square of a small triangle's normal would underflow.
static inline float3 unit_or(float3 n, float3 instead) {
  const float3 a = fabs(n);
  const float largest = larger(a.x, larger(a.y, a.z));
  const bool is_finite = a.x < INFINITY && a.y < INFINITY && a.z < INFINITY;
  return is_finite && largest > 0.0f ? normalize3(n / largest) : instead;
}

// The bound on the point's distance from its triangle, by axis in the world, as the next ray's
// test will see it: barycentric interpolation (8 u of the largest coordinate), that test's own
// rounding (8 u of the triangle's size as seen from the point), and both maps between object and
// world (4 u of the sums of absolute products). After Pharr, Jakob and Humphreys, Physically
// Based Rendering, section 6.8.
static inline float3 point_error(const Scene* s, uint place, float3 p0, float3 p1, float3 p2,
                                 float3 object, float3 world) {
  const float3 size = larger3(larger3(fabs(p0), fabs(p1)), fabs(p2));
  const float3 apart =
      larger3(larger3(fabs(p0 - object), fabs(p1 - object)), fabs(p2 - object));
  const float r = larger(apart.x, larger(apart.y, apart.z));
  const float3 e = (8.0f * FACET_ULP) * (size + r);
  const float maps = 4.0f * FACET_ULP;
#ifdef FACET_NO_INSTANCES
  return (e + maps * fabs(world)) + maps * fabs(object);
#else
  __global const float* w = s->instances[place].object_from_world;
  __global const float* m = s->instances[place].world_from_object;
  float back[3], q[3], error[3];
  const float pw[3] = {world.x, world.y, world.z}, po[3] = {object.x, object.y, object.z},
              eo[3] = {e.x, e.y, e.z};
  for (int j = 0; j < 3; ++j) {
    back[j] = maps * (((fabs(w[4 * j] * pw[0]) + fabs(w[4 * j + 1] * pw[1])) +
                       fabs(w[4 * j + 2] * pw[2])) + fabs(w[4 * j + 3]));
    q[j] = eo[j] + back[j];
  }
  for (int i = 0; i < 3; ++i) {
    const float forth = maps * (((fabs(m[4 * i] * po[0]) + fabs(m[4 * i + 1] * po[1])) +
                                 fabs(m[4 * i + 2] * po[2])) + fabs(m[4 * i + 3]));
    error[i] = ((fabs(m[4 * i]) * q[0] + fabs(m[4 * i + 1]) * q[1]) + fabs(m[4 * i + 2]) * q[2]) + forth;
  }
  return (float3)(error[0], error[1], error[2]);
#endif
}

static inline float3 point_to_world(const Scene* s, uint place, float3 p) {
#ifdef FACET_NO_INSTANCES
  return p;
#else
  return map_point(s->instances[place].world_from_object, p);
#endif
}

static inline float3 normal_to_world(const Scene* s, uint place, float3 n) {
#ifdef FACET_NO_INSTANCES
  return n;
#else
  return map_normal(s->instances[place].object_from_world, n);
#endif
}

// `d` is the ray's unit direction. Normals of a flat mesh among smooth ones are stored as 0.
static inline Surface surface_at(const Scene* s, GEOMETRY positions, GEOMETRY normals, const Query* q,
                                 float3 d) {
  Surface f;
  float3 p0, p1, p2;
  read_triangle(positions, q->slot, &p0, &p1, &p2);
  const float w = (1.0f - q->u) - q->v;
  const float3 object = (p0 * w + p1 * q->u) + p2 * q->v;
  f.p = point_to_world(s, q->place, object);

  const float3 n = unit_or(normal_to_world(s, q->place, cross3(p1 - p0, p2 - p0)), -d);
  f.is_front = dot3(d, n) < 0.0f;
  f.geometric = f.is_front ? n : -n;
  float3 shading = n;
#ifndef FACET_NO_SMOOTH
  float3 n0, n1, n2;
  read_normals(normals, q->slot, &n0, &n1, &n2);
  shading = unit_or(normal_to_world(s, q->place, (n0 * w + n1 * q->u) + n2 * q->v), n);
#endif
  f.shading = dot3(shading, d) > 0.0f ? -shading : shading;
  f.delta = dot3(fabs(n), point_error(s, q->place, p0, p1, p2, object, f.p));
  f.material = material_of(s, q->place, q->slot);
  return f;
}

#endif
