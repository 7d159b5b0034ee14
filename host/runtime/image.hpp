// Pictures that kernels read and write through the texture path (SYCL 2020, section 4.7.3).
#pragma once

#include <cstddef>
#include <memory>

#include "runtime/memory.hpp"

namespace facet::runtime {

/// An image of RGBA pixels, 4 floats each, rows without gaps. A cheap handle, allocated as a buffer
/// is; sides beyond the device's limits are refused then, with both figures. The host reads it by
/// handler::copy into a buffer.
class image2d {
 public:
  /// Undefined contents. Throws errc::invalid if a side is 0.
  image2d(std::size_t width, std::size_t height)
      : width_(width), height_(height), memory_(detail::make_image2d(width, height)) {}

  /// Copies width*height*4 floats from `rgba` now.
  image2d(const float* rgba, std::size_t width, std::size_t height) : image2d(width, height) {
    detail::copy_in(*memory_, rgba);
  }

  std::size_t width() const noexcept { return width_; }
  std::size_t height() const noexcept { return height_; }
  std::size_t byte_size() const noexcept { return detail::byte_size(*memory_); }

  native::memory get() const { return detail::native_handle(*memory_); }
  const std::shared_ptr<detail::memory>& memory() const noexcept { return memory_; }
  friend bool operator==(const image2d&, const image2d&) = default;

 private:
  std::size_t width_, height_;
  std::shared_ptr<detail::memory> memory_;
};

}  // namespace facet::runtime
