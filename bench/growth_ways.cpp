#include "bench/growth_ways.hpp"

#include <optional>

#include "bench/measure.hpp"
#include "reference/tracer.hpp"

namespace facet::bench {
namespace {

class device_contender : public contender {
 public:
  /// Builds once to warm up, then settings.builds times.
  device_contender(const runtime::queue& queue, const scene& s, way by,
                   const growth_settings& settings) {
    tracer::options o;
    o.tree = by == way::tree ? tracer::tree_kind::binned : tracer::tree_kind::none;
    o.geometry = settings.geometry == "image"    ? tracer::geometry_kind::image
                 : settings.geometry == "buffer" ? tracer::geometry_kind::buffer
                                                 : tracer::geometry_kind::automatic;
    for (unsigned k = 0; k <= settings.builds; ++k) {
      scene_.reset();  // two at once need not fit
      scene_.emplace(queue, s, o);
      tracer::statistics stats;
      scene_->trace({}, false, 1, &stats);
      if (k > 0) build_.ms.push_back(stats.build_ms);
    }
  }

  double trace(const std::vector<ray>& rays, bool any, hits_of& hits) override {
    hits = scene_->trace(packed(rays), any, 1, &stats_);
    return stats_.kernel_ms.at(0);
  }

  void describe(growth_point& p) override {
    p.build = build_;
    p.upload_ms = stats_.upload_ms;
    p.compile_ms = stats_.compile_ms;
    p.tree_depth = stats_.tree_depth;
    p.device_bytes = stats_.device_bytes;
    p.geometry = stats_.geometry;
  }

 private:
  std::optional<tracer::device_scene> scene_;
  study::times build_;
  tracer::statistics stats_;
};

class serial_contender : public contender {
 public:
  explicit serial_contender(const scene& s) {
    build_.ms.push_back(1e3 * seconds([&] { tracer_.emplace(s); }));
  }

  double trace(const std::vector<ray>& rays, bool any, hits_of& hits) override {
    std::vector<hit> found(rays.size());
    const double s = seconds([&] {
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (any)
          found[i].triangle = tracer_->occluded(rays[i]) ? 0 : tracer::miss;
        else
          found[i] = tracer_->closest(rays[i]);
    });
    hits.clear();
    for (const hit& h : found) hits.push_back({h.t, h.u, h.v, h.instance, h.triangle});
    return 1e3 * s;
  }

  void describe(growth_point& p) override { p.build = build_; }

 private:
  std::optional<reference::tracer<float>> tracer_;
  study::times build_;
};

}  // namespace

std::unique_ptr<contender> make_contender(const runtime::queue& queue, const scene& s, way by,
                                          const growth_settings& settings) {
  if (by == way::serial) return std::make_unique<serial_contender>(s);
  return std::make_unique<device_contender>(queue, s, by, settings);
}

}  // namespace facet::bench
