#include "tracer/blocks.hpp"

#include <doctest/doctest.h>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;

namespace {

constexpr std::uint32_t first_block = 2;

struct made_blocks {
  runtime::buffer<texel> blocks;
  runtime::buffer<TriangleInfo> infos;
  runtime::buffer<texel> normals;
};

/// The corners are the normals, too. The first block stands at `at`.
made_blocks made(const std::vector<std::uint32_t>& leaves, const std::vector<std::uint32_t>& order,
                 const std::vector<texel>& corners, const std::vector<std::uint32_t>& materials,
                 std::uint32_t at = 0) {
  static block_maker maker(test::queue(), kernel_sources(), tuning_for(test::device()));
  const std::size_t count = at + leaves.size(), slots = FACET_BLOCK * count;
  const runtime::buffer<texel> from(corners.data(), corners.size());
  made_blocks to{runtime::buffer<texel>(count * sizeof(TriangleBlock) / sizeof(texel)),
                 runtime::buffer<TriangleInfo>(slots), runtime::buffer<texel>(3 * slots)};
  const block_list list{runtime::buffer<std::uint32_t>(leaves.data(), leaves.size()),
                        runtime::buffer<std::uint32_t>(order.data(), order.size()),
                        std::uint32_t(leaves.size())};
  maker.make(list, from, runtime::buffer<std::uint32_t>(materials.data(), materials.size()),
             to.blocks, to.infos, at);
  maker.normals(list, from, to.normals, at);
  return to;
}

}  // namespace

TEST_CASE(
    "blocks: a leaf's triangles in its block's lanes, in order; the others repeat the first") {
  // As many leaves as several work-items make, of every size; the first triangle of some is a
  // point, or has its first two corners alike.
  test::random r(1);
  std::vector<std::uint32_t> leaves, order, materials;
  std::uint32_t count = 0;
  while (leaves.size() < 3000) {
    const std::uint32_t size = 1 + r.below(8);
    leaves.push_back(FACET_LEAF(count, size));
    count += size;
  }
  for (std::size_t i = leaves.size(); i > 1; --i)
    std::swap(leaves[i - 1], leaves[r.below(std::uint32_t(i))]);
  std::vector<texel> corners;
  for (std::uint32_t t = 0; t < count; ++t) {
    order.push_back(t);
    materials.push_back(r.below(9));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const vec3f p = r.in_cube();
      corners.push_back({p.x, p.y, p.z, 0});
    }
    if (t % 5 < 2) corners[3 * t + 1] = corners[3 * t];
    if (t % 5 == 0) corners[3 * t + 2] = corners[3 * t];
  }
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[r.below(std::uint32_t(i))]);

  const made_blocks m = made(leaves, order, corners, materials, first_block);
  const auto texels = content(m.blocks), normals = content(m.normals);
  const auto* blocks = reinterpret_cast<const TriangleBlock*>(texels.data()) + first_block;
  const auto infos = content(m.infos);
  std::size_t wrong = 0;
  for (std::size_t b = 0; b < leaves.size(); ++b)
    for (std::size_t lane = 0; lane < FACET_BLOCK; ++lane) {
      const std::uint32_t first = FACET_LEAF_FIRST(leaves[b]);
      const bool is_there = lane < FACET_LEAF_COUNT(leaves[b]);
      const std::uint32_t t = order[is_there ? first + lane : first];
      const std::size_t slot = FACET_BLOCK * (first_block + b) + lane;
      wrong += infos[slot].triangle != t || infos[slot].material != materials[t];
      const texel* const p = &corners[3 * std::size_t(t)];
      const texel* const expected[3] = {p, is_there ? p + 1 : p,
                                        is_there || p[1] == p[0] ? p + 2 : p + 1};
      for (std::size_t k = 0; k < 3; ++k) {
        wrong += normals[3 * slot + k] != p[k];
        for (std::size_t axis = 0; axis < 3; ++axis)
          wrong += blocks[b].corner[k][axis][lane] != (*expected[k])[axis];
      }
    }
  CHECK(wrong == 0);
}

TEST_CASE(
    "blocks: no ray meets a lane without a triangle, aimed along its segment or at its ends") {
  // One triangle, so that seven of the eight lanes are a segment of it. Whole coordinates as well
  // as any: with the former edge functions are 0 where a ray meets the segment, or its line. And so
  // small that in units of the space's size, 4, products of whole ones are half of the least float:
  // as they are rounded, a segment's edge functions do not always have opposite signs.
  runtime::source_tree sources = kernel_sources();
  sources.files["absent_test.cl"] =
      "#include \"triangle.h\"\n"
      "__kernel void ask(__global const float4* block, __global const Ray* rays, __global uint* "
      "met) {\n"
      "  const size_t i = get_global_id(0);\n"
      "  Space s;\n"
      "  TriangleHits hits;\n"
      "  const Intervals outer = {in_all(-INFINITY), in_all(INFINITY)};\n"
      "  met[i] = 0u;\n"
      "  if (space_of(&s, vec_global(rays[i].origin), vec_global(rays[i].direction), "
      "(float3)(4.0f))) {\n"
      "    const Rays r = in_all_lanes(&s);\n"
      "    const Triangles t = triangles_from(block, 0u);\n"
      "    const Real from = in_all(0.0f), to = in_all(INFINITY);\n"
      "    const Mask some = hit_triangles(&r, t, outer, from, to, false, &hits);\n"
      "    met[i] = 256u | lanes_where(settle_doubts(&r, block, t, outer, from, to, some, "
      "&hits));\n"
      "  }\n"
      "}\n";
  runtime::queue& q = test::queue();
  runtime::program program(q.get_context(), sources, "absent_test.cl",
                           "-DFACET_WIDE" + tuning_for(test::device()).flags());
  runtime::kernel ask = program.get_kernel("ask");
  test::random r(5);
  for (int k = 0; k < 40; ++k) {
    const bool is_whole = k % 2 == 0;
    const float size = k % 4 < 2 ? 1.0f : 0x1p-73f;
    const auto any = [&] {
      return (is_whole ? vec3f{float(r.below(5)) - 2, float(r.below(5)) - 2, float(r.below(5)) - 2}
                       : r.in_cube() * 2.0f) *
             size;
    };
    std::vector<texel> corners;
    for (int c = 0; c < 3; ++c) {
      const vec3f p = any();
      corners.push_back({p.x, p.y, p.z, 0});
    }
    const vec3f a{corners[0][0], corners[0][1], corners[0][2]},
        b{corners[1][0], corners[1][1], corners[1][2]};
    std::vector<Ray> rays;
    for (int i = 0; i < 1000; ++i) {
      const float share = i % 4 == 0 ? 0.0f : i % 4 == 1 ? 1.0f : i % 8 == 2 ? 0.5f : r.uniform();
      const vec3f at = a + (b - a) * share, from = i % 8 == 7 ? a + (a - b) : any(),
                  d = (i % 8 == 6 ? any() : at - from) * (1 / size);
      rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, INFINITY});
    }
    const runtime::buffer<texel> block = made({FACET_LEAF(0u, 1u)}, {0}, corners, {0}).blocks;
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
