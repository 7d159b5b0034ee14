#include "tracer/refit_order.hpp"

#include <algorithm>
#include <utility>

#include "tracer/layout.hpp"

namespace facet::tracer {
namespace {

/// A node's place: the treelet that it is in, that treelet's phase, and how many of its nodes lie
/// in the node's subtree.
struct place {
  std::uint32_t parent = FACET_NONE, treelet = 0, phase = 0, size = 1;
};

/// Counts become where each starts, with the end behind.
void sum_up(std::vector<std::uint32_t>& counts) {
  std::uint32_t sum = 0;
  for (std::uint32_t& n : counts) sum += std::exchange(n, sum);
}

}  // namespace

refit_order order_for_refit(std::span<const std::uint32_t> children, std::uint32_t width,
                            std::uint32_t root, std::uint32_t first_node, std::uint32_t most) {
  refit_order order{{}, {0}, {0}};
  if (root & FACET_LEAF_BIT) return order;

  // Parents first.
  std::vector<place> places(children.size() / width);
  std::vector<std::uint32_t> down, waiting{root - first_node};
  while (!waiting.empty()) {
    const std::uint32_t node = waiting.back();
    waiting.pop_back();
    down.push_back(node);
    for (std::uint32_t c = width; c-- > 0;) {
      const std::uint32_t child = children[std::size_t(width) * node + c];
      if (child & FACET_LEAF_BIT) continue;
      places[child - first_node].parent = node;
      waiting.push_back(child - first_node);
    }
  }

  // A node goes with those of its children's treelets that are of the latest phase, if they have
  // room together, and begins a phase otherwise.
  for (std::size_t k = down.size(); k-- > 0;) {
    place& p = places[down[k]];
    if (p.size > most) ++p.phase, p.size = 1;
    if (p.parent == FACET_NONE) continue;
    place& above = places[p.parent];
    if (p.phase > above.phase)
      above.phase = p.phase, above.size = 1 + p.size;
    else if (p.phase == above.phase)
      above.size += p.size;
  }

  std::vector<std::uint32_t> phase_of, sizes;  // by treelet, as they are met from the root down
  for (const std::uint32_t node : down) {
    place& p = places[node];
    const bool goes_on = p.parent != FACET_NONE && places[p.parent].phase == p.phase;
    p.treelet = goes_on ? places[p.parent].treelet : std::uint32_t(sizes.size());
    if (!goes_on) phase_of.push_back(p.phase), sizes.push_back(0);
    ++sizes[p.treelet];
  }

  // Treelets by phase, then nodes by treelet.
  order.phases.assign(places[down[0]].phase + 2, 0);
  for (const std::uint32_t phase : phase_of) ++order.phases[phase];
  sum_up(order.phases);
  std::vector<std::uint32_t> next = order.phases, rank(sizes.size());
  for (std::size_t t = 0; t < sizes.size(); ++t) rank[t] = next[phase_of[t]]++;
  order.starts.assign(sizes.size() + 1, 0);
  for (std::size_t t = 0; t < sizes.size(); ++t) order.starts[rank[t]] = sizes[t];
  sum_up(order.starts);
  next = order.starts;
  order.nodes.resize(down.size());
  for (std::size_t k = down.size(); k-- > 0;)
    order.nodes[next[rank[places[down[k]].treelet]]++] = down[k];
  return order;
}

}  // namespace facet::tracer
