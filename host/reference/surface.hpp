// What is known of the surface at a hit: the point, a bound on its error, the normals.
#pragma once

#include <cmath>

#include "reference/geometry.hpp"

namespace facet::reference {

template <class T>
struct surface {
  vec3<T> point;
  bool front;         ///< the ray meets the outside face
  vec3<T> geometric;  ///< unit, towards the side that the ray comes from
  vec3<T> shading;    ///< unit, N of the formula: not away from where the ray comes from
  T delta;            ///< how far along `geometric` the rounding of `point` may reach

  /// Where a ray starts that leaves to the side that the hitting ray came from, or to the other.
  vec3<T> near_side() const { return point + geometric * delta; }
  vec3<T> far_side() const { return point - geometric * delta; }
};

/// n / |n|, or `otherwise` where n is 0 or not finite. Dividing by the largest component first
/// keeps the squares of very small and very large n in range.
template <class T>
vec3<T> unit_or(const vec3<T>& n, const vec3<T>& otherwise) {
  const vec3<T> a = abs(n);
  const T m = std::max(std::max(a.x, a.y), a.z);
  return is_finite(n) && m > 0 ? normalize(n / m) : otherwise;
}

/// The surface that a ray of the given unit direction meets at h.
template <class T>
surface<T> surface_at(const geometry<T>& g, const hit<T>& h, const vec3<T>& direction) {
  const placement<T>& place = g.placed(h.instance);
  const mesh& m = g.mesh_of(h.instance);
  const corners<T> p = g.corners_of(h.instance, h.triangle);
  const T w = (1 - h.u) - h.v;
  const vec3<T> object = (p[0] * w + p[1] * h.u) + p[2] * h.v;

  surface<T> s;
  s.point = place.world_from_object.point(object);

  // Bounds: of the interpolation, of the way back into object space, of the way out to the world.
  const vec3<T> largest = max(max(abs(p[0]), abs(p[1])), abs(p[2]));
  T radius = 0;
  for (const vec3<T>& corner : p) {
    const vec3<T> a = abs(corner - object);
    radius = std::max(radius, std::max(std::max(a.x, a.y), a.z));
  }
  const vec3<T> interpolated =
      vec3<T>(largest.x + radius, largest.y + radius, largest.z + radius) * (8 * unit_roundoff<T>);
  const vec3<T> q = interpolated + place.object_from_world.point_error(s.point);
  const vec3<T> e =
      place.world_from_object.absolute_vector(q) + place.world_from_object.point_error(object);

  const vec3<T> normal =
      unit_or(place.object_from_world.transposed_vector(cross(p[1] - p[0], p[2] - p[0])),
              normalize(-direction));
  s.front = dot(direction, normal) < 0;
  s.geometric = s.front ? normal : -normal;
  s.delta = dot(abs(normal), e);

  s.shading = normal;
  if (m.is_smooth()) {
    const vec3<T> n =
        (vec3<T>(m.normal(h.triangle, 0)) * w + vec3<T>(m.normal(h.triangle, 1)) * h.u) +
        vec3<T>(m.normal(h.triangle, 2)) * h.v;
    s.shading = unit_or(place.object_from_world.transposed_vector(n), normal);
  }
  if (dot(s.shading, direction) > 0) s.shading = -s.shading;
  return s;
}

}  // namespace facet::reference
