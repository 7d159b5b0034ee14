// Speed against error on a picture of a few pixels: what is found, kept, marked and refused.
#include "study/variant_run.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/schema_helper.hpp"
#include "study/fingerprint.hpp"
#include "study/variant_json.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using study::listed_variant;
using study::variant_state;

namespace {

/// A mirror that fills the view, and nothing that shines: a picture has one eye ray a pixel, and
/// one reflected ray if that may follow.
const scene& mirror() {
  static const scene s = [] {
    scene made = test::one_mesh(generate("plane", {{"size", 100}, {"divisions", 8}}));
    made.name = "mirror";
    made.view.position = {0.1, 3, 0.2};
    made.lights.clear();
    made.materials[0].Kr = {0.05f, 0.05f, 0.05f};
    return made;
  }();
  return s;
}

std::vector<listed_variant> some(std::uint32_t depth, std::vector<std::string> names) {
  std::vector<listed_variant> kept;
  for (const listed_variant& v : study::variant_list(depth))
    if (std::find(names.begin(), names.end(), v.name) != names.end()) kept.push_back(v);
  return kept;
}

study::variant_settings settings() {
  study::variant_settings s;
  s.width = 24, s.height = 16;
  s.repeats = 3;
  s.seed = 5;
  s.threads = 2;
  return s;
}

study::variants_result measured(const std::vector<listed_variant>& list,
                                const scene& s = mirror()) {
  study::variants_result r;
  study::run_variants(test::queue(), s, list, settings(), r);
  return r;
}

/// What the published schema has against the file of this result; "" if nothing.
std::string fault_of(const study::variants_result& r) {
  const auto schema =
      nlohmann::json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-variants.schema.json"));
  return test::schema_fault(nlohmann::json::parse(study::to_json(r)), schema);
}

}  // namespace

TEST_CASE("each variant is timed as often as asked, and held against the double reference") {
  const auto r = measured(some(1, {"strict", "no-tree", "plain-edges", "depth-0", "cutoff-1/16"}));
  CHECK(r.complete);
  CHECK(r.has_findings());
  CHECK(r.broken_promises().empty());
  CHECK(r.from.device->name == test::device().name());
  CHECK(r.scene_hash == study::fingerprint_of(mirror()));
  REQUIRE(r.variants.size() == 5);
  CHECK(r.order.size() == 5 * 3);
  constexpr std::uint64_t pixels = 24 * 16;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const study::variant_result& v = r.variants[i];
    CAPTURE(v.of.name);
    CHECK(v.state == variant_state::measured);
    CHECK(v.is_judged);
    CHECK(v.is_repeatable);
    CHECK(std::count(r.order.begin(), r.order.end(), i) == 3);
    CHECK(v.picture.ms.size() == 3);
    CHECK(v.picture.range.low <= v.picture.values.median);
    CHECK(v.picture.values.median <= v.picture.range.high);
    CHECK(v.mrays_per_s() > 0);
    for (const study::traced_rays& t : v.hits) {
      CHECK(t.errors.rays == pixels);
      CHECK(t.kernel.ms.size() == 3);
      CHECK(t.mrays_per_s() > 0);
    }
    // One more ray where the mirror's rays follow, none where they weigh too little.
    const bool is_shorter = v.of.name == "depth-0" || v.of.name == "cutoff-1/16";
    CHECK(v.rays == (is_shorter ? pixels : 2 * pixels));
    CHECK((v.picture_error.other_bits > 0) == is_shorter);
    // A twentieth of the background is missing everywhere: 0.2 on average, and six roundings.
    if (is_shorter) CHECK(std::abs(v.picture_error.rest.mean - 0.01) < 6 * 0x1p-24);
    if (is_shorter) CHECK(v.picture_error.silhouettes == 0);
  }
  CHECK(r.variants[0].hits[0].errors.errors == 0);
  CHECK(r.variants[0].picture_error.rest.max < 1e-6);
  CHECK(fault_of(r) == "");
}

TEST_CASE("the order is random, and the seed's alone") {
  const auto list = some(1, {"strict", "depth-0"});
  auto s = settings();
  s.repeats = 10;
  const auto order = [&](std::uint32_t seed) {
    s.seed = seed;
    study::variants_result r;
    study::run_variants(test::queue(), mirror(), list, s, r);
    return r.order;
  };
  const auto first = order(5);
  CHECK(order(5) == first);
  CHECK(order(6) != first);
  CHECK(!std::is_sorted(first.begin(), first.end()));
}

