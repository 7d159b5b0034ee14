// How many hits are wrong, and in which way, against the double reference on the same rays.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "reference/tracer.hpp"
#include "scene/scene.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

struct ray_set {
  std::string name;  ///< "eye" or "bounce"
  std::vector<tracer::ray> rays;
  /// What each ray leaves, instance and triangle: nothing plane can be met again. Empty: nothing.
  std::vector<std::array<std::uint32_t, 2>> from{};
};

/// One ray through each sample of each pixel, as the render kernel makes them.
ray_set eye_rays(const scene& s, std::uint32_t width, std::uint32_t height);

/// From the first hit of each eye ray that has one, into a direction drawn from the seed over the
/// hemisphere around the geometric normal, denser towards the normal (by the cosine). They start
/// where the float reference starts reflected rays; all machines make the same rays.
ray_set bounce_rays(const scene& s, const ray_set& eye, std::uint64_t seed, unsigned threads);

/// How far a float may move a ray sideways: 64 u E, with u = 2^-24 and E the largest sum over an
/// axis of |origin| and the largest |coordinate| of the scene. The strict test's own bound is 24 u
/// E (cl/triangle.h). An instance's map rounds origin and direction by 4 u of the sum of their
/// terms, at most E by axis, and the way back by a matrix that scales evenly adds up over three
/// axes: 2 * 4 * 3 u E = 24 u E, with 16 u E to spare for the maps' own rounding to float.
inline constexpr int sideways_units = 64;
double sideways_bound(const box3<double>& world, const tracer::ray& r);

struct hit_errors {
  std::uint64_t rays = 0;
  std::uint64_t ties = 0;         ///< another triangle at the same place, within the bound
  std::uint64_t silhouettes = 0;  ///< right for a ray that is moved sideways by less than the bound
  std::uint64_t errors = 0;       ///< neither
  std::uint64_t self_hits = 0;    ///< of the errors: the triangle that the ray leaves
  std::uint64_t other_bits = 0;   ///< hits that differ from the strict kernel's in any bit
  /// Of hits with the right triangle: how many floats lie between t and the double t rounded to
  /// float. [0] counts 0, [k] up to 2^(k-1) and more than [k-1] does.
  std::vector<std::uint64_t> ulps;
  std::uint64_t compared = 0;  ///< all of these
  std::uint64_t median_ulps = 0, p99_ulps = 0, most_ulps = 0;
  std::vector<std::uint64_t> first_errors;  ///< indices of rays, at most 8

  /// Another triangle than the double reference's, or a miss for a hit, or a hit for a miss.
  std::uint64_t wrong() const { return ties + silhouettes + errors; }
  double per_million(std::uint64_t count) const {
    return rays ? 1e6 * double(count) / double(rays) : 0;
  }
};

/// What the double reference says of hits.
class hit_oracle {
 public:
  /// Keeps references. `check` is called now and then, from several threads; it may throw to end
  /// the work.
  hit_oracle(const scene& s, const reference::tracer<double>& exact, unsigned threads,
             std::function<void()> check = {});

  std::vector<reference::hit<double>> trace(const ray_set& r) const;

  /// Of hits `found` for those rays, beside the strict kernel's.
  hit_errors judge(const ray_set& r, std::span<const reference::hit<double>> expected,
                   std::span<const tracer::hit> found, std::span<const tracer::hit> strict) const;

 private:
  enum class verdict { right, tie, silhouette, error, self_hit };
  verdict judge(const ray_set& r, std::size_t i, const reference::hit<double>& expected,
                const tracer::hit& found) const;
  double distance(const vec3d& p, const tracer::hit& to) const;

  const scene& scene_;
  const reference::tracer<double>& exact_;
  unsigned threads_;
  std::function<void()> check_;
  box3<double> world_;
};

}  // namespace facet::study
