#include "tracer/levels.hpp"

#include <bit>
#include <numeric>

#include "tracer/built_tree_helper.hpp"
#include "tracer/morton.hpp"

using namespace facet;
using namespace facet::tracer;
using test::box_of;
using test::checked;
using test::shape;
using test::soup;

namespace {

float half_area(const Box& b) {
  const float x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1], z = b.hi[2] - b.lo[2];
  return (x * y + y * z) + z * x;
}

/// The radix tree as it is defined, from the root down: a range of sorted places is parted where
/// the highest bit of (code, place) changes that is not the same in all of it.
class radix_tree {
 public:
  radix_tree(const std::vector<texel>& corners, leaf_rule rule) : corners_(corners), rule_(rule) {
    const auto n = std::uint32_t(corners.size() / 3);
    runtime::buffer<texel> in(corners.data(), corners.size());
    runtime::buffer<Curve> curve(1);
    runtime::buffer<std::uint32_t> codes(n);
    std::vector<step> steps;
    morton<texel>(test::queue(), kernel_sources(), tuning_for(test::device()))
        .codes(in, curve, codes, n, steps);
    const auto by_primitive = test::content(codes);
    order_.resize(n);
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return by_primitive[a] < by_primitive[b];
    });
    for (std::uint32_t i = 0; i < n; ++i)
      keys_.push_back(std::uint64_t(by_primitive[order_[i]]) << 32 | i);
    put(0, n, found_);
  }

  const shape& found() const { return found_; }

 private:
  Box box(std::uint32_t begin, std::uint32_t end) const {
    Box all{{INFINITY, INFINITY, INFINITY}, 0, {-INFINITY, -INFINITY, -INFINITY}, 0};
    for (std::uint32_t i = begin; i < end; ++i) {
      const Box b = box_of(corners_, order_[i]);
      for (int c = 0; c < 3; ++c) {
        all.lo[c] = std::min(all.lo[c], b.lo[c]);
        all.hi[c] = std::max(all.hi[c], b.hi[c]);
      }
    }
    return all;
  }

  void put(std::uint32_t begin, std::uint32_t end, shape& to) {
    const std::uint32_t size = end - begin;
    std::uint32_t middle = begin + 1;
    if (size > 1) {
      const std::uint64_t bit = std::bit_floor(keys_[begin] ^ keys_[end - 1]);
      while (!(keys_[middle] & bit)) ++middle;
    }
    const Box left = box(begin, middle), right = box(middle, end);
    bool is_leaf = size <= rule_.sure;
    if (!is_leaf && size <= rule_.most) {
      const float cost =
          half_area(left) * float(middle - begin) + half_area(right) * float(end - middle);
      is_leaf = half_area(box(begin, end)) * float(size - 1) <= cost;
    }
    if (is_leaf) {
      to.leaves.push_back(size);
      for (std::uint32_t i = begin; i < end; ++i) to.leaves.push_back(order_[i]);
      return;
    }
    to.leaves.push_back(0);
    const auto put_side = [&](const Box& b, std::uint32_t from, std::uint32_t until) {
      for (int c = 0; c < 3; ++c)
        to.boxes.push_back(b.lo[c] + 0.0f), to.boxes.push_back(b.hi[c] + 0.0f);
      put(from, until, to);
    };
    put_side(left, begin, middle);
    put_side(right, middle, end);
  }

  const std::vector<texel>& corners_;
  leaf_rule rule_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint64_t> keys_;
  shape found_;
};

/// Both faces give the radix tree.
void check(const std::vector<texel>& corners, leaf_rule rule) {
  const auto n = std::uint32_t(corners.size() / 3);
  CAPTURE(n);
  CAPTURE(rule.most);
  const radix_tree expected(corners, rule);
  const auto at = [&](std::uint32_t i) { return box_of(corners, i); };
  for (const std::size_t face : {0u, 1u}) {
    CAPTURE(face);
    CHECK((checked<texel>(face, tree_kind::levels, corners, n, rule, at) == expected.found()));
  }
}

}  // namespace

TEST_CASE("the tree is the radix tree, by either face, in any size, with any leaves") {
  for (const leaf_rule rule : {leaf_rule{2, 4}, block_leaves, leaf_rule{1, 1}, leaf_rule{1, 16}}) {
    for (std::uint32_t n = 1; n <= 70; ++n) check(soup(n, 0.1f), rule);
    for (const std::uint32_t n : {255u, 1000u, 33000u}) check(soup(n, 0.02f), rule);
  }
}

TEST_CASE("equal codes are parted by position: depth ceil(log2 n)") {
  for (const std::uint32_t n : {2u, 3u, 33u, 4096u, 100'000u}) {
    CAPTURE(n);
    const std::vector<texel> corners(3 * std::size_t(n), texel{1, 2, 3, 0});
    check(corners, {1, 1});
    for (const tuning& t : test::faces()) {
      runtime::buffer<texel> in(corners.data(), corners.size());
      node_tree tree;
      tree_builder<texel>(test::queue(), kernel_sources(), t, tree_kind::levels, {1, 1})
          .build(in, n, tree);
      CHECK(tree.depth == std::uint32_t(std::bit_width(n - 1)));
    }
  }
}

TEST_CASE("a curve as deep as codes go: runs that cannot be joined before the others are") {
  // Centres that halve their distance to a corner part at one bit each; many at each place.
  for (const std::uint32_t each : {1u, 40u, 3000u}) {
    std::vector<texel> corners;
    for (int i = 0; i < 40; ++i)
      for (std::uint32_t k = 0; k < each; ++k)
        for (int c = 0; c < 3; ++c) {
          const float x = std::ldexp(1.0f, -i) * (1 + 1e-5f * float(k));
          corners.push_back({i % 2 ? x : 1 - x, 0, 0, 0});
        }
    check(corners, {2, 4});
  }
}

TEST_CASE("a tree with more nodes than usual is built again, in more room") {
  // Leaves of one: more nodes than 0.62 a primitive, which is what room is made for.
  tree_builder<texel> builder(test::queue(), kernel_sources(), test::faces()[0], tree_kind::levels,
                              {2, 2});
  const std::uint32_t n = 60'000;
  // Pairs far from each other, a third alone.
  const auto corners = soup(n, 0.001f);
  runtime::buffer<texel> in(corners.data(), corners.size());
  node_tree tree;
  builder.build(in, n, tree);
  CHECK(tree.node_count > 0.62 * n);
  CHECK(tree.node_count <= tree.nodes.size());
}
