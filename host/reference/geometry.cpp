#include "reference/geometry.hpp"

#include <cmath>
#include <limits>
#include <span>

#include "reference/visit.hpp"
#include "scene/shut.hpp"
#include "scene/world_bounds.hpp"

namespace facet::reference {
namespace {

template <class T>
vec3<T> extent_of(const box3<T>& b) {
  return b.empty() ? vec3<T>() : max(abs(b.lo), abs(b.hi));
}

/// The smallest float box around b.
template <class T>
box3f outward(const box3<T>& b) {
  box3f r{vec3f(b.lo), vec3f(b.hi)};
  for (int i = 0; i < 3; ++i) {
    if (T(r.lo[i]) > b.lo[i]) r.lo[i] = std::nextafter(r.lo[i], -INFINITY);
    if (T(r.hi[i]) < b.hi[i]) r.hi[i] = std::nextafter(r.hi[i], INFINITY);
  }
  return r;
}

}  // namespace

mesh_tree::mesh_tree(const mesh& m)
    : bounds(m.bounds()), extent(extent_of(bounds)), is_shut(shut_triangles(m)) {
  std::vector<box3f> boxes;
  std::vector<std::uint32_t> owners;
  for (std::uint32_t i = 0; i < m.triangle_count(); ++i) {
    if (is_shut[i]) continue;
    const corners<float> p{m.position(i, 0), m.position(i, 1), m.position(i, 2)};
    boxes.push_back(bounds_of(p));
    owners.push_back(i);
  }
  tree = wide_tree(boxes, tree_width);
  for (std::uint32_t& i : tree.order) i = owners[i];

  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  blocks.resize(tree.leaf_count());
  for (std::size_t leaf = 0; leaf < blocks.size(); ++leaf) {
    const auto triangles = tree.leaf(leaf);
    triangle_block& b = blocks[leaf];
    b.triangle.fill(miss);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        b.corner[c][axis].fill(nothing);
        for (std::size_t k = 0; k < triangles.size(); ++k)
          b.corner[c][axis][k] = m.position(triangles[k], int(c))[int(axis)];
      }
    for (std::size_t k = 0; k < triangles.size(); ++k) b.triangle[k] = triangles[k];
  }
}

template <class T>
geometry<T>::geometry(const scene& s) : scene_(s) {
  for (const mesh& m : s.meshes) meshes_.emplace_back(m);

  std::vector<box3f> boxes;
  std::vector<std::uint32_t> owners;
  box3<T> world;
  for (const instance& i : s.instances) {
    placement<T> p{
        affine<T>(i.world_from_object), affine<T>(i.world_from_object.inverse()), {}, false};
    p.world_box = world_box<T>(i.world_from_object, meshes_[i.mesh].bounds);
    if (!p.world_box.empty()) {
      world.add(p.world_box);
      boxes.push_back(outward(p.world_box));
      owners.push_back(std::uint32_t(placements_.size()));
    }
    placements_.push_back(p);
  }
  extent_ = extent_of(world);
  for (std::size_t i = 0; i < placements_.size(); ++i)
    placements_[i].is_plain = s.instances[i].world_from_object.is_identity() &&
                              vec3<T>(meshes_[s.instances[i].mesh].extent) == extent_;
  tree_ = wide_tree(boxes, 1);
  for (std::uint32_t& i : tree_.order) i = owners[i];
}

template <class T>
hit<T> geometry<T>::closest(const ray<T>& r, road by) const {
  const T tmin = r.tmin > 0 ? r.tmin : 0;
  hit<T> best;
  best.t = r.tmax;
  visit(r, best.t, by, [&](const candidate<T>& c) {
    if (const auto h = c.test().accept(c.outer(), tmin, r.tmax)) {
      const hit<T> found{h->t, h->u, h->v, c.instance, c.triangle};
      if (found < best) best = found;
    }
    return false;
  });
  return best;
}

template <class T>
bool geometry<T>::occluded(const ray<T>& r, road by) const {
  const T tmin = r.tmin > 0 ? r.tmin : 0;
  return visit(r, r.tmax, by, [&](const candidate<T>& c) {
    return c.test().accept(c.outer(), tmin, r.tmax).has_value();
  });
}

template class geometry<float>;
template class geometry<double>;

}  // namespace facet::reference
