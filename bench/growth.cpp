#include "bench/growth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <memory>
#include <new>

#include "bench/growth_ways.hpp"
#include "bench/workload.hpp"
#include "scene/error.hpp"
#include "study/fingerprint.hpp"
#include "tracer/kernels.hpp"

namespace facet::bench {
namespace {

/// The mesh of a family whose number of triangles is nearest.
std::string mesh_name(const std::string& family, std::uint64_t triangles) {
  if (family != "terrain") return family + ":" + std::to_string(triangles);
  const double side = std::round(std::sqrt(double(triangles) / 2));
  return family + ":" + std::to_string(std::uint64_t(std::max(1.0, side)));
}

/// Each `step`th tile of the picture.
std::vector<ray> some_of(const std::vector<ray>& rays, std::size_t step) {
  std::vector<ray> some;
  for (std::size_t first = 0; first < rays.size(); first += step * tile_rays)
    some.insert(some.end(), rays.begin() + std::ptrdiff_t(first),
                rays.begin() + std::ptrdiff_t(std::min(first + tile_rays, rays.size())));
  return some;
}

std::uint64_t count_differing(const hits_of& a, const hits_of& b) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  std::uint64_t differ = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differ += bits(a[i].t) != bits(b[i].t) || bits(a[i].u) != bits(b[i].u) ||
              bits(a[i].v) != bits(b[i].v) || a[i].triangle != b[i].triangle;
  return differ;
}

/// A way on this mesh, and what is found of it.
struct entry {
  growth_series& into;
  growth_point point;
  std::unique_ptr<contender> on;
  struct figure_rays {
    const std::vector<ray>& rays;
    bool any;
  };
  std::vector<figure_rays> rays;  ///< of each figure of the point
};

/// One mesh, by every way whose series has not ended.
class size_run {
 public:
  size_run(const runtime::queue& queue, const growth_settings& s, const std::vector<ray>& eye,
           std::uint64_t asked, growth_family& family)
      : queue_(queue), settings_(s), eye_(eye), asked_(asked), family_(family) {}

  void measure() {
    const std::string name = mesh_name(family_.name, asked_);
    for (growth_series& s : family_.series)
      if (!s.points.empty() && s.points.back().mesh == name) return;
    try {
      scene_ = scene_of(load_workload(name));
      hash_ = study::fingerprint_of(scene_);
    } catch (const scene_error& e) {
      return end_all(e.what());
    } catch (const std::bad_alloc&) {
      return end_all("the mesh does not fit into the host's memory");
    }
    for (growth_series& s : family_.series)
      if (!s.ended) attempt(s, [&] { begin(s, name); });
    for (unsigned k = 0; k < settings_.repeats; ++k)
      for (entry& e : entries_)
        if (!e.into.ended) attempt(e.into, [&] { pass(e); });
    for (entry& e : entries_) {
      if (e.into.ended) continue;
      e.on->describe(e.point);
      e.point.build.conclude(settings_.drawing);
      for (growth_figure& f : e.point.figures) f.time.conclude(settings_.drawing);
      e.into.points.push_back(std::move(e.point));
    }
  }

 private:
  void end_all(const std::string& reason) {
    for (growth_series& s : family_.series)
      if (!s.ended) s.ended = {asked_, reason};
  }

  /// Errors that mean "too large" end the series.
  template <class Work>
  void attempt(growth_series& s, const Work& work) {
    constexpr int out_of_resources = -5;  // CL_OUT_OF_RESOURCES
    try {
      work();
    } catch (const runtime::exception& e) {
      if (e.code() != runtime::errc::memory_allocation && e.cl_code() != out_of_resources) throw;
      s.ended = {asked_, e.what()};
    } catch (const std::bad_alloc&) {
      s.ended = {asked_, "out of the host's memory"};
    }
  }

  /// False, and the end of the series, if that is more than the budget.
  bool can_afford(growth_series& s, double ms) const {
    if (ms <= 1e3 * settings_.budget_s) return true;
    char text[160];
    std::snprintf(text, sizeof text,
                  "it would take about %.3g s, and the budget of a figure is %.3g s", 1e-3 * ms,
                  settings_.budget_s);
    s.ended = {asked_, text};
    return false;
  }