TEST_CASE("a hole in the kernel shows as errors, in hits and in the picture") {
  auto list = some(0, {"strict"});
  listed_variant& holes = list.emplace_back(list[0]);
  holes.name = "holes", holes.is_exact = false;
  // Every fourth triangle is never met.
  holes.options.packets = tracer::packet_kind::off;
  holes.options.edits = {{"query.h", "  q->t = t;",
                          "  if (s->infos[slot].triangle % 4u == 3u) return false;\n  q->t = t;"}};
  scene s = mirror();
  s.view.position = {0.1, 40, 0.2};
  const auto r = measured(list, s);
  const study::variant_result& v = r.variants[1];
  CHECK(v.hits[0].errors.errors > 0);
  CHECK(v.hits[0].errors.ties == 0);
  CHECK(v.hits[0].errors.other_bits == v.hits[0].errors.wrong());
  CHECK(v.per_million(&study::hit_errors::errors) > 0);
  CHECK(v.picture_error.all.pixels_off > v.picture_error.silhouettes);
  CHECK(r.broken_promises().empty());
  CHECK(fault_of(r) == "");
}

TEST_CASE("a variant that promises the strict one's bits and breaks it is told of") {
  auto list = some(0, {"strict"});
  listed_variant& other = list.emplace_back(list[0]);
  other.name = "other";
  other.options.packets = tracer::packet_kind::off;
  other.options.edits = {{"render.cl", "= sum / (float)(n * n);",
                          "= x == 5 && y == 3 ? sum * 0.5f : sum / (float)(n * n);"}};
  CHECK(measured(list).broken_promises() ==
        std::vector<std::string>{"other: 0 hits and 1 pixels differ from strict's"});
}

TEST_CASE("what the device refuses says why; the others are measured") {
  auto list = some(1, {"strict", "depth-0"});
  list.insert(list.begin() + 1, list[0]);
  list[1].name = "broken";
  list[1].options.packets = tracer::packet_kind::off;
  list[1].options.edits = {{"render.cl", "const uint n = view->samples;", "this is no C"}};
  auto r = measured(list);
  CHECK(r.complete);
  CHECK(r.variants[1].state == variant_state::refused);
  CHECK(!r.variants[1].reason.empty());
  CHECK(r.variants[1].picture.ms.empty());
  CHECK(r.variants[2].state == variant_state::measured);
  CHECK(r.order.size() == 2 * 3);
  r.left_out.push_back({"no-tree", "too many triangles"});
  CHECK(fault_of(r) == "");
  CHECK(nlohmann::json::parse(study::to_json(r))["left_out"][0]["variant"] == "no-tree");
}

TEST_CASE("interrupted, it keeps what it has and says that it is not complete") {
  const auto list = some(1, {"strict", "depth-0"});
  // Told of after the reference, after each of two variants, and after each timed run.
  for (const int end : {2, 5}) {
    study::variants_result r;
    std::atomic<bool> stop = false;
    int told = 0;
    study::run_variants(
        test::queue(), mirror(), list, settings(), r,
        [&](std::uint64_t spent_ms, std::uint64_t expected_ms) {
          CHECK(spent_ms <= expected_ms);
          stop = ++told >= end;
        },
        &stop);
    CAPTURE(end);
    CHECK(!r.complete);
    CHECK(r.has_findings());
    CHECK(r.variants[0].is_judged);
    CHECK(r.variants[1].is_judged == (end == 5));
    CHECK(r.variants[1].state == variant_state::unfinished);
    CHECK(r.order.size() == (end == 5 ? 2 : 0));
    CHECK(fault_of(r) == "");
  }
}

TEST_CASE("interrupted before the first variant there is nothing to keep") {
  study::variants_result r;
  std::atomic<bool> stop = true;
  study::run_variants(test::queue(), mirror(), some(0, {"strict"}), settings(), r, {}, &stop);
  CHECK(!r.has_findings());
  CHECK(!r.complete);
}

TEST_CASE("a picture of nothing: no bounce rays, no rates for them") {
  scene s = mirror();
  s.view.look_at = {0.1, 9, 0.3};
  const auto r = measured(some(0, {"strict"}), s);
  CHECK(r.complete);
  CHECK(r.variants[0].hits[1].errors.rays == 0);
  CHECK(r.variants[0].hits[1].mrays_per_s() == 0);
  CHECK(r.variants[0].rays == 24 * 16);
  CHECK(fault_of(r) == "");
}
