#include "scene/world_bounds.hpp"

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace facet {
namespace {

template <class T>
constexpr double growth = std::is_same_v<T, float> ? 0x1p-20 : 0x1p-45;

template <class T>
T rounded_down(double v) {
  const T r = T(v);
  return double(r) > v ? std::nextafter(r, -std::numeric_limits<T>::infinity()) : r;
}

template <class T>
T rounded_up(double v) {
  const T r = T(v);
  return double(r) < v ? std::nextafter(r, std::numeric_limits<T>::infinity()) : r;
}

}  // namespace

template <class T>
box3<T> world_box(const transform& world_from_object, const box3f& mesh_bounds) {
  box3<T> result;
  if (mesh_bounds.empty()) return result;
  if (world_from_object.is_identity()) {
    result.lo = vec3<T>(mesh_bounds.lo), result.hi = vec3<T>(mesh_bounds.hi);
    return result;
  }
  const vec3d lo(mesh_bounds.lo), hi(mesh_bounds.hi), largest = max(abs(lo), abs(hi));
  box3d exact;
  for (int corner = 0; corner < 8; ++corner)
    exact.add(world_from_object.point(
        {corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z}));
  for (int i = 0; i < 3; ++i) {
    const auto& m = world_from_object.row[i];
    const double size =
        ((std::abs(m[0]) * largest.x + std::abs(m[1]) * largest.y) + std::abs(m[2]) * largest.z) +
        std::abs(m[3]);
    result.lo[i] = rounded_down<T>(exact.lo[i] - growth<T> * size);
    result.hi[i] = rounded_up<T>(exact.hi[i] + growth<T> * size);
  }
  return result;
}

template <class T>
box3<T> world_box(const instance& placed, const mesh& m) {
  return world_box<T>(placed.world_from_object, m.bounds());
}

template <class T>
box3<T> world_box(const scene& s) {
  std::vector<box3f> bounds;
  for (const mesh& m : s.meshes) bounds.push_back(m.bounds());
  box3<T> result;
  for (const instance& placed : s.instances)
    result.add(world_box<T>(placed.world_from_object, bounds.at(placed.mesh)));
  return result;
}

template box3<float> world_box<float>(const transform&, const box3f&);
template box3<double> world_box<double>(const transform&, const box3f&);
template box3<float> world_box<float>(const instance&, const mesh&);
template box3<double> world_box<double>(const instance&, const mesh&);
template box3<float> world_box<float>(const scene&);
template box3<double> world_box<double>(const scene&);

}  // namespace facet
