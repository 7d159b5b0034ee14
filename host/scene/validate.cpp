#include "scene/validate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scene/error.hpp"
#include "scene/place.hpp"
#include "scene/world_bounds.hpp"

namespace facet {
namespace {

/// A unit normal that was rounded to float components is 1 within 2^-23; one from a file with
/// four decimals within 1e-3.
constexpr double unit_length_slack = 1e-3;

std::string text_of(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", v);
  return buffer;
}

/// The scene, with the rules for it; each throws at the first fault.
class checker {
 public:
  checker(const scene& s, const std::string& file) : scene_(s), file_(file) {}

  void picture() const {
    whole("/picture/width", scene_.width, 1, limits::image_side);
    whole("/picture/height", scene_.height, 1, limits::image_side);
    whole("/picture/max_depth", scene_.max_depth, 0, limits::max_depth);
    whole("/picture/samples", scene_.samples, 1, limits::samples);
    whole("/nesting", scene_.nesting, 1, limits::nesting);
    at_least_0("/ambient", scene_.ambient);
    at_least_0("/background", scene_.background);
    if (!(scene_.background_alpha >= 0 && scene_.background_alpha <= 1))
      fail("/background/3",
           "the alpha is " + text_of(scene_.background_alpha) + "; it must be from 0 to 1");
  }

  void camera() const {
    within_reach("/camera/position", scene_.view.position);
    within_reach("/camera/look_at", scene_.view.look_at);
    if (!is_finite(scene_.view.up)) fail("/camera/up", "is not finite");
    try {
      frame_of(scene_.view, scene_.width, scene_.height);
    } catch (const scene_error& e) {
      fail(e.place(), e.message());
    }
  }

  void materials() const {
    if (scene_.materials.empty()) fail("/materials", "is empty; a scene has at least one material");
    count("/materials", scene_.materials.size(), limits::materials);
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
      material_rules(scene_.materials[i], named("/materials", scene_.materials[i].name, i));
  }

  void meshes() const {
    count("/meshes", scene_.triangle_count(), limits::triangles, "triangles");
    for (std::size_t i = 0; i < scene_.meshes.size(); ++i) one_mesh(i);
  }

  void one_mesh(std::size_t i) const {
    mesh_rules(scene_.meshes[i], named("/meshes", scene_.meshes[i].name, i));
  }

  void instances() const {
    count("/instances", scene_.instances.size(), limits::instances);
    std::vector<box3f> bounds;
    for (const mesh& m : scene_.meshes) bounds.push_back(m.bounds());
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
      const instance& placed = scene_.instances[i];
      if (placed.mesh >= scene_.meshes.size())
        fail(member("/instances", i, "mesh"), "is mesh " + std::to_string(placed.mesh) +
                                                  "; the scene has " +
                                                  std::to_string(scene_.meshes.size()));
      if (placed.material != instance::own_materials && placed.material >= scene_.materials.size())
        fail(member("/instances", i, "material"), "is material " + std::to_string(placed.material) +
                                                      "; the scene has " +
                                                      std::to_string(scene_.materials.size()));
      validate_transform(placed.world_from_object, bounds[placed.mesh], i, file_);
    }
  }

  void lights() const {
    count("/lights", scene_.lights.size(), limits::lights);
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const light& l = scene_.lights[i];
      at_least_0(member("/lights", i, "colour"), l.colour);
      if (l.type == light::kind::point) {
        within_reach(member("/lights", i, "position"), l.position);
        for (float a : {l.constant, l.linear, l.quadratic})
          if (!(a >= 0) || !std::isfinite(a))
            fail(member("/lights", i, "attenuation"),
                 "holds " + text_of(a) + "; its three numbers must be finite and at least 0");
      } else if (!is_finite(l.direction) || l.direction == vec3d{}) {
        fail(member("/lights", i, "direction"),
             is_finite(l.direction) ? "is 0; it must point somewhere, with any length"
                                    : "is not finite");
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& what) const {
    throw scene_error(file_, place, what);
  }

  static std::string named(const std::string& parent, const std::string& name, std::size_t index) {
    return name.empty() ? place_in(parent, index) : place_in(parent, name);
  }
  static std::string member(const std::string& parent, std::size_t index, const char* key) {
    return place_in(place_in(parent, index), key);
  }

  void whole(const std::string& place, std::uint32_t v, std::uint32_t least,
             std::uint32_t most) const {
    if (v < least || v > most)
      fail(place, "is " + std::to_string(v) + "; it must be from " + std::to_string(least) +
                      " to " + std::to_string(most));
  }

  void count(const std::string& place, std::size_t n, std::size_t most,
             const std::string& what = "elements") const {
    if (n > most)
      fail(place, "holds " + std::to_string(n) + ' ' + what + "; at most " + std::to_string(most) +
                      " are allowed");
  }

  void at_least_0(const std::string& place, vec3f colour, float most = INFINITY) const {
    for (int i = 0; i < 3; ++i) {
      if (colour[i] >= 0 && colour[i] <= most && std::isfinite(colour[i])) continue;
      const char* const channel = i == 0 ? "red" : i == 1 ? "green" : "blue";
      fail(place, std::string("has ") + channel + ' ' + text_of(colour[i]) + "; each channel " +
                      (std::isinf(most) ? "must be finite and at least 0" : "must be from 0 to 1"));
    }
  }

  void within_reach(const std::string& place, vec3d p) const {
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(p[i]) <= double(limits::coordinate)))
        fail(place, "holds the coordinate " + text_of(p[i]) +
                        "; coordinates must be finite and at most 1e18 in size");
  }

