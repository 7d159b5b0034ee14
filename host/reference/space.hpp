// A ray as seen in one coordinate system (the world, or an instance's object space): what the
// triangle test and the slab test need of it, computed once.
#pragma once

#include <cmath>
#include <utility>

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

template <class T>
struct space {
  vec3<T> origin;
  int kx, ky, kz;   ///< kz: the direction's largest axis; the swap of kx and ky keeps winding
  T Sx, Sy, Sz;     ///< the shear that maps the direction to +z
  vec3<T> inverse;  ///< 1 / direction, bounded
  vec3<T> reach;    ///< |origin| + the largest |coordinate| of the boxes, by axis
  T pad;            ///< what slabs are widened by, in units of length
  vec3<T> near_offset, far_offset;

  space() = default;
  /// `extent`: the largest |coordinate| by axis of all boxes that the ray will be held against.
  space(const vec3<T>& o, const vec3<T>& d, const vec3<T>& extent) : origin(o) {
    const vec3<T> a = abs(d);
    kz = a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
    kx = (kz + 1) % 3, ky = (kx + 1) % 3;
    if (d[kz] < 0) std::swap(kx, ky);
    Sx = d[kx] / d[kz], Sy = d[ky] / d[kz], Sz = 1 / d[kz];

    reach = abs(o) + extent;
    pad = 16 * unit_roundoff<T> * std::max(std::max(reach.x, reach.y), reach.z);
    const T least = a[kz] * T(0x1p-60);
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
      const bool up = inverse[i] > 0;
      const T n = std::fma(up ? b.lo[i] : b.hi[i], inverse[i], near_offset[i]);
      const T f = std::fma(up ? b.hi[i] : b.lo[i], inverse[i], far_offset[i]);
      r = r.meet({n, f});
    }
    return r;
  }
};

}  // namespace facet::reference
