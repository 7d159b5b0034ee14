// What facet tune chooses between: no bit depends on it, what is asked for by name goes before it,
// and what a device cannot have is refused.
#include "tracer/choices.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tuning.hpp"

using namespace facet;
using tracer::choices;
using tracer::device_scene;
using tracer::options;

namespace {

options with(const choices& c) {
  options o;
  o.defaults = c;
  return o;
}

std::vector<std::uint32_t> bits_of(const picture& p) {
  std::vector<std::uint32_t> bits;
  for (const float x : p.rgba) bits.push_back(std::bit_cast<std::uint32_t>(x));
  return bits;
}

std::vector<std::uint32_t> bits_of(const std::vector<tracer::hit>& hits) {
  std::vector<std::uint32_t> bits;
  for (const tracer::hit& h : hits)
    for (const std::uint32_t x :
         {std::bit_cast<std::uint32_t>(h.t), std::bit_cast<std::uint32_t>(h.u),
          std::bit_cast<std::uint32_t>(h.v), h.instance, h.triangle})
      bits.push_back(x);
  return bits;
}

/// Every layout, each with every number at its least and at values that are no power of two.
std::vector<choices> all_kinds() {
  std::vector<choices> all;
  const auto ways = [&](choices c) {
    c.wide_layout = c.image_geometry = c.packets = false;
    all.push_back(c);
    c.image_geometry = true;
    all.push_back(c);
    c.image_geometry = false, c.wide_layout = true;
    all.push_back(c);
    c.packets = true;
    all.push_back(c);
  };
  choices least;
  least.packet_group = least.group = least.render_group_width = least.render_group_height = 1;
  least.leaf_sure = least.leaf_size = 1;
  ways(least);
  choices odd;
  odd.packet_group = 3, odd.group = 33;
  odd.render_group_width = 5, odd.render_group_height = 7;
  odd.leaf_sure = 3, odd.leaf_size = 13;
  ways(odd);
  return all;
}

}  // namespace

TEST_CASE("hits and pictures have the same bits with any choices") {
  const scene s = test::every_feature();
  const std::vector<tracer::ray> rays = test::random_rays(3000, 5);
  device_scene usual(test::queue(), s);
  const auto hits = bits_of(usual.trace(rays));
  const auto pixels = bits_of(usual.render(s.width, s.height, s.max_depth));
  for (const choices& c : all_kinds()) {
    CAPTURE(c.wide_layout);
    CAPTURE(c.image_geometry);
    CAPTURE(c.packets);
    CAPTURE(c.group);
    device_scene on(test::queue(), s, with(c));
    CHECK(bits_of(on.trace(rays)) == hits);
    CHECK(bits_of(on.render(s.width, s.height, s.max_depth)) == pixels);
  }
}

TEST_CASE("they decide what was left open, and statistics say so") {
  const scene s = test::every_feature();
  choices c;
  c.image_geometry = true;
  c.render_group_width = 2, c.render_group_height = 3;
  c.group = 16;
  device_scene on(test::queue(), s, with(c));
  tracer::statistics stats;
  on.render(32, 16, 1, &stats);
  CHECK(stats.is_tuned);
  CHECK(stats.layout == "narrow");
  CHECK(stats.geometry == "image");
  CHECK(stats.rays_a_work_item == 1);
  CHECK(stats.group_width == 2);
  CHECK(stats.group_height == 3);
  on.trace(test::random_rays(10, 1), false, 1, &stats);
  CHECK(stats.is_tuned);
  CHECK(stats.group_width == 16);
  CHECK(!device_scene(test::queue(), s).prepared().is_tuned);
}

TEST_CASE("what is asked for by name goes before them") {
  const scene s = test::every_feature();
  choices images;
  images.image_geometry = true;
  options o = with(images);
  o.layout = tracer::layout_kind::wide;
  CHECK(device_scene(test::queue(), s, o).prepared().layout == "wide");
  o = with(images);
  o.packets = tracer::packet_kind::on;
  CHECK(device_scene(test::queue(), s, o).prepared().rays_a_work_item > 1);
  o = with(images);
  o.geometry = tracer::geometry_kind::buffer;
  o.group_width = 4, o.group_height = 2;
  tracer::statistics stats;
  device_scene(test::queue(), s, o).render(32, 16, 1, &stats);
  CHECK(stats.geometry == "buffer");
  CHECK(stats.group_width == 4);
  CHECK(stats.group_height == 2);

  choices packets;
  packets.wide_layout = packets.packets = true;
  o = with(packets);
  o.packets = tracer::packet_kind::off;
  CHECK(device_scene(test::queue(), s, o).prepared().rays_a_work_item == 1);
  o = with(packets);
  o.geometry = tracer::geometry_kind::image;
  CHECK(device_scene(test::queue(), s, o).prepared().layout == "narrow");
}

TEST_CASE("the defaults of this kind of device can be had") {
  CHECK(tracer::fault_of(tracer::tuning_for(test::device()), test::device()) == "");
}

TEST_CASE("what the device cannot have is refused by name, with what is allowed") {
  const runtime::device d = test::device();
  const auto fault = [&](auto change) {
    choices c;
    change(c);
    return tracer::fault_of(c, d);
  };
  const std::string most = std::to_string(d.max_work_group_size());
  CHECK(fault([](choices&) {}) == "");
  CHECK(fault([](choices& c) { c.group = 0; }) ==
        "group: found 0; 1 to " + most + " work-items are allowed");
  CHECK(fault([&](choices& c) {
          c.group = std::uint32_t(d.max_work_group_size() + 1);
        }).starts_with("group: "));
  CHECK(fault([&](choices& c) { c.group = std::uint32_t(d.max_work_group_size()); }) == "");
  CHECK(fault([](choices& c) { c.packet_group = 0; }).starts_with("packet_group: "));
  CHECK(fault([](choices& c) { c.render_group_height = 0; }).starts_with("render_group's height"));
  CHECK(fault([&](choices& c) {
          c.render_group_width = std::uint32_t(d.max_work_group_size()), c.render_group_height = 2;
        }).starts_with("render_group: "));
  CHECK(fault([](choices& c) { c.leaf_size = 17; }).starts_with("leaf_size: found 17; 1 to 16"));
  CHECK(fault([](choices& c) { c.leaf_sure = 5; }).starts_with("leaf_sure: found 5; 1 to 4"));
  CHECK(fault([](choices& c) { c.trace_registers = 7; }).starts_with("trace_registers: found 7"));
  CHECK(fault([](choices& c) {
          c.wide_layout = c.image_geometry = true;
        }).starts_with("layout, geometry: "));
  choices wrong;
  wrong.group = 0;
  CHECK_THROWS_AS(device_scene(test::queue(), test::every_feature(), with(wrong)),
                  runtime::exception);
}