  /// What building and all passes took at the size before, and as many times more as there are
  /// more triangles: without a tree that is how time grows, and with one it grows by less.
  double forecast(const growth_series& s) const {
    const growth_point& last = s.points.back();
    const double passes = settings_.repeats + 1;
    const double spent = (s.by == way::serial ? last.build.values.median : 0) +
                         passes * last.figures.at(0).time.values.median;
    return spent * double(scene_.triangle_count()) / double(last.triangles);
  }

  void begin(growth_series& s, const std::string& name) {
    const bool has_budget = s.by != way::tree;
    if (has_budget && !s.points.empty() && !can_afford(s, forecast(s))) return;
    entry e{s, {}, nullptr, {}};
    e.point.mesh = name;
    e.point.scene_hash = hash_;
    e.point.triangles = scene_.triangle_count();
    e.on = make_contender(queue_, scene_, s.by, settings_);
    if (has_budget && s.points.empty()) {
      constexpr std::size_t step = 32;
      hits_of ignored;
      const double part = e.on->trace(some_of(eye_, step), false, ignored);
      if (!can_afford(s, part * step * (settings_.repeats + 1))) return;
    }
    warm_up(e, "eye", eye_, false);
    if (s.by == way::tree) {
      std::vector<hit> met;
      for (const tracer::hit& h : tree_hits_)
        met.push_back({h.t, h.u, h.v, h.instance, h.triangle});
      shadow_ = shadow_rays(scene_.meshes[0], eye_, met);
      bounce_ = bounce_rays(scene_.meshes[0], eye_, met);
      if (!shadow_.empty()) {
        warm_up(e, "shadow", shadow_, true);
        warm_up(e, "bounce", bounce_, false);
      }
    }
    entries_.push_back(std::move(e));
  }

  void warm_up(entry& e, const char* kind, const std::vector<ray>& rays, bool any) {
    growth_figure f{kind, rays.size(), 0, {}, std::nullopt};
    hits_of hits;
    f.warm_up_ms = e.on->trace(rays, any, hits);
    if (&rays == &eye_) {
      if (e.into.by == way::tree)
        tree_hits_ = hits;
      else if (!tree_hits_.empty())
        f.differing_hits = count_differing(tree_hits_, hits);
    }
    e.point.figures.push_back(std::move(f));
    e.rays.push_back({rays, any});
  }

  void pass(entry& e) {
    hits_of ignored;
    for (std::size_t k = 0; k < e.rays.size(); ++k)
      e.point.figures[k].time.ms.push_back(e.on->trace(e.rays[k].rays, e.rays[k].any, ignored));
  }

  const runtime::queue& queue_;
  const growth_settings& settings_;
  const std::vector<ray>& eye_;
  std::uint64_t asked_;
  growth_family& family_;
  scene scene_;
  std::string hash_;
  std::vector<ray> shadow_, bounce_;
  hits_of tree_hits_;
  std::vector<entry> entries_;
};

}  // namespace

const char* word_of(way w) {
  return w == way::tree ? "tree" : w == way::no_tree ? "no-tree" : "serial";
}

std::uint64_t growth_result::differing_hits() const {
  std::uint64_t sum = 0;
  for (const growth_family& f : families)
    for (const growth_series& s : f.series)
      for (const growth_point& p : s.points)
        for (const growth_figure& g : p.figures) sum += g.differing_hits.value_or(0);
  return sum;
}

growth_result measure_growth(const runtime::queue& queue, const growth_settings& s,
                             const growth_watch& watch) {
  growth_result r;
  r.from = study::origin_now(queue.get_device());
  r.kernel_hash = study::fingerprint_of(runtime::expand(tracer::kernel_sources(), "trace.cl"));
  r.settings = s;
  const std::vector<ray> eye = primary_rays(s.width, s.height);
  for (const std::string& name : s.families) {
    growth_family& family = r.families.emplace_back();
    family.name = name;
    for (std::size_t k = 0; k < ways.size(); ++k) family.series[k].by = ways[k];
    for (const std::uint64_t triangles : s.triangles) {
      size_run(queue, s, eye, triangles, family).measure();
      watch(r);
    }
  }
  r.complete = true;
  return r;
}

}  // namespace facet::bench
