// The study of speed against error: variants of the tracer on one scene and one device.
//
// Each variant is compiled, makes its picture once to warm up, and traces two sets of rays: the
// picture's eye rays, and a bounce ray from each of their hits. Hits and picture are held against
// the double reference. Then all are timed settings.repeats times, in an order that is random over
// all (variant, repeat), one launch for a picture and one for each set of rays. Variants that
// change shading alone trace rays by the strict kernel, and share its hits.
#pragma once

#include <atomic>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/scene.hpp"
#include "study/variant_result.hpp"

namespace facet::study {

/// Eye rays of a picture that the study takes, at most: the kernels count a picture's rays in 32
/// bits.
inline constexpr std::uint64_t most_eye_rays = 1u << 25;

/// Runs the variants; the first must be the strict one, which the others are held against. `result`
/// holds what was found so far at any time: also when `cancel` became true (this then returns), and
/// when this throws what device_scene does for the strict variant. One that the device refuses is
/// marked, and the others go on. `on_progress` is called with the milliseconds spent so far, and
/// expected in all.
void run_variants(const runtime::queue& queue, const scene& s,
                  const std::vector<listed_variant>& variants, const variant_settings& settings,
                  variants_result& result, const tracer::progress& on_progress = {},
                  const std::atomic<bool>* cancel = nullptr);

}  // namespace facet::study
