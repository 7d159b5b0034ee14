// A ray as seen in one coordinate system (the world, or an instance's object space): what the
// triangle test and the slab test need of it, computed once.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "reference/ray.hpp"

namespace facet::reference {

/// Rays outside these bounds are refused: they hit nothing. Inside them no edge function overflows.
template <class T>
bool is_refused(const vec3<T>& origin, const vec3<T>& direction) {
  constexpr T most = T(0x1p60), least = T(0x1p-60);
  const vec3<T> o = abs(origin), d = abs(direction);
  const bool bounded =
      o.x <= most && o.y <= most && o.z <= most && d.x <= most && d.y <= most && d.z <= most;
  return !bounded || !(d.x >= least || d.y >= least || d.z >= least);
}

template <class T>
bool is_refused(const ray<T>& r) {
  return std::isnan(r.tmin) || std::isnan(r.tmax) || is_refused(r.origin, r.direction);
}

/// A range of t; empty if near > far.
template <class T>
struct interval {
  T near = -infinity<T>, far = infinity<T>;

  interval meet(const interval& other) const {
    return {other.near > near ? other.near : near, other.far < far ? other.far : far};
  }
};

/// Components by an axis known at run time alone, without a branch: rays in all directions would
/// mispredict each.
template <class T>
struct axes {
  std::array<T, 3> value;

  explicit axes(const vec3<T>& v) : value{v.x, v.y, v.z} {}
  T operator[](int axis) const { return value[std::size_t(axis)]; }
};

template <class T>
struct space {
  vec3<T> origin;
  int kx, ky, kz;  ///< kz: the direction's largest axis, which changes places with z
  bool turned;     ///< corners that turn left turn right in these axes
  T Sx, Sy;        ///< the shear that maps the direction to the z axis
  T unit;         ///< 2^-e, e being the exponent of E: corners as seen from the origin stay below 2
  T t_of_unit;    ///< 2^e / d_z: what a z of 1 is in t
  vec3<T> start;  ///< the origin in units of 2^e
  vec3<T> inverse;  ///< 1 / direction, bounded
  vec3<T> reach;    ///< |origin| + the largest |coordinate| of the boxes, by axis
  T pad;            ///< what slabs are widened by, in units of length
  vec3<T> near_offset, far_offset;

  space() = default;
  /// `extent`: the largest |coordinate| by axis of all boxes that the ray will be held against.
  space(const vec3<T>& o, const vec3<T>& d, const vec3<T>& extent) : origin(o) {
    const vec3<T> a = abs(d);
    kz = a.y > a.x ? 1 : 0;
    kz = a.z > std::max(a.x, a.y) ? 2 : kz;
    const axes<T> direction(d);
    kx = kz == 0 ? 2 : 0, ky = kz == 1 ? 2 : 1;
    turned = (direction[kz] < 0) != (kz != 2);
    Sx = direction[kx] / direction[kz], Sy = direction[ky] / direction[kz];

    reach = abs(o) + extent;
    const T E = std::max(std::max(reach.x, reach.y), reach.z);
    const int exponent = std::ilogb(std::max(E, T(0x1p-60)));
    unit = std::ldexp(T(1), -exponent);
    t_of_unit = std::ldexp(1 / direction[kz], exponent);
    start = unit * o;
    pad = 24 * unit_roundoff<T> * E;
    const T least = std::abs(direction[kz]) * T(0x1p-60);
    for (int i = 0; i < 3; ++i) {
      inverse[i] = 1 / (a[i] < least ? std::copysign(least, d[i]) : d[i]);
      const T p = pad * std::abs(inverse[i]);
      const T c = -(o[i] * inverse[i]);
      // An infinite c says that this axis is too steep for the scalar: it constrains nothing.
      near_offset[i] = std::abs(c) < infinity<T> ? c - p : -infinity<T>;
      far_offset[i] = std::abs(c) < infinity<T> ? c + p : infinity<T>;
    }
  }

  /// The padded slab interval of a box. fma, min and max are monotone: the interval of a box
  /// contains those of all boxes in it, bit for bit, whatever the tree. A NaN constrains nothing.
  interval<T> slab(const box3<T>& b) const {
    interval<T> r;
    for (int i = 0; i < 3; ++i) {
      const std::array<T, 2> plane{b.lo[i], b.hi[i]};
      const std::size_t near = inverse[i] > 0 ? 0 : 1;
      const T n = std::fma(plane[near], inverse[i], near_offset[i]);
      const T f = std::fma(plane[1 - near], inverse[i], far_offset[i]);
      r = r.meet({n, f});
    }
    return r;
  }
};

}  // namespace facet::reference
