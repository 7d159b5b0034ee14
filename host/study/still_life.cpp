#include "study/still_life.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/generate.hpp"

namespace facet::study {
namespace {

enum : std::uint32_t { clay, glass, mirror, floor_stone };

std::vector<material> materials() {
  std::vector<material> all(4);
  all[clay].name = "clay";
  all[clay].Kd = {0.56f, 0.35f, 0.21f};
  all[clay].Ks = {0.3f, 0.3f, 0.3f};
  all[clay].Ns = 30;
  all[glass].name = "glass";
  all[glass].Kd = {0.05f, 0.05f, 0.05f};
  all[glass].Kr = {0.1f, 0.1f, 0.1f};
  all[glass].Kt = {0.81f, 0.88f, 0.83f};
  all[glass].Ni = 1.5f;
  all[mirror].name = "mirror";
  all[mirror].Kd = {0.1f, 0.1f, 0.1f};
  all[mirror].Kr = {0.8f, 0.8f, 0.8f};
  all[floor_stone].name = "floor";
  all[floor_stone].Kd = {0.36f, 0.36f, 0.36f};
  all[floor_stone].Kr = {0.25f, 0.25f, 0.25f};
  return all;
}

transform standing(const mesh& m) {
  constexpr double far = std::numeric_limits<double>::infinity();
  vec3d lo{far, far, far}, hi{-far, -far, -far};
  for (const vec3f& p : m.positions)
    for (int k = 0; k < 3; ++k)
      lo[k] = std::min(lo[k], double(p[k])), hi[k] = std::max(hi[k], double(p[k]));
  const vec3d side = hi - lo;
  const double scale = 1 / std::max({side.x, side.y, side.z});
  return transform::scale({scale, scale, scale}) *
         transform::translate({-(lo.x + hi.x) / 2, -lo.y, -(lo.z + hi.z) / 2});
}

light lamp(vec3d position, float brightness) {
  light l;
  l.position = position;
  l.colour = {brightness, brightness, brightness};
  return l;
}

}  // namespace

scene still_life(mesh m) {
  scene s;
  s.name = "still life";
  s.width = 1920, s.height = 1080;
  s.max_depth = 5;
  s.background = {0.4f, 0.5f, 0.7f};
  s.materials = materials();
  s.view.position = {1.6, 1.1, 2.4};
  s.view.look_at = {0, 0.45, 0};
  const double across = std::tan(25 * std::numbers::pi / 180);  // 50 degrees from left to right
  s.view.vertical_fov = 2 * std::atan(across * s.height / s.width) * 180 / std::numbers::pi;
  s.instances = {{0, standing(m), clay},
                 {1, transform::translate({0.75, 0.32, 0.6}), glass},
                 {2, transform::translate({-0.85, 0.35, -0.3}), mirror},
                 {3, transform(), floor_stone}};
  s.meshes.push_back(std::move(m));
  for (const double radius : {0.32, 0.35})
    s.meshes.push_back(
        generate("icosphere", {{"radius", radius}, {"subdivisions", 5}, {"smooth", 1}}));
  s.meshes.push_back(generate("plane", {{"size", 18}, {"divisions", 1}}));
  s.lights = {lamp({4, 6, 3}, 0.7f), lamp({-5, 4, 4}, 0.4f)};
  return s;
}

}  // namespace facet::study
