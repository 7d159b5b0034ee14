// The transparent objects that a ray is in, as a stack from which any may be taken.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/scene.hpp"

namespace facet::reference {

/// By their materials, the last one entered at the back: at most so many, of which the first is
/// forgotten when one more is entered.
class media {
 public:
  explicit media(std::uint32_t most = 1) : most_(most) {}

  bool empty() const { return size_ == 0; }
  std::uint32_t innermost() const { return of_[size_ - 1]; }
  std::span<const std::uint32_t> all() const { return std::span(of_).first(size_); }
  bool holds(std::uint32_t material) const { return std::ranges::count(all(), material) > 0; }

  /// False if one had to be forgotten.
  bool enter(std::uint32_t material) {
    const bool is_full = size_ == most_;
    if (is_full) remove(0);
    of_[size_++] = material;
    return !is_full;
  }

  /// The last one entered of that material, wherever it stands; nothing if there is none.
  void leave(std::uint32_t material) {
    for (std::size_t k = size_; k-- > 0;)
      if (of_[k] == material) return remove(k);
  }

 private:
  void remove(std::size_t k) {
    for (; k + 1 < of_.size(); ++k) of_[k] = of_[k + 1];
    --size_;
  }

  std::array<std::uint32_t, limits::nesting> of_{};
  std::size_t size_ = 0, most_;
};

}  // namespace facet::reference
