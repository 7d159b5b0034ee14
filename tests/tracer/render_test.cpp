// Pictures of the device: the same by every way to make them, and the reference's.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "reference/tracer.hpp"
#include "scene/error.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using tracer::device_scene;
using tracer::geometry_kind;
using tracer::options;
using tracer::tree_kind;

namespace {

picture render(const scene& s, const options& o = {}) {
  return device_scene(test::queue(), s, o).render(s.width, s.height, s.max_depth);
}

bool same_bits(const picture& a, const picture& b) {
  return a.rgba.size() == b.rgba.size() &&
         std::equal(a.rgba.begin(), a.rgba.end(), b.rgba.begin(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

TEST_CASE("trees, geometry, work-groups, tiles and feature sets all give the same picture") {
  const scene s = test::every_feature();
  const picture expected = render(s);
  std::vector<options> ways(15);
  ways[0].tree = tree_kind::none;
  ways[1].geometry = geometry_kind::image;
  ways[2].all_features = true;
  const std::uint32_t groups[][2] = {{1, 1}, {3, 5}, {16, 1}, {1, 32}, {16, 16}};
  for (std::size_t k = 0; k < 5; ++k)
    ways[3 + k].group_width = groups[k][0], ways[3 + k].group_height = groups[k][1];
  ways[8].tile_width = 17, ways[8].tile_height = 13;
  ways[9].tile_width = 1000, ways[9].tile_height = 1;
  ways[10].tree = tree_kind::none, ways[10].geometry = geometry_kind::image;
  ways[11].geometry = geometry_kind::image, ways[11].all_features = true;
  ways[12].layout = tracer::layout_kind::narrow;
  ways[13].layout = tracer::layout_kind::wide, ways[13].packets = tracer::packet_kind::off;
  ways[14].layout = tracer::layout_kind::wide, ways[14].packets = tracer::packet_kind::on;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    CAPTURE(k);
    CHECK(same_bits(render(s, ways[k]), expected));
  }
}

TEST_CASE("the work-group can change between pictures, and be the driver's: no bit does") {
  const scene s = test::every_feature();
  const picture expected = render(s);
  options o;
  o.group_width = 4, o.group_height = 2;
  o.tile_width = s.width, o.tile_height = s.height;
  device_scene on_device(test::queue(), s, o);
  tracer::statistics stats;
  const auto rendered = [&] { return on_device.render(s.width, s.height, s.max_depth, &stats); };
  CHECK(same_bits(rendered(), expected));
  CHECK(stats.group_width == 4);
  on_device.leave_work_group_to_driver();
  CHECK(same_bits(rendered(), expected));
  CHECK(stats.group_width == 0);
  CHECK(stats.group_height == 0);
  on_device.set_work_group(1, 16);
  CHECK(same_bits(rendered(), expected));
  CHECK(stats.group_width == 1);
  CHECK(stats.group_height == 16);
  CHECK(stats.tiles == 1);
}

TEST_CASE("the render kernel is described as compiled: text, options, and its largest group") {
  options together;
  together.samples_apart = false;
  device_scene on_device(test::queue(), test::every_feature(), together);
  const auto d = on_device.describe_render(9);
  CHECK(d.text.find("__kernel void render(") != std::string::npos);
  CHECK(d.text.find("#include \"") == std::string::npos);
  CHECK(d.options.find("-DFACET_RAY_STACK=16") != std::string::npos);
  REQUIRE(d.group_items >= 1);
  on_device.set_work_group(std::uint32_t(d.group_items), 2);
  CHECK_THROWS_WITH_AS(on_device.render(8, 8, 1),
                       doctest::Contains(std::to_string(d.group_items).c_str()),
                       runtime::exception);
}

TEST_CASE(
    "a work-item for each sample, those that come to glass first: the same picture, in tiles too") {
  scene s = test::every_feature();
  options together;
  together.packets = tracer::packet_kind::off;
  together.samples_apart = false;
  options apart = together;
  apart.samples_apart = apart.glass_first = true;
  options in_tiles = apart, in_order = apart;
  in_order.glass_first = false;
  in_tiles.tile_width = 17, in_tiles.tile_height = 13;
  for (const std::uint32_t samples : {3, 1}) {
    CAPTURE(samples);
    s.samples = samples;
    // First what is wrong: where it leaves memory as it was, no right picture must lie there.
    const auto with_mistake = [&](const char* right, const char* wrong) {
      options o = apart;
      o.edits = {{"render_samples.cl", right, wrong}};
      return device_scene(test::queue(), s, o).render(90, 50, 12);
    };
    const picture one_place = with_mistake("all + own - before", "all"),
                  one_sample = samples == 1
                                   ? one_place
                                   : with_mistake("columns + n * x + i]", "columns + n * x]");
    tracer::statistics expected_stats, stats;
    const picture expected =
        device_scene(test::queue(), s, together).render(90, 50, 12, &expected_stats);
    CHECK(same_bits(device_scene(test::queue(), s, apart).render(90, 50, 12, &stats), expected));
    CHECK(stats.crowded == expected_stats.crowded);
    CHECK(stats.refused == expected_stats.refused);
    CHECK(same_bits(device_scene(test::queue(), s, in_tiles).render(90, 50, 12), expected));
    CHECK(same_bits(device_scene(test::queue(), s, in_order).render(90, 50, 12), expected));
    CHECK_FALSE(same_bits(one_place, expected));
    CHECK_FALSE(same_bits(one_sample, expected));
  }
}

TEST_CASE(
    "a work-item is for a sample where pixels have several, or rays part, and no group is asked "
    "for") {
  scene s = test::every_feature();
  options apart;
  apart.packets = tracer::packet_kind::off;
  apart.samples_apart = true;
  options together = apart, in_groups = apart;
  together.samples_apart = false;
  in_groups.group_width = in_groups.group_height = 4;
  const auto is_apart = [&](const options& o) {
    return device_scene(test::queue(), s, o)
               .describe_render(2)
               .text.find("__kernel void render_samples(") != std::string::npos;
  };
  CHECK(is_apart(apart));
  CHECK_FALSE(is_apart(together));
  CHECK_FALSE(is_apart(in_groups));
  for (material& m : s.materials) m.Kt = {0, 0, 0};
  CHECK_FALSE(is_apart(apart));
  s.samples = 2;
  CHECK(is_apart(apart));
}

TEST_CASE("leaving out what a scene does not use changes no bit, feature by feature") {
  scene s = test::every_feature();
  options all;
  all.all_features = true;
  for (int left_out = 0; left_out < 5; ++left_out) {
    CAPTURE(left_out);
    scene t = s;
    for (material& m : t.materials) {
      if (left_out == 0) m.Kt = {0, 0, 0};
      if (left_out == 1) m.Kr = {0, 0, 0};
      if (left_out == 2) m.Ks = {0, 0, 0};
    }
    if (left_out == 3)
      for (mesh& m : t.meshes) m.normals.clear(), m.normal_indices.clear();
    if (left_out == 4) t.instances = {{0, transform{}, 0}};
    CHECK(same_bits(render(t), render(t, all)));
  }
}

TEST_CASE("the picture is the reference's") {
  const scene s = test::every_feature();
  const picture expected = reference::tracer<float>(s).render(s.width, s.height, s.max_depth);
  const picture found = render(s);
  std::size_t off = 0;
  for (std::size_t i = 0; i < found.rgba.size(); i += 4) {
    float worst = 0;
    for (std::size_t c = 0; c < 4; ++c)
      worst = std::max(worst, std::abs(std::clamp(found.rgba[i + c], 0.0f, 1.0f) -
                                       std::clamp(expected.rgba[i + c], 0.0f, 1.0f)));
    off += worst > 1.0f / 255;
  }
  // Issue's bound: 0.1% of the pixels. Hits agree bit for bit; exp and pow differ by an ulp, which
  // can only tip a later hit over an edge.
  CHECK(off * 1000 <= found.rgba.size() / 4);
}

TEST_CASE(
    "glass within glass, and an eye in it: the reference's picture, and what was forgotten is "
    "counted") {
  scene s = test::every_feature();
  const auto glass = std::uint32_t(s.materials.size());
  s.materials.push_back(s.materials[1]);
  s.materials[glass].Ni = 1.2f;
  s.materials[glass].Kt = {0.5f, 0.9f, 0.8f};
  // A ball around the glass ball, and one around the camera.
  s.instances.push_back({0, transform::scale({1.3, 1.2, 1.3}), glass});
  s.instances.push_back(
      {0, transform::translate(s.view.position) * transform::scale({0.4, 0.4, 0.4}), 1});
  const auto compare = [&](std::uint32_t nesting) {
    s.nesting = nesting;
    std::uint64_t forgotten = 0;
    const picture expected =
        reference::tracer<float>(s).render(s.width, s.height, s.max_depth, {}, &forgotten);
    tracer::statistics stats;
    const picture found =
        device_scene(test::queue(), s).render(s.width, s.height, s.max_depth, &stats);
    std::size_t off = 0;
    for (std::size_t i = 0; i < found.rgba.size(); ++i)
      off += std::abs(found.rgba[i] - expected.rgba[i]) > 1.0f / 255;
    // Exp and pow differ by an ulp, which may tip a later hit over an edge.
    CHECK(off * 1000 <= found.rgba.size());
    CHECK((stats.crowded > 0) == (nesting == 1));
    CHECK((forgotten > 0) == (nesting == 1));
    return found;
  };
  const picture one = compare(1), two = compare(2);
  CHECK_FALSE(same_bits(one, two));
  CHECK(same_bits(two, compare(8)));
}

TEST_CASE("samples average the rays of a grid, depth 0 traces eye rays alone") {
  scene s = test::every_feature();
  s.samples = 3;
  s.max_depth = 0;
  const picture expected = reference::tracer<float>(s).render(48, 32, 0);
  const picture found = device_scene(test::queue(), s).render(48, 32, 0);
  for (std::size_t i = 0; i < found.rgba.size(); ++i)
    // Nine sums of at most 1, each product within a few ulps: far under 1e-5.
    CHECK(std::abs(found.rgba[i] - expected.rgba[i]) < 1e-5f);
}

TEST_CASE("a picture may be deeper than the one before") {
  const scene s = test::every_feature();
  device_scene on_device(test::queue(), s);
  on_device.render(32, 32, 1);
  const picture deep = on_device.render(32, 32, 30);
  CHECK(same_bits(deep, device_scene(test::queue(), s).render(32, 32, 30)));
}

TEST_CASE("alpha is the background's where nothing is met") {
  scene s = test::one_mesh(generate("box", {{"size", 1.0}}));
  s.background_alpha = 0.25f;
  const picture p = device_scene(test::queue(), s).render(16, 16, 2);
  CHECK(p.at(0, 0)[3] == 0.25f);
  CHECK(p.at(8, 8)[3] == 1.0f);
}

TEST_CASE("progress counts every pixel once; cancelling ends within a tile") {
  const scene s = test::every_feature();
  options o;
  o.tile_width = 16, o.tile_height = 16;
  device_scene on_device(test::queue(), s, o);
  std::uint64_t last = 0, calls = 0;
  tracer::statistics stats;
  on_device.render(64, 48, 2, &stats, [&](std::uint64_t done, std::uint64_t total) {
    CHECK(done > last);
    CHECK(total == 64 * 48);
    last = done;
    ++calls;
  });
  CHECK(last == 64 * 48);
  CHECK(calls == 12);
  CHECK(stats.tiles == 12);

  std::atomic<bool> stop = false;
  try {
    on_device.render(
        64, 48, 2, nullptr, [&](std::uint64_t, std::uint64_t) { stop = true; }, &stop);
    FAIL("not cancelled");
  } catch (const tracer::cancelled& c) {
    CHECK(c.done == 16 * 16);
    CHECK(c.total == 64 * 48);
  }
}

TEST_CASE("sizes and depths beyond the limits are refused with the limit") {
  device_scene on_device(test::queue(), test::every_feature());
  CHECK_THROWS_WITH_AS(on_device.render(0, 10, 1), doctest::Contains("32768"), scene_error);
  CHECK_THROWS_WITH_AS(on_device.render(10, 40000, 1), doctest::Contains("32768"), scene_error);
  CHECK_THROWS_WITH_AS(on_device.render(10, 10, 65), doctest::Contains("64"), scene_error);
}

TEST_CASE("a work-group larger than the kernel allows is refused before the launch") {
  options o;
  o.group_width = 1u << 20, o.group_height = 1;
  device_scene on_device(test::queue(), test::every_feature(), o);
  try {
    on_device.render(32, 32, 1);
    FAIL("not refused");
  } catch (const runtime::exception& e) {
    CHECK(e.code() == runtime::errc::nd_range);
    CHECK(std::string(e.what()).find("1048576") != std::string::npos);
  }
}
