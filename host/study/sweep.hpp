// The block-size study: which work-group is fastest, and how sure that is.
//
// An experiment is one scene at one size, with a tree or without. Each shape's picture is rendered
// once to warm up (some drivers compile a kernel again for each work-group), then settings.repeats
// times, in one launch each unless told otherwise; the serial reference (float, one thread) takes
// part as one more configuration. The order of all (configuration, repeat) is random, so that a
// machine whose speed drifts favours none. Every picture must be the first shape's, bit for bit.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/scene.hpp"
#include "study/sweep_result.hpp"

namespace facet::study {

struct experiment {
  std::string name;             ///< "tree"
  const scene* what = nullptr;  ///< valid, and alive until the sweep ends
  tracer::tree_kind tree =
      tracer::tree_kind::binned;  ///< of the device, and of the serial reference
  std::uint32_t width = 0, height = 0, max_depth = 0;
};

/// Runs the experiments one after another. `result` holds what was measured so far at any time:
/// also when `cancel` became true (the picture under way is dropped, and this returns), and when
/// this throws what device_scene does. A shape that the device refuses, or whose picture differs,
/// is marked and its remaining repeats left out; the others go on. `on_progress` is called after
/// each picture with the milliseconds spent so far, and expected in all.
void run_sweep(const runtime::queue& queue, const std::vector<experiment>& experiments,
               const sweep_settings& settings, sweep_result& result,
               const tracer::progress& on_progress = {}, const std::atomic<bool>* cancel = nullptr);

}  // namespace facet::study
