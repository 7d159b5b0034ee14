// Sphereflake and Menger sponge.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scene/generator.hpp"

namespace facet {
namespace {

struct ball {
  vec3d centre, axis;  ///< axis: away from the parent, unit
  double radius;
};

/// Nine directions around `axis`: six on the equator and three above it, those of a cuboctahedron
/// that stands on a triangle (Eric Haines, "A Proposal for Standard Graphics Environments", 1987).
std::array<vec3d, 9> child_directions(vec3d axis) {
  const vec3d other = std::abs(axis.x) < 0.9 ? vec3d(1, 0, 0) : vec3d(0, 1, 0);
  const vec3d u = normalize(cross(axis, other)), v = cross(axis, u);
  const double up = std::sqrt(2.0 / 3), out = std::sqrt(1.0 / 3);
  std::array<vec3d, 9> directions;
  for (int i = 0; i < 9; ++i) {
    const double angle = (i < 6 ? i : 2 * (i - 6) + 0.5) * std::numbers::pi / 3;
    const vec3d flat = u * std::cos(angle) + v * std::sin(angle);
    directions[std::size_t(i)] = normalize(i < 6 ? flat : flat * out + axis * up);
  }
  return directions;
}

/// Spheres of the flake touch: their centres are drawn apart by this factor, so that the meshes are
/// disjoint. A subtree stays within 2 radii of its root, times this; nothing else comes that near.
constexpr double drawn_apart = 1.001;

std::vector<ball> flake_balls(std::uint32_t depth, double radius) {
  std::vector<ball> balls{{{0, 0, 0}, {0, 1, 0}, radius}};
  std::size_t begin = 0;
  for (std::uint32_t level = 0; level < depth; ++level) {
    const std::size_t end = balls.size();
    for (std::size_t i = begin; i < end; ++i) {
      const ball parent = balls[i];
      for (vec3d d : child_directions(parent.axis))
        balls.push_back(
            {parent.centre + d * (parent.radius * (4.0 / 3) * drawn_apart), d, parent.radius / 3});
    }
    begin = end;
  }
  return balls;
}

mesh make_sphereflake(const arguments& a) {
  const unit_sphere sphere = make_unit_icosphere(a.whole("subdivisions"));
  const std::vector<ball> balls = flake_balls(a.whole("depth"), a["radius"]);
  mesh m;
  m.positions.reserve(balls.size() * sphere.directions.size());
  m.indices.reserve(balls.size() * sphere.indices.size());
  for (const ball& b : balls) {
    const auto first = std::uint32_t(m.positions.size());
    for (vec3d d : sphere.directions) m.positions.push_back(vec3f(b.centre + d * b.radius));
    for (std::uint32_t i : sphere.indices) m.indices.push_back(first + i);
  }
  if (a.on("smooth")) {
    for (vec3d d : sphere.directions) m.normals.push_back(vec3f(d));
    m.normal_indices.reserve(m.indices.size());
    for (std::size_t i = 0; i < balls.size(); ++i)
      m.normal_indices.insert(m.normal_indices.end(), sphere.indices.begin(), sphere.indices.end());
  }
  return m;
}

double sphereflake_triangles(const arguments& a) {
  const double balls = (std::pow(9.0, a["depth"] + 1) - 1) / 8;
  return balls * 20 * std::pow(4.0, a["subdivisions"]);
}

/// A cell is solid unless at some scale it lies in the middle third of two axes or of all three.
bool menger_solid(std::array<std::uint32_t, 3> cell, std::uint32_t cells) {
  if (*std::max_element(cell.begin(), cell.end()) >= cells) return false;  // -1 wraps: outside too
  for (; cell[0] || cell[1] || cell[2]; cell[0] /= 3, cell[1] /= 3, cell[2] /= 3)
    if ((cell[0] % 3 == 1) + (cell[1] % 3 == 1) + (cell[2] % 3 == 1) >= 2) return false;
  return true;
}

/// The vertices of a grid with `n` + 1 points a side, made when they are first asked for.
class shared_grid {
 public:
  shared_grid(mesh& m, std::uint32_t n, double size)
      : mesh_(m), n_(n), size_(size), ids_(std::size_t(n + 1) * (n + 1) * (n + 1), unused) {}

  std::uint32_t at(std::array<std::uint32_t, 3> p) {
    std::uint32_t& id = ids_[(std::size_t(p[2]) * (n_ + 1) + p[1]) * (n_ + 1) + p[0]];
    if (id == unused) {
      id = std::uint32_t(mesh_.positions.size());
      mesh_.positions.push_back(vec3f(vec3d(along(p[0]), along(p[1]), along(p[2]))));
    }
    return id;
  }

 private:
  static constexpr std::uint32_t unused = 0xffffffffu;
  double along(std::uint32_t i) const { return size_ * (double(i) / n_ - 0.5); }

  mesh& mesh_;
  std::uint32_t n_;
  double size_;
  std::vector<std::uint32_t> ids_;
};

mesh make_menger(const arguments& a) {
  std::uint32_t n = 1;
  for (std::uint32_t level = 0; level < a.whole("depth"); ++level) n *= 3;
  mesh m;
  shared_grid grid(m, n, a["size"]);
  const auto add_faces = [&](std::array<std::uint32_t, 3> cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool upper : {false, true}) {
        auto neighbour = cell;
        neighbour[axis] += upper ? 1u : ~0u;
        if (menger_solid(neighbour, n)) continue;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 3> corner = cell;
        corner[axis] += upper ? 1 : 0;
        const auto offset = [&](std::uint32_t du, std::uint32_t dv) {
          auto p = corner;
          p[u] += du, p[v] += dv;
          return grid.at(p);
        };
        const std::uint32_t p00 = offset(0, 0), p10 = offset(1, 0), p11 = offset(1, 1),
                            p01 = offset(0, 1);
        if (upper)
          add_quad(m, p00, p10, p11, p01);
        else
          add_quad(m, p00, p01, p11, p10);
      }
  };
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x)
        if (menger_solid({x, y, z}, n)) add_faces({x, y, z});
  return m;
}

/// Faces of cells that border on no other cell: 2 * 20^d + 4 * 8^d, by induction over d; each is
/// two triangles.
double menger_triangles(const arguments& a) {
  return 2 * (2 * std::pow(20.0, a["depth"]) + 4 * std::pow(8.0, a["depth"]));
}

}  // namespace

std::vector<generator> recursive_generators() {
  return {
      {{"sphereflake",
        {whole_parameter("depth", 3, 0, 8,
                         "levels below the first sphere; (9^(depth+1) - 1) / 8 "
                         "spheres"),
         whole_parameter("subdivisions", 2, 0, 8, "of each icosphere"),
         length_parameter("radius", 1, "of the first sphere; the flake stays within 2 radii"),
         smooth_parameter(true)},
        "Haines' flake around the origin: nine spheres of a third of the radius on each sphere, "
        "the first facing +y; closed and disjoint"},
       sphereflake_triangles,
       make_sphereflake},
      {{"menger",
        {whole_parameter("depth", 3, 0, 6, "times that each cube becomes 20"),
         length_parameter("size", 1, "length of a side")},
        "a closed Menger sponge around the origin"},
       menger_triangles,
       make_menger},
  };
}

}  // namespace facet
