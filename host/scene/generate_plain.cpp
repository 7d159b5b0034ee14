// Plane, box, cylinder and room.
#include <cmath>
#include <numbers>

#include "scene/generator.hpp"

namespace facet {
namespace {

/// A grid of `n` by `n` squares over the parallelogram at `corner` with the sides `u` and `v`,
/// facing u x v; positions are appended.
void add_grid(mesh& m, vec3d corner, vec3d u, vec3d v, std::uint32_t n) {
  const auto first = std::uint32_t(m.positions.size());
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      m.positions.push_back(vec3f(corner + u * (double(i) / n) + v * (double(j) / n)));
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = first + j * (n + 1) + i, b = a + n + 1;
      add_quad(m, a, a + 1, b + 1, b);
    }
}

mesh make_plane(const arguments& a) {
  const double h = a["size"] / 2;
  mesh m;
  add_grid(m, {-h, 0, h}, {2 * h, 0, 0}, {0, 0, -2 * h}, a.whole("divisions"));
  return m;
}

mesh make_box(const arguments& a) {
  const vec3d h = vec3d(a["x"], a["y"], a["z"]) * (a["size"] / 2);
  mesh m;
  for (int corner = 0; corner < 8; ++corner)
    m.positions.push_back(
        vec3f(vec3d(corner & 1 ? h.x : -h.x, corner & 2 ? h.y : -h.y, corner & 4 ? h.z : -h.z)));
  add_quad(m, 0, 2, 3, 1), add_quad(m, 4, 5, 7, 6);  // -z, +z
  add_quad(m, 0, 1, 5, 4), add_quad(m, 2, 6, 7, 3);  // -y, +y
  add_quad(m, 0, 4, 6, 2), add_quad(m, 1, 3, 7, 5);  // -x, +x
  return m;
}

/// Vertices: side s has 2s at the bottom and 2s + 1 at the top; then the two centres. Normals: one
/// for each side line, then down and up.
mesh make_cylinder(const arguments& a) {
  const std::uint32_t sides = a.whole("sides"), bottom = 2 * sides, top = bottom + 1;
  const double radius = a["radius"], h = a["height"] / 2;
  mesh m;
  for (std::uint32_t s = 0; s < sides; ++s) {
    const double angle = 2 * std::numbers::pi * s / sides;
    const vec3d out(std::cos(angle), 0, -std::sin(angle));
    m.positions.push_back(vec3f(out * radius - vec3d(0, h, 0)));
    m.positions.push_back(vec3f(out * radius + vec3d(0, h, 0)));
    if (a.on("smooth")) m.normals.push_back(vec3f(out));
  }
  m.positions.push_back(vec3f(vec3d(0, -h, 0)));
  m.positions.push_back(vec3f(vec3d(0, h, 0)));
  if (a.on("smooth")) m.normals.insert(m.normals.end(), {vec3f(0, -1, 0), vec3f(0, 1, 0)});
  for (std::uint32_t s = 0; s < sides; ++s) {
    const std::uint32_t n = (s + 1) % sides, down = sides, up = sides + 1;
    add_quad(m, 2 * s, 2 * n, 2 * n + 1, 2 * s + 1);
    add_triangle(m, bottom, 2 * n, 2 * s);
    add_triangle(m, top, 2 * s + 1, 2 * n + 1);
    if (a.on("smooth"))
      m.normal_indices.insert(m.normal_indices.end(),
                              {s, n, n, s, n, s, down, down, down, up, up, up});
  }
  return m;
}

/// Walls share no vertices: each is a plane of its own, and they meet exactly at the corners.
mesh make_room(const arguments& a) {
  const double s = a["size"], h = s / 2;
  const vec3d x(s, 0, 0), y(0, s, 0), z(0, 0, s);
  mesh m;
  add_grid(m, {-h, 0, h}, x, -z, 1);  // floor
  add_grid(m, {-h, s, -h}, x, z, 1);  // ceiling
  add_grid(m, {-h, 0, -h}, x, y, 1);  // back wall
  add_grid(m, {-h, 0, h}, -z, y, 1);  // left wall
  add_grid(m, {h, 0, -h}, z, y, 1);   // right wall
  for (std::uint32_t wall = 0; wall < 5; ++wall) m.materials.insert(m.materials.end(), 2, wall);
  return m;
}

}  // namespace

std::vector<generator> plain_generators() {
  return {
      {{"plane",
        {length_parameter("size", 1, "length of a side"),
         whole_parameter("divisions", 1, 1, 8000, "squares along a side")},
        "a square at y = 0 around the origin, facing +y"},
       [](const arguments& a) { return 2 * a["divisions"] * a["divisions"]; },
       make_plane},
      {{"box",
        {length_parameter("size", 1, "scales all three"),
         length_parameter("x", 1, "length along x, in sizes"),
         length_parameter("y", 1, "length along y, in sizes"),
         length_parameter("z", 1, "length along z, in sizes")},
        "a closed box around the origin"},
       [](const arguments&) { return 12.0; },
       make_box},
      {{"cylinder",
        {length_parameter("radius", 0.5, "of the circle through its side lines"),
         length_parameter("height", 1, "along y"),
         whole_parameter("sides", 64, 3, 1 << 20, "flat sides; 3 to 8 make prisms"),
         smooth_parameter(false)},
        "a closed cylinder or prism around the origin, along y"},
       [](const arguments& a) { return 4 * a["sides"]; },
       make_cylinder},
      {{"room",
        {length_parameter("size", 2, "length of a side")},
        "a cube's floor (at y = 0), ceiling, back, left and right wall, facing inwards and open to "
        "+z; material slots 0 floor, 1 ceiling, 2 back, 3 left (-x), 4 right (+x)"},
       [](const arguments&) { return 10.0; },
       make_room},
  };
}

}  // namespace facet
