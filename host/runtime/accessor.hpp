// What a command group reads and writes (SYCL 2020, sections 4.7.6.9 and 4.7.6.11).
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>

#include "runtime/access.hpp"
#include "runtime/buffer.hpp"
#include "runtime/error.hpp"
#include "runtime/image.hpp"

namespace facet::runtime {

class handler;

namespace detail {
/// Enters `m` into the group's requirements.
void require(handler& h, const std::shared_ptr<memory>& m, access_mode mode, bool discard);
}  // namespace detail

/// A buffer as one command group uses it: made inside the group, for that group alone. The commands
/// that the group must wait for follow from the mode: a reader waits for the last writer, a writer
/// also for the readers since. Several accessors of one buffer in a group add up.
template <class T, access_mode M = access_mode::read_write>
class accessor {
 public:
  static constexpr access_mode mode = M;

  accessor(const buffer<T>& b, handler& h, mode_tag<M> = {}) : memory_(b.memory()) {
    detail::require(h, memory_, M, false);
  }
  accessor(const buffer<T>& b, handler& h, mode_tag<M>, no_init_tag) : memory_(b.memory()) {
    static_assert(writes(M), "no_init is for memory that is written");
    detail::require(h, memory_, M, true);
  }

  std::size_t size() const noexcept { return byte_size() / sizeof(T); }
  std::size_t byte_size() const noexcept { return detail::byte_size(*memory_); }
  const std::shared_ptr<detail::memory>& memory() const noexcept { return memory_; }

 private:
  std::shared_ptr<detail::memory> memory_;
};

template <class T>
accessor(const buffer<T>&, handler&) -> accessor<T, access_mode::read_write>;

/// An image as one command group uses it. A kernel of OpenCL C 1.2 reads an image or writes it;
/// read_write is for copies.
template <access_mode M>
class image_accessor {
 public:
  static constexpr access_mode mode = M;

  image_accessor(const image2d& i, handler& h, mode_tag<M>) : image_(i) {
    detail::require(h, i.memory(), M, false);
  }
  image_accessor(const image2d& i, handler& h, mode_tag<M>, no_init_tag) : image_(i) {
    static_assert(writes(M), "no_init is for memory that is written");
    detail::require(h, i.memory(), M, true);
  }

  std::size_t width() const noexcept { return image_.width(); }
  std::size_t height() const noexcept { return image_.height(); }
  const std::shared_ptr<detail::memory>& memory() const noexcept { return image_.memory(); }

 private:
  image2d image_;
};

/// `count` elements of local memory, for a kernel's argument `__local T*`. Throws errc::invalid for
/// 0 elements, which OpenCL refuses.
template <class T>
class local_accessor {
 public:
  local_accessor(std::size_t count, handler&) : count_(count) {
    if (count == 0 || count > std::numeric_limits<std::size_t>::max() / sizeof(T))
      throw exception(errc::invalid, "a local_accessor of " + std::to_string(count) +
                                         " elements of " + std::to_string(sizeof(T)) +
                                         " bytes: at least 1 is needed, and the bytes must fit "
                                         "std::size_t");
  }

  std::size_t size() const noexcept { return count_; }
  std::size_t byte_size() const noexcept { return count_ * sizeof(T); }

 private:
  std::size_t count_;
};

}  // namespace facet::runtime
