#include "study/tree_quality.hpp"

#include <algorithm>
#include <vector>

namespace facet::study {
namespace {

using node = tracer::plain_tree::node;

/// In double: sums over many triangles must lose nothing.
double area(const box3f& b) { return box3d{vec3d(b.lo), vec3d(b.hi)}.half_area(); }

/// A root without a stored box is a leaf: all that is asked of its area is a share of itself.
double root_area(const tracer::plain_tree& t) {
  return t.nodes[0].is_leaf ? 1 : area(t.nodes[0].box);
}

}  // namespace

tree_quality quality_of(const tracer::plain_tree& t) {
  tree_quality q;
  if (t.nodes.empty()) return q;
  const double whole = root_area(t);
  std::vector<std::uint32_t> depth(t.nodes.size(), 0);
  double sum = 0, areas = 0;
  for (std::size_t i = 0; i < t.nodes.size(); ++i) {  // parents first
    const node& n = t.nodes[i];
    const double a = i == 0 ? whole : area(n.box);
    areas += a;
    if (n.is_leaf) {
      sum += a * n.count;
      ++q.leaves;
      q.primitives += n.count;
      q.depth = std::max(q.depth, depth[i]);
      q.most_in_leaf = std::max(q.most_in_leaf, n.count);
    } else {
      sum += a;
      ++q.inner_nodes;
      for (std::uint32_t c = 0; c < n.count; ++c) depth[n.first + c] = depth[i] + 1;
    }
  }
  if (whole > 0) q.sah_cost = sum / whole, q.visits = areas / whole;
  q.bytes_a_primitive = double(t.bytes) / double(q.primitives);
  return q;
}

double cost_with_best_leaves(const tracer::plain_tree& t, std::uint32_t most_in_leaf) {
  if (t.nodes.empty()) return 0;
  struct below {
    double cost;  // times A(root)
    std::uint64_t primitives;
  };
  const double whole = root_area(t);
  std::vector<below> found(t.nodes.size());
  for (std::size_t i = t.nodes.size(); i-- > 0;) {  // children first
    const node& n = t.nodes[i];
    const double a = i == 0 ? whole : area(n.box);
    below& b = found[i] = {a, n.count};
    if (n.is_leaf) {
      b.cost = a * n.count;
      continue;
    }
    b.primitives = 0;
    for (std::uint32_t c = 0; c < n.count; ++c) {
      b.cost += found[n.first + c].cost;
      b.primitives += found[n.first + c].primitives;
    }
    if (b.primitives <= most_in_leaf) b.cost = std::min(b.cost, a * double(b.primitives));
  }
  return whole > 0 ? found[0].cost / whole : 0;
}

}  // namespace facet::study
