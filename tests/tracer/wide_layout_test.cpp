#include "tracer/wide_layout.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tracer/device_helper.hpp"
#include "tracer/given_tree.hpp"
#include "tracer/kernels.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tree_walk_helper.hpp"
#include "tracer/wide_geometry.hpp"

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

float half_area(const TreeNode& n) {
  const float x = n.hi[0] - n.lo[0], y = n.hi[1] - n.lo[1], z = n.hi[2] - n.lo[2];
  return x * y + y * z + z * x;
}

/// The areas of wide nodes where of each one's children the largest is opened until they are eight.
double opened_largest_first(const host_binary_tree& t, std::uint32_t i, std::uint32_t lanes) {
  const auto is_leaf = [&](std::uint32_t k) { return t.nodes[k].last - t.nodes[k].first < lanes; };
  if (is_leaf(i)) return 0;
  std::vector<std::uint32_t> child{i};
  while (child.size() < 8) {
    std::size_t largest = child.size();
    for (std::size_t k = 0; k < child.size(); ++k)
      if (!is_leaf(child[k]) && (largest == child.size() ||
                                 half_area(t.nodes[child[k]]) > half_area(t.nodes[child[largest]])))
        largest = k;
    if (largest == child.size()) break;
    child.push_back(t.nodes[child[largest]].right);
    child[largest] = t.nodes[child[largest]].left;
  }
  double sum = half_area(t.nodes[i]);
  for (const std::uint32_t c : child) sum += opened_largest_first(t, c, lanes);
  return sum;
}

double areas(const std::vector<WideNode>& nodes) {
  double sum = 0;
  for (const WideNode& n : nodes) {
    const auto extent = [](const float(&axis)[2][8]) {
      return *std::max_element(axis[1], axis[1] + 8) - *std::min_element(axis[0], axis[0] + 8);
    };
    const double x = extent(n.x), y = extent(n.y), z = extent(n.z);
    sum += x * y + y * z + z * x;
  }
  return sum;
}

}  // namespace

TEST_CASE("wide: each block is one leaf, every node holds what is below it, the stack suffices") {
  for (std::uint32_t n : {1u, 2u, 8u, 9u, 17u, 64u, 65u, 1000u}) {
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
    CHECK(g.nodes_used == 2 * std::uint64_t(n) - 1);
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

TEST_CASE("wide: no ray meets a lane without a triangle, aimed along its segment or at its ends") {
  // One triangle, so that seven of the eight lanes are a segment of it. Whole coordinates as well
  // as any: with the former edge functions are 0 where a ray meets the segment, or its line.
  runtime::source_tree sources = kernel_sources();
  sources.files["absent_test.cl"] =
      "#include \"triangle.h\"\n"
      "__kernel void ask(__global const float4* block, __global const Ray* rays, __global uint* "
      "met) {\n"
      "  const size_t i = get_global_id(0);\n"
      "  Space s;\n"
      "  TriangleHits hits;\n"
      "  const Interval outer = {-INFINITY, INFINITY};\n"
      "  met[i] = 0u;\n"
      "  if (space_of(&s, vec_global(rays[i].origin), vec_global(rays[i].direction), "
      "(float3)(4.0f)))\n"
      "    met[i] = 256u | (hit_triangles(&s, triangles_from(block, 0u), outer, 0.0f,\n"
      "                                              INFINITY, false, &hits));\n"
      "}\n";
  runtime::queue& q = test::queue();
  runtime::program program(q.get_context(), sources, "absent_test.cl",
                           "-DFACET_WIDE" + tuning_for(test::device()).flags());
  runtime::kernel ask = program.get_kernel("ask");
  test::random r(5);
  for (int k = 0; k < 40; ++k) {
    const bool is_whole = k % 2 == 0;
    const auto any = [&] {
      return is_whole ? vec3f{float(r.below(5)) - 2, float(r.below(5)) - 2, float(r.below(5)) - 2}
                      : r.in_cube() * 2.0f;
    };
    std::vector<texel> corners;
    for (int c = 0; c < 3; ++c) {
      const vec3f p = any();
      corners.push_back({p.x, p.y, p.z, 0});
    }
    const vec3f a{corners[0][0], corners[0][1], corners[0][2]},
        b{corners[1][0], corners[1][1], corners[1][2]};
    const std::vector<std::uint32_t> order{0,          FACET_NONE, FACET_NONE, FACET_NONE,
                                           FACET_NONE, FACET_NONE, FACET_NONE, FACET_NONE};
    std::vector<TriangleBlock> blocks;
    append_blocks(order, corners, blocks);
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
      const float share = i % 4 == 0 ? 0.0f : i % 4 == 1 ? 1.0f : i % 8 == 2 ? 0.5f : r.uniform();
      const vec3f at = a + (b - a) * share, from = i % 8 == 7 ? a + (a - b) : any(),
                  d = i % 8 == 6 ? any() : at - from;
      rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, INFINITY});
    }
    runtime::buffer<texel> block(reinterpret_cast<const texel*>(blocks.data()),
                                 sizeof(TriangleBlock) / sizeof(texel));
    runtime::buffer<Ray> in(rays.data(), rays.size());
    runtime::buffer<std::uint32_t> met(rays.size());
    q.submit([&](runtime::handler& h) {
      const runtime::accessor triangles{block, h, runtime::read_only};
      const runtime::accessor from{in, h, runtime::read_only};
      const runtime::accessor out{met, h, runtime::write_only};
      h.set_args(triangles, from, out);
      h.parallel_for(runtime::range<1>(rays.size()), ask);
    });
    std::size_t tried = 0, absent = 0;
    for (const std::uint32_t m : content(met)) {
      tried += m >> 8;
      absent += (m & 0xfeu) != 0;
    }
    CHECK(tried > 500);
    CHECK(absent == 0);
  }
}

TEST_CASE("wide: nodes cost less than where the largest child is opened first") {
  for (std::uint32_t n : {9u, 20u, 100u, 3000u})
    for (const std::uint32_t lanes : {1u, 8u}) {
      CAPTURE(n);
      CAPTURE(lanes);
      const mesh m = test::random_soup(n, n);
      std::vector<texel> corners;
      given_tree halves{{{0, n}}, {}};
      for (std::uint32_t t = 0; t < n; ++t) {
        halves.order.push_back(t);
        for (int k = 0; k < 3; ++k) {
          const vec3f p = m.position(t, k);
          corners.push_back({p.x, p.y, p.z, 0});
        }
      }
      const host_binary_tree t = binary_of(halves, corners);
      const wide_tree w = widened(t.nodes, t.root, n, lanes, 0, 0);
      const double simple = opened_largest_first(t, t.root, lanes);
      // Sums of at most 3,000 areas of like size in single precision: 3,000 u and less.
      CHECK(areas(w.nodes) <= simple * (1 + 3000 * 0x1p-24));
      if (n == 3000) CHECK(areas(w.nodes) < 0.99 * simple);
    }
}
