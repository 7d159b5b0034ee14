// Three-component vectors over any scalar, with a fixed order of evaluation.
//
// The order of every sum below is part of the meaning: the kernels (cl/vec.h) evaluate the same
// expressions in the same order without contraction, so that float results agree bit for bit.
#pragma once

#include <algorithm>
#include <cmath>

namespace facet {

template <class T>
struct vec3 {
  T x{}, y{}, z{};

  constexpr vec3() = default;
  constexpr vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class U>
  constexpr explicit vec3(const vec3<U>& v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}

  /// Component by axis, 0 to 2.
  constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  friend constexpr vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
  /// By component, as colours multiply.
  friend constexpr vec3 operator*(vec3 a, vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend constexpr vec3 operator*(vec3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr vec3 operator*(T s, vec3 a) { return a * s; }
  friend constexpr vec3 operator/(vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const vec3&, const vec3&) = default;
};

using vec3f = vec3<float>;
using vec3d = vec3<double>;

template <class T>
constexpr T dot(vec3<T> a, vec3<T> b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

template <class T>
constexpr vec3<T> cross(vec3<T> a, vec3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(vec3<T> a) {
  return std::sqrt(dot(a, a));
}

/// a / |a|: a division, not a product with a reciprocal, so that each component is rounded once.
template <class T>
vec3<T> normalize(vec3<T> a) {
  return a / length(a);
}

template <class T>
constexpr vec3<T> min(vec3<T> a, vec3<T> b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

template <class T>
constexpr vec3<T> max(vec3<T> a, vec3<T> b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

template <class T>
vec3<T> abs(vec3<T> a) {
  return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}

template <class T>
bool is_finite(vec3<T> a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// An axis-aligned box; empty while lo > hi.
template <class T>
struct box3 {
  vec3<T> lo{INFINITY, INFINITY, INFINITY};
  vec3<T> hi{-INFINITY, -INFINITY, -INFINITY};

  constexpr bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  constexpr void add(vec3<T> p) { lo = min(lo, p), hi = max(hi, p); }
  constexpr void add(const box3& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
  constexpr vec3<T> extent() const { return hi - lo; }
  constexpr vec3<T> centre() const { return (lo + hi) * T(0.5); }
  /// Half of the surface area: what SAH costs are proportional to.
  constexpr T half_area() const {
    const vec3<T> e = extent();
    return empty() ? T(0) : (e.x * e.y + e.y * e.z) + e.z * e.x;
  }
  friend constexpr bool operator==(const box3&, const box3&) = default;
};

using box3f = box3<float>;
using box3d = box3<double>;

}  // namespace facet
