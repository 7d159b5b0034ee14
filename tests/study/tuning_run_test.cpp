// Tuning this device on a few rays: what is tried, what is held to, and what ends it.
#include "study/tuning_run.hpp"

#include <doctest/doctest.h>

#include <atomic>

#include "tracer/device_helper.hpp"
#include "tracer/tuning.hpp"

using namespace facet;
using study::choice_result;
using study::tuning_result;
using study::tuning_settings;
using tracer::choices;

namespace {

/// The choice of this device's usual kernel over rays.
std::string over_rays() {
  const choices usual = tracer::tuning_for(test::device());
  return usual.wide_layout && usual.packets ? "packet_group" : "group";
}

tuning_settings settings() {
  tuning_settings s;
  s.is_quick = true;
  s.only = {over_rays()};
  s.rounds = 3;
  return s;
}

const std::vector<study::tuning_scene>& scenes() {
  static const std::vector<study::tuning_scene> all = [] {
    std::vector<study::tuning_scene> made = study::tuning_scenes(64, true);
    made.resize(1);  // the knot
    return made;
  }();
  return all;
}

tuning_result tuned(const tuning_settings& s, const study::tuning_watch& watch = {},
                    const std::atomic<bool>* cancel = nullptr) {
  tuning_result r;
  study::run_tuning(test::queue(), scenes(), s, r, watch, cancel);
  return r;
}

/// A launch that traces in groups of that size gives t's last bit the other way round.
tracer::options wrong_in_groups_of(std::uint32_t size) {
  const std::string is_wrong = "get_local_size(0) == " + std::to_string(size) + "u";
  tracer::options o;
  o.edits = {{"trace.h", "  h.t = q->t;",
              "  h.t = " + is_wrong + " ? as_float(as_uint(q->t) ^ 1u) : q->t;"},
             {"trace_packets.cl",
              "const uint first = FACET_PACKET * (uint)get_global_id(0);\n"
              "  if (first >= count) return;\n"
              "  const Scene s = scene_of(world, nodes, instances, infos, "
              "materials, faults);\n"
              "  trace_some(&s, positions, rays + first, min(FACET_PACKET, "
              "count - first), FACET_CLOSEST, hits + first,\n"
              "             hit_instances + first);",
              "const uint first = FACET_PACKET * (uint)get_global_id(0);\n"
              "  if (first >= count) return;\n"
              "  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);\n"
              "  trace_some(&s, positions, rays + first, min(FACET_PACKET, count - first), "
              "FACET_CLOSEST, hits + first,\n"
              "             hit_instances + first);\n"
              "  if (" +
                  is_wrong + ") hits[first].t = as_float(as_uint(hits[first].t) ^ 1u);"}};
  return o;
}

/// Rays by themselves take long in groups for which `test` holds of their size.
tracer::options slow_in_groups(const std::string& test, std::uint32_t size) {
  const std::string wait = "  if (get_local_size(0) " + test + " " + std::to_string(size) +
                           "u)\n    for (volatile uint k = 0u; k < 20000u; ++k);\n";
  const std::string
      alone = "  Query q = traverse(s, positions, vec_global(r->origin)",
      packet = "  PacketPart part[FACET_PARTS];\n  PacketSpace world;\n  if (s->triangle_count";
  tracer::options o;
  o.edits = {{"trace.h", alone, wait + alone}, {"trace_packet.h", packet, wait + packet}};
  return o;
}

/// The choice over rays, made without pictures.
choice_result chosen_for_rays(const tuning_settings& s) {
  std::vector<study::tuning_scene> rays = scenes();
  rays[0].with_picture = false;
  tuning_result r;
  study::run_tuning(test::queue(), rays, s, r);
  REQUIRE(r.choices.size() == 1);
  CHECK(r.values == r.choices[0].trials[r.choices[0].taken].as);
  return r.choices[0];
}

}  // namespace

