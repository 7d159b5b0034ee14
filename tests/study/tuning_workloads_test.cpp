// What a device is tuned on: rays that meet something, of every kind, the same each time.
#include "study/tuning_workloads.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "study/hit_errors.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/features.hpp"

using namespace facet;
using study::tuning_scene;
using study::tuning_workload;

namespace {

std::vector<tuning_workload> workloads_of(const tuning_scene& s) {
  tracer::device_scene on(test::queue(), s.what);
  return study::workloads_of(on, s, 0);
}

bool same_rays(const std::vector<tracer::ray>& a, const std::vector<tracer::ray>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

std::vector<tuning_scene> small_scenes() { return study::tuning_scenes(64, true); }

}  // namespace

TEST_CASE("the scenes are small if quick, and large otherwise") {
  const auto quick = small_scenes(), usual = study::tuning_scenes(640, false);
  REQUIRE(quick.size() == usual.size());
  for (std::size_t k = 0; k < quick.size(); ++k) {
    CHECK(quick[k].what.name == usual[k].what.name);
    CHECK(quick[k].what.triangle_count() < 50'000);
    CHECK(usual[k].what.triangle_count() > 50'000);
    CHECK(usual[k].width == 640);
    CHECK(usual[k].height == 360);
  }
}

TEST_CASE(
    "all kinds of rays take part, and pictures in which rays follow others and in which none") {
  std::set<std::string> kinds;
  std::set<bool> followers;
  for (const tuning_scene& s : small_scenes()) {
    const tracer::features f = tracer::features::of(s.what);
    for (const tuning_workload& w : workloads_of(s)) {
      CAPTURE(w.name);
      CHECK(w.name.starts_with(s.what.name + ": "));
      kinds.insert(w.name.substr(w.name.find(": ") + 2));
      CHECK(w.rays.empty() == w.is_picture);
      CHECK(w.any == w.name.ends_with("shadow rays"));
      if (w.is_picture) followers.insert(f.reflection || f.transparency);
    }
  }
  CHECK(kinds == std::set<std::string>{"eye rays", "shadow rays", "bounce rays", "picture"});
  CHECK(followers.size() == 2);
}

TEST_CASE("eye rays are the picture's own, packet by packet") {
  const tuning_scene s = small_scenes()[0];
  const auto rays = study::eye_rays_in_tiles(s.what, 20, 10);
  const auto by_rows = study::eye_rays(s.what, 20, 10).rays;
  REQUIRE(rays.size() == by_rows.size());
  const auto is_pixel = [&](std::size_t k, std::size_t x, std::size_t y) {
    for (int i = 0; i < 3; ++i)
      if (std::abs(rays[k].direction[i] - by_rows[20 * y + x].direction[i]) > 1e-6f) return false;
    return true;
  };
  CHECK(is_pixel(0, 0, 0));
  CHECK(is_pixel(7, 7, 0));
  CHECK(is_pixel(8, 0, 1));   // the next row of 8 pixels
  CHECK(is_pixel(32, 8, 0));  // the next packet
  CHECK(is_pixel(199, 19, 9));
}

TEST_CASE(
    "a good part of eye rays hit, and rays leave from there without meeting their own surface") {
  for (const tuning_scene& s : small_scenes()) {
    if (!s.with_rays) continue;
    CAPTURE(s.what.name);
    tracer::device_scene on(test::queue(), s.what);
    const auto all = study::workloads_of(on, s, 0);
    std::size_t eye = 0, hits = 0, near_hits = 0, lit = 0, shadows = 0;
    for (const tuning_workload& w : all) {
      if (w.is_picture) continue;
      for (const tracer::hit& h : on.trace(w.rays, w.any)) {
        const bool is_hit = h.triangle != tracer::miss;
        if (w.name.ends_with("eye rays")) ++eye, hits += is_hit;
        if (w.name.ends_with("bounce rays")) near_hits += is_hit && h.t < 1e-3f;
        if (w.any) ++shadows, lit += !is_hit;
      }
    }
    CHECK(hits * 4 > eye);
    CHECK(shadows == hits);
    CHECK(near_hits * 100 < hits);
    CHECK(lit > 0);
    CHECK(lit < shadows);
  }
}

TEST_CASE("the same rays each time; a scene without lights has no shadow rays") {
  tuning_scene s = small_scenes()[0];
  const auto once = workloads_of(s), again = workloads_of(s);
  REQUIRE(once.size() == again.size());
  for (std::size_t k = 0; k < once.size(); ++k) CHECK(same_rays(once[k].rays, again[k].rays));
  s.what.lights.clear();
  for (const tuning_workload& w : workloads_of(s)) CHECK(!w.name.ends_with("shadow rays"));
}
