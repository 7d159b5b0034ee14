// Where hard cases are run: a device, how many rays, and what a case says of what it found.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/scene.hpp"
#include "study/variants.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

/// One thing that a case holds: of `tried`, `failed` did not, or a figure with its limit.
struct finding {
  std::string what;
  std::uint64_t tried = 0, failed = 0;
  std::optional<double> measured, limit;  ///< measured must be at most the limit
  std::string unit;
  std::array<std::uint64_t, 8> first{};  ///< the smallest numbers of failures; as many as failed
  bool is_goal = true;                   ///< false: reported alone

  bool is_met() const;
  /// The failures that the table shows: those counted, or 1 for a figure beyond its limit.
  std::uint64_t failures() const;
};

/// A deliberate mistake, by which a case shows that it can fail.
using mistake = variant;

/// What all cases share. A case makes its scenes and rays from `seed` alone.
struct lab {
  runtime::queue queue;
  std::uint64_t rays = 10000;  ///< of the cases that count rays; others take a share of it
  std::uint64_t seed = 1;
  unsigned threads = 1;              ///< of the host, for rays and oracles
  const mistake* wrong = nullptr;    ///< what the tracer under test does wrong; null: nothing
  tracer::options options{};         ///< of the tracer under test
  std::function<void()> on_batch{};  ///< called now and then; may throw to end the work
  std::vector<finding> findings{};

  /// The scene on the device under test, with the mistake in it.
  tracer::device_scene place(const scene& s) const;
  tracer::device_scene place(const scene& s, tracer::options o) const;
  /// min(most, rays): for cases whose oracle is too slow for any number of rays.
  std::uint64_t at_most(std::uint64_t most) const { return rays < most ? rays : most; }
  void report(finding f) { findings.push_back(std::move(f)); }
  void report_figure(std::string what, double measured, double limit, std::string unit);
  /// A figure without a limit.
  void note_figure(std::string what, double measured, std::string unit);
};

/// Calls body(first, last) for parts of [0, count) on the lab's threads; waits for all. What a
/// part throws is thrown here.
void in_parallel(const lab& l, std::uint64_t count,
                 const std::function<void(std::uint64_t, std::uint64_t)>& body);

/// What each ray is checked by: false is a failure.
using ray_maker = std::function<tracer::ray(std::uint64_t index)>;
using hit_check = std::function<bool(std::uint64_t index, const tracer::ray&, const tracer::hit&)>;

/// Traces rays 0 to count - 1 in batches and checks each hit, on all threads; reports the finding
/// under `what`. make and check are called from several threads.
finding trace_and_check(lab& l, tracer::device_scene& on, const std::string& what,
                        std::uint64_t count, const ray_maker& make, const hit_check& check);

/// Calls body(first, size) for the batches that rays 0 to count - 1 are traced in.
void in_batches(const lab& l, std::uint64_t count,
                const std::function<void(std::uint64_t, std::uint64_t)>& body);

/// Of checks that trace nothing, or in their own way.
finding count_failures(lab& l, const std::string& what, std::uint64_t count,
                       const std::function<bool(std::uint64_t)>& check);

/// Numbers from hash(seed, index): each ray draws its own, whatever the order (the finaliser of
/// splitmix64; Steele, Lea, Flood 2014).
class draw {
 public:
  draw(std::uint64_t seed, std::uint64_t index);
  std::uint64_t bits();
  std::uint32_t below(std::uint32_t n) { return std::uint32_t((bits() >> 32) * n >> 32); }
  double uniform() { return double(bits() >> 11) * 0x1p-53; }  ///< [0, 1)
  double signed_uniform() { return 2 * uniform() - 1; }
  vec3d in_cube() { return {signed_uniform(), signed_uniform(), signed_uniform()}; }
  vec3d direction();  ///< unit, uniform over the sphere

 private:
  std::uint64_t state_;
};

tracer::ray make_ray(vec3f origin, vec3f direction, float tmin = 0, float tmax = INFINITY);
vec3f origin_of(const tracer::ray& r);
vec3f direction_of(const tracer::ray& r);

}  // namespace facet::study