TEST_CASE(
    "every value is timed as often, beside the defaults, on the workloads that it matters to") {
  std::vector<std::string> told;
  std::uint64_t last = 0, most = 0;
  study::tuning_watch watch;
  watch.on_choice = [&](const choice_result& c) { told.push_back(c.name); };
  watch.on_run = [&](const std::string&, std::uint64_t done, std::uint64_t all) {
    CHECK(done == last + 1);
    CHECK(done <= all);
    last = done, most = all;
  };
  const tuning_result r = tuned(settings(), watch);
  CHECK(r.complete);
  CHECK(r.usual == tracer::tuning_for(test::device()));
  CHECK(told == std::vector<std::string>{over_rays()});
  REQUIRE(r.choices.size() == 1);
  const choice_result& c = r.choices[0];
  CHECK(c.trials[0].as == r.usual);
  CHECK(c.trials.size() >= 4);
  for (const study::trial& t : c.trials) {
    CAPTURE(t.value);
    if (!t.refused.empty()) continue;
    REQUIRE(t.ms.size() == c.workloads.size());
    for (const auto& ms : t.ms) CHECK(ms.size() == 3);
    CHECK(t.relative.rounds.size() == (&t == &c.trials[0] ? 0u : 3u));
  }
  CHECK(r.values == c.trials[c.taken].as);
  if (!c.challenger) CHECK(c.taken == 0);
  CHECK(last <= most);
}

TEST_CASE("a value that is sure to be faster is taken") {
  const std::uint32_t other = over_rays() == "packet_group" ? 2 : 128;
  tuning_settings s = settings();
  s.tracer = slow_in_groups("!=", other);
  const choice_result c = chosen_for_rays(s);
  CHECK(c.trials[c.taken].value == std::to_string(other));
  CHECK(c.confirmation.rounds.size() == 3);
}

TEST_CASE("a value that takes far longer is timed in the first rounds alone, and not taken") {
  const std::uint32_t other = over_rays() == "packet_group" ? 2 : 128;
  tuning_settings s = settings();
  s.rounds = 5;
  s.tracer = slow_in_groups("==", other);
  const choice_result c = chosen_for_rays(s);
  for (const study::trial& t : c.trials)
    if (t.value == std::to_string(other)) {
      CHECK(t.relative.rounds.size() == 3);
      CHECK(t.relative.median > 1.5);
    }
  CHECK(c.trials[0].ms[0].size() == 5);
  CHECK(c.trials[c.taken].value != std::to_string(other));
}

TEST_CASE("a value that gives other bits is an error that names it, its workload and the first") {
  const std::uint32_t other = over_rays() == "packet_group" ? 2 : 128;
  tuning_settings s = settings();
  s.tracer = wrong_in_groups_of(other);
  try {
    tuned(s);
    FAIL("the difference was not found");
  } catch (const study::tuning_difference& e) {
    const std::string said = e.what();
    CAPTURE(said);
    CHECK(said.starts_with(over_rays() + " " + std::to_string(other) + ": "));
    CHECK(said.find("hits of \"knot: eye rays\"") != std::string::npos);
    CHECK(said.ends_with("the first number 0"));
  }
}

TEST_CASE("what the device refuses is marked with its reason, and the others go on") {
  tuning_settings s = settings();
  s.only = {"layout"};
  // Triangles in images are then a program that no compiler takes.
  s.tracer.edits = {{"trace.h", "#include \"traverse.h\"",
                     "#include \"traverse.h\"\n#ifdef FACET_GEOMETRY_IMAGE\n#error no images "
                     "here\n#endif"}};
  if (!test::device().image_support()) return;
  std::vector<study::tuning_scene> rays = scenes();
  rays[0].with_picture = false;
  tuning_result r;
  study::run_tuning(test::queue(), rays, s, r);
  CHECK(r.complete);
  REQUIRE(r.choices.size() == 1);
  for (const study::trial& t : r.choices[0].trials) {
    CAPTURE(t.value);
    const bool is_image = t.value == "narrow, image";
    CHECK((t.refused.find("no images here") != std::string::npos) == is_image);
    CHECK(t.relative.rounds.empty() == (is_image || t.as == r.usual));
  }
  CHECK(!r.values.image_geometry);
}

TEST_CASE("cancelled, it is not complete") {
  std::atomic<bool> cancel{true};
  const tuning_result before = tuned(settings(), {}, &cancel);
  CHECK(!before.complete);
  CHECK(before.choices.empty());

  cancel = false;
  study::tuning_watch watch;
  watch.on_run = [&](const std::string&, std::uint64_t done, std::uint64_t) {
    if (done == 3) cancel = true;
  };
  const tuning_result during = tuned(settings(), watch, &cancel);
  CHECK(!during.complete);
  CHECK(during.choices.empty());
}
