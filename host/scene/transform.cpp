#include "scene/transform.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace facet {
namespace {

struct turn {
  double sine, cosine;
};

/// Quarter turns are exact, so that a rotation by 90 degrees moves integers to integers.
turn turn_by(double degrees) {
  const double rest = std::remainder(degrees, 360.0);
  if (rest == 0) return {0, 1};
  if (rest == 90) return {1, 0};
  if (rest == -90) return {-1, 0};
  if (std::abs(rest) == 180) return {0, -1};
  const double radians = rest * (std::numbers::pi / 180);
  return {std::sin(radians), std::cos(radians)};
}

}  // namespace

transform transform::translate(vec3d offset) {
  transform t;
  for (int i = 0; i < 3; ++i) t.row[i][3] = offset[i];
  return t;
}

transform transform::rotate(vec3d axis, double degrees) {
  const vec3d a = axis / std::hypot(axis.x, axis.y, axis.z);
  const auto [s, c] = turn_by(degrees);
  const double k = 1 - c;
  transform t;
  t.row[0] = {a.x * a.x * k + c, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s, 0};
  t.row[1] = {a.y * a.x * k + a.z * s, a.y * a.y * k + c, a.y * a.z * k - a.x * s, 0};
  t.row[2] = {a.z * a.x * k - a.y * s, a.z * a.y * k + a.x * s, a.z * a.z * k + c, 0};
  return t;
}

transform transform::scale(vec3d factors) {
  transform t;
  for (int i = 0; i < 3; ++i) t.row[i][i] = factors[i];
  return t;
}

vec3d transform::point(vec3d p) const {
  vec3d r;
  for (int i = 0; i < 3; ++i)
    r[i] = ((row[i][0] * p.x + row[i][1] * p.y) + row[i][2] * p.z) + row[i][3];
  return r;
}

vec3d transform::vector(vec3d v) const {
  vec3d r;
  for (int i = 0; i < 3; ++i) r[i] = (row[i][0] * v.x + row[i][1] * v.y) + row[i][2] * v.z;
  return r;
}

vec3d transform::transposed_vector(vec3d v) const {
  vec3d r;
  for (int i = 0; i < 3; ++i) r[i] = (row[0][i] * v.x + row[1][i] * v.y) + row[2][i] * v.z;
  return r;
}

double transform::determinant() const {
  const auto& m = row;
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool transform::is_identity() const { return *this == transform{}; }

transform transform::inverse() const {
  const double d = determinant();
  if (d == 0 || !std::isfinite(d))
    throw std::domain_error("a transform with determinant " + std::to_string(d) +
                            " has no inverse");
  const auto& m = row;
  transform r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // The cofactor of (j, i), cyclic indices carrying its sign.
      const int a = (j + 1) % 3, b = (j + 2) % 3, p = (i + 1) % 3, q = (i + 2) % 3;
      r.row[i][j] = (m[a][p] * m[b][q] - m[a][q] * m[b][p]) / d;
    }
  }
  const vec3d offset = r.vector({m[0][3], m[1][3], m[2][3]});
  for (int i = 0; i < 3; ++i) r.row[i][3] = -offset[i];
  return r;
}

transform operator*(const transform& a, const transform& b) {
  transform r;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j)
      r.row[i][j] =
          (a.row[i][0] * b.row[0][j] + a.row[i][1] * b.row[1][j]) + a.row[i][2] * b.row[2][j];
    r.row[i][3] += a.row[i][3];
  }
  return r;
}

}  // namespace facet
