// An affine map rounded once from double to the scalar, with a fixed order of evaluation.
#pragma once

#include <array>
#include <cmath>

#include "reference/ray.hpp"
#include "scene/transform.hpp"
#include "scene/vec.hpp"

namespace facet::reference {

template <class T>
struct affine {
  std::array<std::array<T, 4>, 3> row{};

  affine() = default;
  explicit affine(const transform& m) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 4; ++j) row[i][j] = T(m.row[i][j]);
  }

  vec3<T> point(const vec3<T>& p) const {
    const auto f = [&](const std::array<T, 4>& r) {
      return ((r[0] * p.x + r[1] * p.y) + r[2] * p.z) + r[3];
    };
    return {f(row[0]), f(row[1]), f(row[2])};
  }
  vec3<T> vector(const vec3<T>& v) const {
    const auto f = [&](const std::array<T, 4>& r) {
      return (r[0] * v.x + r[1] * v.y) + r[2] * v.z;
    };
    return {f(row[0]), f(row[1]), f(row[2])};
  }
  /// linear^T * v: with the inverse map, how normals travel.
  vec3<T> transposed_vector(const vec3<T>& v) const {
    const auto f = [&](std::size_t j) {
      return (row[0][j] * v.x + row[1][j] * v.y) + row[2][j] * v.z;
    };
    return {f(0), f(1), f(2)};
  }

  /// 4u times the sum of the sizes of the terms of point(p): a bound on its rounding.
  vec3<T> point_error(const vec3<T>& p) const {
    const auto f = [&](const std::array<T, 4>& r) {
      return 4 * unit_roundoff<T> *
             (((std::abs(r[0] * p.x) + std::abs(r[1] * p.y)) + std::abs(r[2] * p.z)) +
              std::abs(r[3]));
    };
    return {f(row[0]), f(row[1]), f(row[2])};
  }
  /// |linear| * e.
  vec3<T> absolute_vector(const vec3<T>& e) const {
    const auto f = [&](const std::array<T, 4>& r) {
      return (std::abs(r[0]) * e.x + std::abs(r[1]) * e.y) + std::abs(r[2]) * e.z;
    };
    return {f(row[0]), f(row[1]), f(row[2])};
  }
};

}  // namespace facet::reference
