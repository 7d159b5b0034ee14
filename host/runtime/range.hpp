// How many work-items, and in what groups: range, id, nd_range (SYCL 2020, section 4.9.1).
// Dimension 0 is get_global_id(0) of the kernel, the one that runs fastest: OpenCL's order.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

namespace facet::runtime {

namespace detail {

/// D sizes with what range and id share; Tag keeps them apart.
template <int D, class Tag>
class extents {
  static_assert(D >= 1 && D <= 3, "OpenCL has 1, 2 or 3 dimensions");

 public:
  static constexpr int dimensions = D;

  constexpr extents() = default;
  template <std::convertible_to<std::size_t>... Sizes>
  requires(sizeof...(Sizes) == D) constexpr extents(Sizes... sizes)
      : sizes_{static_cast<std::size_t>(sizes)...} {}

  constexpr std::size_t get(int dimension) const { return sizes_[std::size_t(dimension)]; }
  constexpr std::size_t& operator[](int dimension) { return sizes_[std::size_t(dimension)]; }
  constexpr std::size_t operator[](int dimension) const { return sizes_[std::size_t(dimension)]; }
  constexpr const std::size_t* data() const { return sizes_.data(); }

  friend constexpr bool operator==(const extents&, const extents&) = default;

 protected:
  std::array<std::size_t, D> sizes_{};
};

struct range_tag;
struct id_tag;

}  // namespace detail

/// Work-items along each dimension.
template <int D>
class range : public detail::extents<D, detail::range_tag> {
 public:
  using detail::extents<D, detail::range_tag>::extents;

  /// The product of all dimensions.
  constexpr std::size_t size() const {
    std::size_t product = 1;
    for (std::size_t s : this->sizes_) product *= s;
    return product;
  }
};

/// A place in a range.
template <int D>
class id : public detail::extents<D, detail::id_tag> {
 public:
  using detail::extents<D, detail::id_tag>::extents;
};

template <std::convertible_to<std::size_t>... Sizes>
range(Sizes...) -> range<int(sizeof...(Sizes))>;
template <std::convertible_to<std::size_t>... Sizes>
id(Sizes...) -> id<int(sizeof...(Sizes))>;

/// A global range cut into work-groups. `global` must be a multiple of `local` in each dimension:
/// OpenCL 1.2 has no smaller groups at the rim. `offset` is added to every global id.
template <int D>
class nd_range {
 public:
  static constexpr int dimensions = D;

  constexpr nd_range(range<D> global, range<D> local, id<D> offset = {})
      : global_(global), local_(local), offset_(offset) {}

  constexpr range<D> get_global_range() const { return global_; }
  constexpr range<D> get_local_range() const { return local_; }
  /// Groups along each dimension.
  constexpr range<D> get_group_range() const {
    range<D> groups = global_;
    for (int d = 0; d < D; ++d) groups[d] /= local_[d];
    return groups;
  }
  constexpr id<D> get_offset() const { return offset_; }

 private:
  range<D> global_, local_;
  id<D> offset_;
};

}  // namespace facet::runtime
