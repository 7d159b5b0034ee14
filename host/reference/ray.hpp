// Rays, hits and crossings of the reference, over any scalar.
#pragma once

#include <cstdint>
#include <limits>

#include "scene/vec.hpp"

namespace facet::reference {

/// u: half the distance from 1 to the next number; what one rounding can cost, relatively.
template <class T>
inline constexpr T unit_roundoff = std::numeric_limits<T>::epsilon() / 2;

template <class T>
inline constexpr T infinity = std::numeric_limits<T>::infinity();

inline constexpr std::uint32_t miss = 0xffffffffu;

/// t counts in units of |direction|. A negative tmin counts as 0; tmax may be infinite.
template <class T>
struct ray {
  vec3<T> origin;
  T tmin = 0;
  vec3<T> direction;
  T tmax = infinity<T>;
};

/// The point is (1-u-v)*p0 + u*p1 + v*p2. A miss has the ray's tmax for t, and u = v = 0.
template <class T>
struct hit {
  T t = infinity<T>, u = 0, v = 0;
  std::uint32_t instance = miss;
  std::uint32_t triangle = miss;  ///< index in the mesh

  explicit operator bool() const { return instance != miss; }

  /// The order that makes the closest hit unique: by t, then instance, then triangle.
  friend bool operator<(const hit& a, const hit& b) {
    if (a.t != b.t) return a.t < b.t;
    return a.instance != b.instance ? a.instance < b.instance : a.triangle < b.triangle;
  }
  friend bool operator==(const hit&, const hit&) = default;
};

/// A surface crossed by a ray, an edge belonging to exactly one of its triangles.
template <class T>
struct crossing {
  T t;
  std::uint32_t instance, triangle;
  bool front;  ///< the ray enters: it meets the side from which the triangle is counter-clockwise

  friend bool operator==(const crossing&, const crossing&) = default;
};

}  // namespace facet::reference
