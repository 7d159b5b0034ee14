#include "tracer/wide_geometry.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tree_walk_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;

namespace {

device_geometry geometry_of(const scene& s, tree_kind kind = tree_kind::levels) {
  const features f = features::of(s);
  return build_wide_geometry(test::queue(), kernel_sources(), pack(s, f.smooth), f, kind,
                             tuning_for(test::device()), {});
}

std::vector<TriangleBlock> blocks_of(const device_geometry& g) {
  const auto texels = content(g.corners);
  const auto* first = reinterpret_cast<const TriangleBlock*>(texels.data());
  return {first, first + texels.size() * sizeof(texel) / sizeof(TriangleBlock)};
}

using corners = std::array<vec3f, 3>;

corners triangle_in(const std::vector<TriangleBlock>& blocks, std::size_t slot) {
  const TriangleBlock& b = blocks[slot / FACET_BLOCK];
  const std::size_t lane = slot % FACET_BLOCK;
  corners p;
  for (std::size_t k = 0; k < 3; ++k)
    p[k] = {b.corner[k][0][lane], b.corner[k][1][lane], b.corner[k][2][lane]};
  return p;
}

bool is_triangle_of(const mesh& m, std::uint32_t t, const corners& p) {
  return p[0] == m.position(t, 0) && p[1] == m.position(t, 1) && p[2] == m.position(t, 2);
}

}  // namespace

TEST_CASE("wide: each block is one leaf, every node holds what is below it, the stack suffices") {
  std::vector<std::uint32_t> sizes(40);
  std::iota(sizes.begin(), sizes.end(), 1u);
  sizes.insert(sizes.end(), {64, 65, 1000, 5000});
  for (const std::uint32_t n : sizes) {
    CAPTURE(n);
    const device_geometry g = geometry_of(test::one_mesh(test::random_soup(n, n)));
    const auto nodes = content(g.wide_nodes);
    const auto blocks = blocks_of(g);
    std::multiset<std::uint32_t> leaves;
    std::uint32_t escaped = 0;
    test::tree_walk<WideNode> w{nodes, {}};
    w.at_leaf = [&](std::uint32_t leaf, const test::tree_way& way) {
      const std::uint32_t block = FACET_LEAF_FIRST(leaf);
      CHECK(FACET_LEAF_COUNT(leaf) == 1);
      leaves.insert(block);
      for (std::size_t lane = 0; lane < FACET_BLOCK; ++lane)
        for (const vec3f& p : triangle_in(blocks, block * FACET_BLOCK + lane))
          escaped += w.escaped(p, way);
    };
    w.down(content(g.world)[0].root);
    CHECK(escaped == 0);
    CHECK(leaves.size() == blocks.size());
    CHECK(std::set<std::uint32_t>(leaves.begin(), leaves.end()).size() == blocks.size());
    CHECK(g.stack == 7 * w.deepest);
    CHECK(w.deepest <= g.depth);
    // Of the binary tree, each leaf of which is a block.
    CHECK(g.nodes_used + 1 == content(g.infos).size() / FACET_BLOCK);
  }
}

TEST_CASE("wide: each triangle is in one lane; the others are segments of their block's first") {
  for (const tree_kind kind : {tree_kind::levels, tree_kind::none}) {
    scene s = test::one_mesh(test::random_soup(777, 3));
    s.materials.resize(5);
    for (std::uint32_t t = 0; t < 777; ++t) s.meshes[0].materials.push_back(t % 5);
    const device_geometry g = geometry_of(s, kind);
    const auto infos = content(g.infos);
    const auto blocks = blocks_of(g);
    REQUIRE(infos.size() == FACET_BLOCK * blocks.size());
    CHECK(content(g.world)[0].triangle_count == infos.size());
    std::map<std::uint32_t, int> lanes;
    std::uint32_t absent = 0;
    for (std::size_t slot = 0; slot < infos.size(); ++slot) {
      const TriangleInfo& i = infos[slot];
      CHECK(i.material == i.triangle % 5);
      const corners p = triangle_in(blocks, slot);
      if (is_triangle_of(s.meshes[0], i.triangle, p)) {
        ++lanes[i.triangle];
        if (kind == tree_kind::none) CHECK(i.triangle == slot);
        continue;
      }
      ++absent;
      CHECK(slot % FACET_BLOCK > 0);
      CHECK(i.triangle == infos[slot - slot % FACET_BLOCK].triangle);
      CHECK(p[0] == p[1]);
      CHECK(p[0] == s.meshes[0].position(i.triangle, 0));
      CHECK(p[2] == s.meshes[0].position(i.triangle, 1));
    }
    CHECK(lanes.size() == 777);
    CHECK(std::all_of(lanes.begin(), lanes.end(), [](const auto& l) { return l.second == 1; }));
    CHECK(absent == infos.size() - 777);
  }
}

TEST_CASE("wide: normals stand by slot, instances in the order of the top's leaves") {
  const scene s = test::many_instances();
  const device_geometry g = geometry_of(s);
  const auto infos = content(g.infos);
  const auto normals = content(g.normals);
  const auto instances = content(g.instances);
  CHECK(normals.size() == 3 * infos.size());
  std::set<std::uint32_t> ids;
  for (const Instance& i : instances) {
    ids.insert(i.id);
    const mesh& m = s.meshes[s.instances[i.id].mesh];
    CHECK(i.first_triangle % FACET_BLOCK == 0);
    REQUIRE(i.first_triangle + i.triangle_count <= infos.size());
    std::set<std::uint32_t> met;
    std::size_t different = 0;
    for (std::uint32_t k = 0; k < i.triangle_count; ++k) {
      const std::uint32_t slot = i.first_triangle + k, t = infos[slot].triangle;
      met.insert(t);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const vec3f n = m.is_smooth() ? m.normals[m.indices[3 * t + c]] : vec3f();
        different += normals[3 * slot + c] != texel{n.x, n.y, n.z, 0};
      }
    }
    CHECK(different == 0);
    CHECK(met.size() == m.triangle_count());
  }
  CHECK(ids.size() == s.instances.size());
}
