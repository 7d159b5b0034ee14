// Which C++ types can be a kernel's argument by value.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <type_traits>

#include "runtime/accessor.hpp"
#include "runtime/range.hpp"

namespace facet::runtime {

/// OpenCL's 64-bit integers. They are spelled out because std::uint64_t is the same type as size_t
/// on common platforms, and a size_t is no kernel argument: its size is the device's business.
struct ulong_value {
  std::uint64_t value;
};
struct long_value {
  std::int64_t value;
};

namespace detail {

template <class T, class... Others>
concept one_of = (std::same_as<T, Others> || ...);

template <class T>
struct is_std_array : std::false_type {};
template <class T, std::size_t N>
struct is_std_array<std::array<T, N>> : std::true_type {};

template <class T>
struct is_extents : std::false_type {};
template <int D>
struct is_extents<range<D>> : std::true_type {};
template <int D>
struct is_extents<id<D>> : std::true_type {};
template <int D>
struct is_extents<nd_range<D>> : std::true_type {};

template <class T>
constexpr bool scalar_argument = one_of<T, char, signed char, unsigned char, short, unsigned short,
                                        int, unsigned, float, double> ||
                                 (one_of<T, long long, unsigned long long> &&
                                  !one_of<T, std::size_t, std::ptrdiff_t>);

/// OpenCL's 3-vectors take the room of 4: three scalars in a row are not one of them.
template <class T>
constexpr bool three_scalars = alignof(T) <= 8 && sizeof(T) == 3 * alignof(T);

/// device, platform, smart pointers: trivially copyable, perhaps, and no less a pointer.
template <class T>
concept holds_handle = requires(const T& t) {
  requires std::is_pointer_v<decltype(t.get())>;
};

template <class T>
constexpr bool value_argument() {
  if constexpr (std::is_enum_v<T>) {
    return scalar_argument<std::underlying_type_t<T>>;
  } else if constexpr (is_std_array<T>::value) {
    return value_argument<typename T::value_type>() && !three_scalars<T>;
  } else if constexpr (std::is_class_v<T> || std::is_union_v<T>) {
    return std::is_trivially_copyable_v<T> && std::is_standard_layout_v<T> && !std::is_empty_v<T> &&
           !three_scalars<T> && !is_extents<T>::value && !std::ranges::range<T> && !holds_handle<T>;
  } else {
    return scalar_argument<T>;
  }
}

template <class T>
struct is_accessor : std::false_type {};
template <class T, access_mode M>
struct is_accessor<accessor<T, M>> : std::true_type {};
template <access_mode M>
struct is_accessor<image_accessor<M>> : std::bool_constant<M != access_mode::read_write> {};
template <class T>
struct is_accessor<local_accessor<T>> : std::true_type {};

}  // namespace detail

/// What handler::set_args takes: accessors; 8 to 32-bit integers, long long, float, double and
/// enumerations of them; trivially copyable standard-layout structs, std::array and ulong_value.
/// Not: pointers, bool, long and size_t (use ulong_value), long double, character types wider than
/// char, and three scalars in a struct or array (OpenCL's float3 takes 16 bytes: pass four).
/// Pointers inside a struct are not seen.
template <class T>
concept can_be_argument = detail::is_accessor<T>::value || detail::value_argument<T>();

}  // namespace facet::runtime
