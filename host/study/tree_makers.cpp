#include "study/tree_makers.hpp"

#include <algorithm>
#include <stdexcept>

#include "reference/full_sweep.hpp"

namespace facet::study {

const std::vector<tree_maker>& tree_makers() {
  static const std::vector<tree_maker> all{{"levels", tracer::tree_kind::levels},
                                           {"binned", tracer::tree_kind::binned},
                                           {"sah", {}},
                                           {"sweep", {}}};
  return all;
}

const tree_maker* tree_maker_of(const std::string& word) {
  const auto& all = tree_makers();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const tree_maker& m) { return m.word == word; });
  return found == all.end() ? nullptr : &*found;
}

tracer::given_tree made_by(const tree_maker& m, std::span<const tracer::texel> corners) {
  std::vector<box3f> boxes(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    boxes[i / 3].add(vec3f{corners[i][0], corners[i][1], corners[i][2]});
  const reference::sah_tree tree =
      m.word == "sweep" ? reference::sweep_sah(boxes, 4) : reference::build_sah(boxes, 8);
  tracer::given_tree given;
  given.nodes.reserve(tree.nodes.size());
  for (const reference::sah_node& n : tree.nodes) given.nodes.push_back({n.first, n.count});
  given.order = tree.order;
  return given;
}

}  // namespace facet::study
