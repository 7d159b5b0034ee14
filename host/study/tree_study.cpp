#include "study/tree_study.hpp"

#include "study/fingerprint.hpp"
#include "study/tree_makers.hpp"

namespace facet::study {
namespace {

class measurer {
 public:
  measurer(const runtime::queue& queue, const scene& s, const tree_settings& o,
           const std::function<void(std::uint64_t, std::uint64_t)>& watch)
      : queue_(queue), scene_(s), settings_(o), watch_(watch), packed_(tracer::pack(s, false)) {
    for (const tracer::packed_mesh& m : packed_.meshes)
      if (m.triangle_count > 0) shown_.push_back(std::size_t(&m - packed_.meshes.data()));
  }

  const std::vector<std::size_t>& shown() const { return shown_; }

  /// Each maker has a step to make trees and one to measure them.
  void set_total(std::uint64_t makers) { total_ = 2 * makers; }

  maker_result measure(const tree_maker& maker) {
    step();
    tracer::options o = settings_.tracer;
    o.tree = maker.kind.value_or(tracer::tree_kind::levels);
    std::vector<tracer::given_tree> given;
    if (!maker.kind)
      for (std::size_t k = 0; k < packed_.meshes.size(); ++k)
        given.push_back(packed_.meshes[k].triangle_count > 0 ? made_by(maker, corners_of(k))
                                                             : tracer::given_tree{});
    const tracer::device_scene device(queue_, scene_, o, given);
    const tracer::traced_trees trees = device.read_trees();
    const tracer::statistics facts = device.prepared();

    step();
    maker_result r{maker.word, facts.layout, facts.device_bytes, {}, {}};
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const auto corners = corners_of(shown_[i]);
      const tracer::plain_tree binary = maker.kind
                                            ? tracer::built_tree(queue_, *maker.kind, corners)
                                            : tracer::built_tree(given[shown_[i]], corners);
      measured_tree t;
      t.as_traced = quality_of(trees.meshes.at(i));
      t.overlap = overlap_of(trees.meshes.at(i), corners, settings_.samples, settings_.seed);
      t.binary_cost = cost_with_best_leaves(binary, settings_.most_in_leaf);
      r.meshes.push_back(t);
    }
    if (!trees.top.nodes.empty()) r.top = quality_of(trees.top);
    return r;
  }

 private:
  std::span<const tracer::texel> corners_of(std::size_t mesh) const {
    const tracer::packed_mesh& m = packed_.meshes[mesh];
    return std::span<const tracer::texel>(packed_.corners)
        .subspan(3 * std::size_t(m.first_triangle), 3 * std::size_t(m.triangle_count));
  }

  void step() { watch_(done_++, total_); }

  runtime::queue queue_;
  const scene& scene_;
  const tree_settings& settings_;
  const std::function<void(std::uint64_t, std::uint64_t)>& watch_;
  tracer::packed_scene packed_;
  std::vector<std::size_t> shown_;
  std::uint64_t done_ = 0, total_ = 0;
};

}  // namespace

trees_result measure_trees(const runtime::queue& queue, const scene& s, const tree_settings& o,
                           const std::function<void(std::uint64_t, std::uint64_t)>& watch) {
  trees_result r{origin_now(queue.get_device()), s.name, fingerprint_of(s), o, {}, {}};
  measurer m(queue, s, o, watch);
  for (const std::size_t k : m.shown())
    r.meshes.push_back({s.meshes[k].name, s.meshes[k].triangle_count()});
  bool has_sweep = false;
  for (const std::string& word : o.makers) has_sweep = has_sweep || word == "sweep";
  m.set_total(o.makers.size() + (has_sweep ? 0 : 1));

  const maker_result sweep = m.measure(*tree_maker_of("sweep"));
  for (const std::string& word : o.makers) {
    r.makers.push_back(word == "sweep" ? sweep : m.measure(*tree_maker_of(word)));
    for (std::size_t i = 0; i < r.meshes.size(); ++i) {
      measured_tree& t = r.makers.back().meshes[i];
      t.sweep_cost = sweep.meshes[i].as_traced.sah_cost;
      t.sweep_overlap = sweep.meshes[i].overlap.value;
      t.sweep_binary_cost = sweep.meshes[i].binary_cost;
    }
  }
  return r;
}

}  // namespace facet::study
