// Affine maps from object to world, in double: they are composed on the host and rounded once.
#pragma once

#include <array>

#include "scene/vec.hpp"

namespace facet {

/// An affine map p -> linear * p + offset; `row[i]` holds (linear_i0, linear_i1, linear_i2,
/// offset_i).
struct transform {
  std::array<std::array<double, 4>, 3> row{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  static transform translate(vec3d offset);
  /// Rotation by `degrees` around `axis` (any length but 0), right-handed.
  static transform rotate(vec3d axis, double degrees);
  static transform scale(vec3d factors);

  vec3d point(vec3d p) const;
  vec3d vector(vec3d v) const;
  /// linear^T * v: with the inverse map, how normals travel.
  vec3d transposed_vector(vec3d v) const;
  double determinant() const;
  bool is_identity() const;
  /// Throws std::domain_error if the determinant is 0 or not finite.
  transform inverse() const;

  /// (a * b).point(p) == a.point(b.point(p)).
  friend transform operator*(const transform& a, const transform& b);
  friend bool operator==(const transform&, const transform&) = default;
};

}  // namespace facet