  void material_rules(const material& m, const std::string& place) const {
    at_least_0(place + "/Ke", m.Ke);
    at_least_0(place + "/Ka", m.Ka);
    at_least_0(place + "/Kd", m.Kd);
    at_least_0(place + "/Ks", m.Ks);
    at_least_0(place + "/Kr", m.Kr, 1);
    at_least_0(place + "/Kt", m.Kt, 1);
    if (!(m.Ns >= 0) || !std::isfinite(m.Ns))
      fail(place + "/Ns", "is " + text_of(m.Ns) + "; it must be finite and at least 0");
    if (!(m.Ni > 0) || !std::isfinite(m.Ni))
      fail(place + "/Ni", "is " + text_of(m.Ni) + "; it must be finite and greater than 0");
    if (m.has_attenuation) at_least_0(place + "/attenuation", m.attenuation, 1);
    if (!(m.attenuation_distance > 0) || !std::isfinite(m.attenuation_distance))
      fail(place + "/attenuation_distance",
           "is " + text_of(m.attenuation_distance) + "; it must be finite and greater than 0");
    const vec3d sigma = m.absorption();
    if (std::max({sigma.x, sigma.y, sigma.z}) > double(std::numeric_limits<float>::max()))
      fail(place + "/attenuation_distance",
           "is " + text_of(m.attenuation_distance) +
               ", so small that the absorption does not fit a float; make it larger, or make the "
               "material opaque");
  }

  void mesh_rules(const mesh& m, const std::string& place) const {
    const std::size_t n = m.triangle_count();
    if (n == 0) fail(place, "has no triangles; a mesh has at least one");
    if (m.indices.size() % 3 != 0) fail(place, "has a number of indices that is not 3 a triangle");
    per_triangle(place, "normal indices", m.normal_indices.size(), 3 * n);
    per_triangle(place, "materials", m.materials.size(), n);
    per_triangle(place, "source indices", m.source.size(), n);
    pointing_within(place, "position", m.indices, m.positions.size(), 3);
    pointing_within(place, "normal", m.normal_indices, m.normals.size(), 3);
    pointing_within(place, "material", m.materials, scene_.materials.size(), 1);
    for (std::size_t i = 0; i < m.indices.size(); ++i) {
      const vec3f p = m.positions[m.indices[i]];
      // Written so that a NaN fails, too.
      if (!(std::abs(p.x) <= limits::coordinate && std::abs(p.y) <= limits::coordinate &&
            std::abs(p.z) <= limits::coordinate))
        fail(place, "triangle " + std::to_string(i / 3) + " has a corner at (" + text_of(p.x) +
                        ", " + text_of(p.y) + ", " + text_of(p.z) +
                        "); coordinates must be finite and at most 1e18 in size");
    }
    for (std::size_t i = 0; i < m.normals.size(); ++i)
      if (!(std::abs(length(vec3d(m.normals[i])) - 1) <= unit_length_slack))
        fail(place, "normal " + std::to_string(i) + " is not of length 1");
  }

  void per_triangle(const std::string& place, const char* what, std::size_t n,
                    std::size_t all) const {
    if (n != 0 && n != all)
      fail(place, "has " + std::to_string(n) + ' ' + what + "; it must have none or " +
                      std::to_string(all));
  }

  void pointing_within(const std::string& place, const char* what,
                       const std::vector<std::uint32_t>& indices, std::size_t n,
                       std::size_t each) const {
    for (std::size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= n)
        fail(place, "triangle " + std::to_string(i / each) + " uses " + what + ' ' +
                        std::to_string(indices[i]) + "; there are " + std::to_string(n) +
                        ", counted from 0");
  }

  const scene& scene_;
  const std::string& file_;
};

}  // namespace

void validate(const scene& s, const std::string& file) {
  const checker check(s, file);
  check.picture();
  check.camera();
  check.materials();
  check.meshes();
  check.instances();
  check.lights();
}

void validate_transform(const transform& t, const box3f& mesh_bounds, std::size_t index,
                        const std::string& file) {
  const auto fail = [&](const std::string& what) {
    throw scene_error(file, place_in(place_in("/instances", index), "transform"), what);
  };
  double rows = 1;
  for (const auto& r : t.row) {
    for (double v : r)
      if (!std::isfinite(v)) fail("holds a number that is not finite");
    rows *= std::hypot(r[0], r[1], r[2]);
  }
  // The determinant's 6 products are at most `rows` each and the sum is rounded fewer than 9
  // times by 2^-53, so below 54 * 2^-53 < 2^-47 of `rows` it is nothing but rounding.
  if (!(std::abs(t.determinant()) > 0x1p-47 * rows))
    fail(
        "is singular: it flattens the mesh (a scale of 0, or rows that depend on each other); "
        "use a thin scale such as 0.001");
  const transform inverse = t.inverse();
  for (const transform* each : {&t, &inverse})
    for (const auto& r : each->row)
      for (double v : r)
        if (!(std::abs(v) <= double(limits::coordinate)))
          fail("or its inverse holds " + text_of(v) + "; at most 1e18 in size is allowed");
  const box3d box = world_box<double>(t, mesh_bounds);
  for (vec3d corner : {box.lo, box.hi})
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(corner[i]) <= double(limits::coordinate)))
        fail("moves the mesh to the coordinate " + text_of(corner[i]) +
             "; coordinates may be at most 1e18 in size");
}

void validate_mesh(const scene& s, std::size_t mesh, const std::string& file) {
  checker(s, file).one_mesh(mesh);
}

}  // namespace facet
