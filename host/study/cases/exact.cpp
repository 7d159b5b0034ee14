#include "study/cases/exact.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace facet::study {
namespace {

/// (p - o) x (q - o) . d: six times the volume under the ray and the edge; its sign says on which
/// side the ray passes.
template <class T>
T edge_volume(const std::array<T, 3>& d, const std::array<T, 3>& p, const std::array<T, 3>& q) {
  return d[0] * (p[1] * q[2] - p[2] * q[1]) + d[1] * (p[2] * q[0] - p[0] * q[2]) +
         d[2] * (p[0] * q[1] - p[1] * q[0]);
}

template <class T>
bool same_side(const T& u, const T& v, const T& w) {
  return !((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0));
}

std::array<mpq_class, 3> rational(vec3d v) {
  return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)};
}

template <class T>
std::array<T, 3> minus(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return {T(a[0] - b[0]), T(a[1] - b[1]), T(a[2] - b[2])};
}

/// The decision in double where all three volumes are certain; nothing otherwise. Differences of
/// floats are rounded once each (u), products and sums 5 times more: 8 u of the sum of absolute
/// terms bounds each volume's error, twice over.
std::optional<bool> meets_by_double(vec3d o, vec3d d, const std::array<vec3d, 3>& p) {
  std::array<std::array<double, 3>, 3> a;
  for (std::size_t k = 0; k < 3; ++k) a[k] = {p[k].x - o.x, p[k].y - o.y, p[k].z - o.z};
  const std::array<double, 3> way{d.x, d.y, d.z};
  std::array<double, 3> volume{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &q = a[(k + 1) % 3], &r = a[(k + 2) % 3];
    volume[k] = edge_volume(way, q, r);
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, l = (i + 2) % 3;
      size += std::abs(way[i]) * (std::abs(q[j] * r[l]) + std::abs(q[l] * r[j]));
    }
    if (!(std::abs(volume[k]) > 16 * 0x1p-53 * size) || !(size > 1e-250 && size < 1e250)) return {};
  }
  return same_side(volume[0], volume[1], volume[2]);
}

}  // namespace

grid_point on_grid(vec3f v) { return {std::llrint(v.x), std::llrint(v.y), std::llrint(v.z)}; }

bool grid_ray_meets(const grid_point& o, const grid_point& d, const std::array<grid_point, 3>& p) {
  __extension__ typedef __int128 wide;
  std::array<std::array<wide, 3>, 3> a;
  for (std::size_t k = 0; k < 3; ++k) a[k] = {p[k].x - o.x, p[k].y - o.y, p[k].z - o.z};
  const std::array<wide, 3> way{d.x, d.y, d.z};
  const wide u = edge_volume(way, a[1], a[2]), v = edge_volume(way, a[2], a[0]),
             w = edge_volume(way, a[0], a[1]);
  if (!same_side(u, v, w)) return false;
  const wide sum = u + v + w;  // n . d, n the normal (p1 - p0) x (p2 - p0)
  if (sum == 0) return false;
  // t = n . (p0 - o) / n . d, and the volume of the three corners is n . (p0 - o).
  const wide volume = edge_volume(a[0], a[1], a[2]);
  return volume == 0 || (volume > 0) == (sum > 0);
}

std::optional<exact_hit> meet_exactly(vec3d o, vec3d d, const std::array<vec3d, 3>& p) {
  const auto origin = rational(o), way = rational(d);
  std::array<std::array<mpq_class, 3>, 3> a;
  for (std::size_t k = 0; k < 3; ++k) a[k] = minus(rational(p[k]), origin);
  const mpq_class u = edge_volume(way, a[1], a[2]), v = edge_volume(way, a[2], a[0]),
                  w = edge_volume(way, a[0], a[1]);
  if (!same_side(u, v, w)) return {};
  const mpq_class sum = u + v + w;
  if (sum == 0) return {};
  const mpq_class t = edge_volume(a[0], a[1], a[2]) / sum, b = v / sum, c = w / sum,
                  least = std::min(std::min(mpq_class(u / sum), b), c);
  return exact_hit{t.get_d(), b.get_d(), c.get_d(), u != 0 && v != 0 && w != 0, least.get_d()};
}

double plane_distance(vec3d o, vec3d d, const std::array<vec3d, 3>& p) {
  const auto origin = rational(o), way = rational(d);
  std::array<std::array<mpq_class, 3>, 3> a;
  for (std::size_t k = 0; k < 3; ++k) a[k] = minus(rational(p[k]), origin);
  const mpq_class sum =
      edge_volume(way, a[1], a[2]) + edge_volume(way, a[2], a[0]) + edge_volume(way, a[0], a[1]);
  if (sum == 0) return std::numeric_limits<double>::quiet_NaN();
  return mpq_class(edge_volume(a[0], a[1], a[2]) / sum).get_d();
}

bool meets_exactly(vec3f o, vec3f d, const std::array<vec3f, 3>& p) {
  const std::array<vec3d, 3> q{vec3d(p[0]), vec3d(p[1]), vec3d(p[2])};
  if (const auto known = meets_by_double(vec3d(o), vec3d(d), q); known && !*known) return false;
  const auto hit = meet_exactly(vec3d(o), vec3d(d), q);
  return hit && hit->t >= 0;
}

}  // namespace facet::study
