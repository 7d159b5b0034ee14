// Packets whose rays have two main axes, against the reference, bit for bit.
#include <doctest/doctest.h>

#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/hits_helper.hpp"
#include "tracer/layout.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;
using test::differing_from_reference;
using test::hits_of;
using test::in_packets;
using tracer::options;
using tracer::ray;

namespace {

options edited(const char* file, const char* from, const char* to) {
  options o = in_packets();
  o.edits = {{file, from, to}};
  return o;
}

/// Packets with directions about a plane where two components are alike; the third is `third`.
std::vector<ray> mixed_rays(std::size_t packets, float third) {
  test::random r(6);
  std::vector<ray> rays;
  for (std::size_t g = 0; g < packets; ++g) {
    const vec3f from = r.in_cube() * 2.0f;
    const int axis = int(g % 3);
    vec3f towards{1, 1 + 0.06f * r.in_cube().x, 0};
    std::swap(towards.z, towards[axis]);
    for (int k = 0; k < 3; ++k) towards[k] = std::copysign(towards[k], -from[k]);
    for (std::size_t k = 0; k < FACET_PACKET; ++k) {
      vec3f d = towards + r.in_cube() * 0.05f;
      d[axis] = std::copysign(third * (1 + r.uniform()), towards[axis]);
      rays.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, INFINITY});
    }
  }
  return rays;
}

/// Nothing is met by rays that go on alone.
const char* const alone = "const Query q = traced_query(s, positions, rays + i, mode);";
const char* const missing =
    "Query q = traced_query(s, positions, rays + i, mode);\n    q.triangle = FACET_NONE;";

}  // namespace

TEST_CASE("packets: rays of another main axis than most go with them") {
  const scene s = test::one_mesh(test::random_soup(500, 4));
  const auto rays = mixed_rays(200, 0.2f);
  CHECK(differing_from_reference(s, rays, in_packets()) == 0);
  const std::size_t met = hits_of(s, rays, in_packets());
  CHECK(met > rays.size() / 4);
  // Nearly all are such packets; few rays go alone.
  const char* mixed = "meet_each(s, positions, block, left, space, part, rays, mode, true);";
  CHECK(hits_of(s, rays, edited("packet_hits.h", mixed, "")) < met / 10);
  CHECK(hits_of(s, rays, edited("trace_packet.h", alone, missing)) > 9 * met / 10);
  // Those of another axis may go alone as well, but not along the packet's axis.
  const char* taken = "space->others |= lanes_of(others) << FACET_LANES * k;";
  CHECK(differing_from_reference(s, rays, edited("packet.h", taken, "")) == 0);
  const char* are_all = "if (along == WHOLE_PACKET) return along;";
  CHECK(differing_from_reference(s, rays, edited("packet.h", are_all, "return WHOLE_PACKET;")) > 0);
  const char* seen = "see_along(r, others, &seen);";
  CHECK(differing_from_reference(s, rays, edited("packet.h", seen, "")) > 0);
  const char* in_own_order = "t.is_mixed ? chosen_points(";
  CHECK(differing_from_reference(s, rays,
                                 edited("geometry.h", in_own_order, "false ? chosen_points(")) > 0);
  // Nor are they taken up along it by a search of their own.
  const char* own_axis = "? in->axis_of_others : in->rays[part].axis";
  CHECK(differing_from_reference(
            s, rays, edited("packet.h", own_axis, "? in->rays[part].axis : in->rays[part].axis")) >
        0);
}

TEST_CASE("packets: rays of two main axes whose slabs depend on them go alone") {
  const scene s = test::one_mesh(test::random_soup(500, 4));
  // Less than 2^-60 of the others, by which such components are raised.
  const auto rays = mixed_rays(200, 1e-19f);
  CHECK(differing_from_reference(s, rays, in_packets()) == 0);
  const auto of_packets = [&](const char* from, const char* to) {
    options o = edited("packet.h", from, to);
    o.edits.push_back({"trace_packet.h", alone, missing});
    return hits_of(s, rays, o);
  };
  const std::size_t with_others = of_packets("are_along(&seen) & have_slabs_of(&seen, r)",
                                             "are_along(&seen)"),
                    met = of_packets("are_along(&seen)", "are_along(&seen)");
  CHECK(with_others > rays.size() / 4);
  CHECK(met < 9 * with_others / 10);
}

TEST_CASE("packets: rays of two main axes go together in instances") {
  scene s = test::one_mesh(test::random_soup(500, 4));
  s.instances[0].world_from_object =
      transform::scale({0.9, 0.9, 0.9}) * transform::translate({0.1, 0, 0});
  const auto rays = mixed_rays(200, 0.2f);
  CHECK(differing_from_reference(s, rays, in_packets()) == 0);
  const std::size_t met = hits_of(s, rays, in_packets());
  CHECK(met > rays.size() / 4);
  const char* enters = "mix_axes(inside, reach, inner) == WHOLE_PACKET";
  CHECK(differing_from_reference(s, rays, edited("packet.h", enters, "false")) == 0);
  CHECK(differing_from_reference(s, rays, edited("packet.h", enters, "true")) > 0);
}

TEST_CASE("packets: shadow rays of two main axes cross glass from its own side") {
  scene s = test::every_feature();
  s.lights.resize(1);
  // Those that are seen along y turn otherwise than those that are seen along z.
  s.lights[0].position = {0.5f, 3, 3};
  const auto picture_of = [&](const options& o) {
    return tracer::device_scene(test::queue(), s, o).render(s.width, s.height, s.max_depth).rgba;
  };
  options one_by_one = in_packets();
  one_by_one.packets = tracer::packet_kind::off;
  const auto expected = picture_of(one_by_one);
  CHECK(picture_of(in_packets()) == expected);
  const char* turned = "r->is_turned = others ? seen->is_turned : r->is_turned;";
  CHECK(picture_of(edited("space.h", turned, "")) != expected);
}
