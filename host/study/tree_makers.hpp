// Who makes a mesh's tree: the device's builders, and the reference's, which are handed to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tracer/plain_tree.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

/// What commands call it, and the device's builder that it is; none for those of the reference.
struct tree_maker {
  std::string word;
  std::optional<tracer::tree_kind> kind;
};

/// levels; sah (reference/sah.hpp, leaves of up to eight triangles, which either layout tests for
/// the price of a node); sweep (reference/full_sweep.hpp, leaves of up to four).
const std::vector<tree_maker>& tree_makers();

/// By its word; null if there is none.
const tree_maker* tree_maker_of(const std::string& word);

/// The reference's tree over triangles, three corners each, as the device takes it.
tracer::given_tree made_by(const tree_maker& m, std::span<const tracer::texel> corners);

}  // namespace facet::study
