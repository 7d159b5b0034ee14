// Walking a wide tree along a ray. Tree boxes only spare work: what is skipped here provably holds
// no accepted triangle, and what is not skipped is decided by triangle.hpp alone.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "reference/space.hpp"
#include "reference/wide_tree.hpp"

namespace facet::reference {

/// Four values side by side; GCC's and Clang's vector extension.
template <class T>
struct lanes_of;
template <>
struct lanes_of<float> {
  typedef float type __attribute__((vector_size(tree_width * sizeof(float))));
};
template <>
struct lanes_of<double> {
  typedef double type __attribute__((vector_size(tree_width * sizeof(double))));
};
template <class T>
using lanes = typename lanes_of<T>::type;

inline void load(lanes<float>& to, const std::array<float, tree_width>& from) {
  std::memcpy(&to, from.data(), sizeof to);
}
inline void load(lanes<double>& to, const std::array<float, tree_width>& from) {
  to = lanes<double>{from[0], from[1], from[2], from[3]};
}

/// Bit k is set where lane k of a comparison is true.
template <class Mask>
unsigned bits_of(const Mask& m) {
  return unsigned(m[0] & 1) | unsigned(m[1] & 2) | unsigned(m[2] & 4) | unsigned(m[3] & 8);
}

/// x in every lane. Lanes travel by reference: by value their ABI depends on the target.
template <class T>
void fill(lanes<T>& to, T x) {
  to = lanes<T>{x, x, x, x};
}

/// Slabs that contain the canonical ones (space::slab) without its fma: each of b * inv and the sum
/// is off by at most u * reach * |inv| or so, which 8u more of pad covers, and the smallest normal
/// number covers what underflows.
template <class T>
struct loose_slabs {
  struct axis {
    lanes<T> inverse, near_offset, far_offset;
    std::size_t near_plane;
  };
  std::array<axis, 3> axes;

  explicit loose_slabs(const space<T>& s) {
    for (int i = 0; i < 3; ++i) {
      const T inverse = s.inverse[i], size = std::abs(inverse);
      const T p = (T(1.5) * s.pad) * size + std::numeric_limits<T>::min();
      const T c = -(s.origin[i] * inverse);
      axis& a = axes[std::size_t(i)];
      a.near_plane = std::size_t(2 * i + (inverse > 0 ? 0 : 1));
      // Near overflow an axis constrains nothing.
      const bool in_range = s.reach[i] * size < T(0x1p120);
      fill<T>(a.inverse, in_range ? inverse : 0);
      fill<T>(a.near_offset, in_range ? c - p : -infinity<T>);
      fill<T>(a.far_offset, in_range ? c + p : infinity<T>);
    }
  }
};

/// Calls leaf(i) for every leaf that may hold a triangle accepted between tmin and `limit`, near
/// ones first; `limit` may shrink under way. Ends early when leaf returns true, and returns that.
template <class T, class Leaf>
bool walk(const wide_tree& tree, const loose_slabs<T>& s, T tmin, const T& limit, Leaf&& leaf) {
  struct entry {
    T near;
    std::uint32_t child;
  };
  std::array<entry, wide_tree::stack_size> stack;
  std::size_t top = 0;
  const wide_node* nodes = tree.nodes.data();
  std::uint32_t child = tree.root;
  for (;;) {
    if (child & leaf_bit) {
      if (child != no_child && leaf(child & ~leaf_bit)) return true;
    } else {
      const wide_node& n = nodes[child];
      lanes<T> near, far;
      fill<T>(near, tmin), fill<T>(far, limit);
      for (const auto& axis : s.axes) {
        lanes<T> a, b;
        load(a, n.plane[axis.near_plane]), load(b, n.plane[axis.near_plane ^ 1]);
        a = a * axis.inverse + axis.near_offset;
        b = b * axis.inverse + axis.far_offset;
        near = a > near ? a : near;
        far = b < far ? b : far;
      }
      if (unsigned mask = bits_of(near <= far); mask != 0) {
        auto k = std::size_t(std::countr_zero(mask));
        child = n.child[k];
        if ((mask &= mask - 1) == 0) continue;
        entry nearest{near[k], child};
        const std::size_t base = top;
        for (; mask != 0; mask &= mask - 1) {
          k = std::size_t(std::countr_zero(mask));
          entry e{near[k], n.child[k]};
          if (e.near < nearest.near) std::swap(e, nearest);
          std::size_t at = top++;
          for (; at > base && stack[at - 1].near < e.near; --at) stack[at] = stack[at - 1];
          stack[at] = e;
        }
        child = nearest.child;
        continue;
      }
    }
    do {
      if (top == 0) return false;
      --top;
    } while (stack[top].near > limit);
    child = stack[top].child;
  }
}

}  // namespace facet::reference
