// A buffer's contents, on the host (SYCL 2020, section 4.7.6.10).
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

#include "runtime/access.hpp"
#include "runtime/buffer.hpp"

namespace facet::runtime {

/// Waits for the commands that use this buffer in a conflicting way, and for no others; maps it;
/// gives it back when it dies, after which commands see what was written. While one lives, a
/// command group that conflicts with it is refused (errc::accessor), where SYCL would hold the
/// group back: without a thread of its own, the runtime could only deadlock.
template <class T, access_mode M = access_mode::read_write>
class host_accessor {
 public:
  using value_type = std::conditional_t<writes(M), T, const T>;

  explicit host_accessor(const buffer<T>& b, mode_tag<M> = {}) : host_accessor(b, false) {}
  host_accessor(const buffer<T>& b, mode_tag<M>, no_init_tag) : host_accessor(b, true) {
    static_assert(writes(M), "no_init is for memory that is written");
  }
  ~host_accessor() { detail::close_host(*memory_, const_cast<T*>(data_), M); }
  host_accessor(const host_accessor&) = delete;
  host_accessor& operator=(const host_accessor&) = delete;

  value_type& operator[](std::size_t i) const noexcept { return data_[i]; }
  value_type* data() const noexcept { return data_; }
  value_type* begin() const noexcept { return data_; }
  value_type* end() const noexcept { return data_ + size(); }
  std::size_t size() const noexcept { return detail::byte_size(*memory_) / sizeof(T); }
  bool empty() const noexcept { return size() == 0; }

 private:
  host_accessor(const buffer<T>& b, bool discard)
      : memory_(b.memory()), data_(static_cast<T*>(detail::open_host(*memory_, M, discard))) {}

  std::shared_ptr<detail::memory> memory_;
  value_type* data_;
};

template <class T>
host_accessor(const buffer<T>&) -> host_accessor<T, access_mode::read_write>;

}  // namespace facet::runtime
