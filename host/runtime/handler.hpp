// One command group: its requirements, its kernel's arguments, its action (SYCL 2020, section
// 4.9.4).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "runtime/accessor.hpp"
#include "runtime/argument.hpp"
#include "runtime/event.hpp"
#include "runtime/program.hpp"
#include "runtime/queue.hpp"
#include "runtime/range.hpp"

namespace facet::runtime {

namespace detail {
struct command_group;
/// A launch's sizes, of any dimension; no local size is the driver's choice.
struct launch_shape {
  int dimensions = 1;
  bool has_local = false;
  std::size_t global[3] = {1, 1, 1}, local[3] = {1, 1, 1}, offset[3] = {0, 0, 0};
};
}  // namespace detail

/// Given to the function that queue::submit calls. One action (a launch, a copy or a fill) a group;
/// it is enqueued when that function returns, and what the runtime can check is checked then,
/// before the driver is asked: arguments against the kernel (errc::kernel_argument), sizes against
/// the kernel as compiled (errc::nd_range), memory against the device (errc::memory_allocation).
class handler {
 public:
  explicit handler(detail::command_group& group) : group_(group) {}
  handler(const handler&) = delete;
  handler& operator=(const handler&) = delete;

  /// All arguments of the kernel, in order.
  template <class... Args>
  void set_args(const Args&... args) {
    clear_args();
    std::uint32_t index = 0;
    (set_arg(index++, args), ...);
  }

  /// Argument `index` of the kernel; see can_be_argument.
  template <class T>
  void set_arg(std::uint32_t index, const T& value) {
    static_assert(can_be_argument<T>,
                  "OpenCL cannot take this type as a kernel argument (runtime/argument.hpp)");
    set_value(index, &value, sizeof(T));
  }
  template <class T, access_mode M>
  void set_arg(std::uint32_t index, const accessor<T, M>& a) {
    set_memory(index, a.memory(), M);
  }
  template <access_mode M>
  void set_arg(std::uint32_t index, const image_accessor<M>& a) {
    static_assert(M != access_mode::read_write, "a kernel reads an image or writes it");
    set_memory(index, a.memory(), M);
  }
  template <class T>
  void set_arg(std::uint32_t index, const local_accessor<T>& a) {
    set_local(index, a.byte_size());
  }

  /// The group also waits for these.
  void depends_on(const event& e);
  void depends_on(const std::vector<event>& events);

  /// One work-item for each place in `items`; the driver chooses the work-groups, unless the
  /// kernel requires a size. A range with a 0 launches nothing.
  template <int D>
  void parallel_for(range<D> items, const kernel& k) {
    detail::launch_shape s{.dimensions = D};
    for (int i = 0; i < D; ++i) s.global[i] = items[i];
    launch(s, k);
  }
  template <int D>
  void parallel_for(nd_range<D> items, const kernel& k) {
    detail::launch_shape s{.dimensions = D, .has_local = true};
    for (int i = 0; i < D; ++i) {
      s.global[i] = items.get_global_range()[i];
      s.local[i] = items.get_local_range()[i];
      s.offset[i] = items.get_offset()[i];
    }
    launch(s, k);
  }
  /// One work-item.
  void single_task(const kernel& k) { launch({.has_local = true}, k); }

  /// Copies all of `from` to the start of `to`, which must be as large (errc::invalid).
  template <class T, access_mode From, access_mode To>
  void copy(const accessor<T, From>& from, const accessor<T, To>& to) {
    static_assert(reads(From) && writes(To), "copy reads the first and writes the second");
    copy_buffer(from.memory(), to.memory());
  }
  /// Between a buffer and an image of width*height*16 bytes. The buffer may be larger.
  template <class T, access_mode From, access_mode To>
  void copy(const accessor<T, From>& from, const image_accessor<To>& to) {
    static_assert(reads(From) && writes(To), "copy reads the first and writes the second");
    copy_to_image(from.memory(), to.memory());
  }
  template <class T, access_mode From, access_mode To>
  void copy(const image_accessor<From>& from, const accessor<T, To>& to) {
    static_assert(reads(From) && writes(To), "copy reads the first and writes the second");
    copy_from_image(from.memory(), to.memory());
  }
  /// All elements of the accessor's buffer; the host memory must live until the event completes.
  template <class T, access_mode From>
  void copy(const accessor<T, From>& from, T* to) {
    static_assert(reads(From), "copy reads the first");
    copy_to_host(from.memory(), to);
  }
  template <class T, access_mode To>
  void copy(const T* from, const accessor<T, To>& to) {
    static_assert(writes(To), "copy writes the second");
    copy_from_host(from, to.memory());
  }

  /// Every element becomes `value`.
  template <class T, access_mode To>
  void fill(const accessor<T, To>& to, const std::type_identity_t<T>& value) {
    static_assert(writes(To), "fill writes");
    static_assert(std::has_single_bit(sizeof(T)) && sizeof(T) <= 128,
                  "OpenCL fills with elements of 1, 2, 4, ... 128 bytes");
    fill_buffer(to.memory(), &value, sizeof(T));
  }

 private:
  friend void detail::require(handler&, const std::shared_ptr<detail::memory>&, access_mode, bool);
  using memory_ptr = std::shared_ptr<detail::memory>;

  void clear_args();
  void set_value(std::uint32_t index, const void* value, std::size_t bytes);
  void set_memory(std::uint32_t index, const memory_ptr& m, access_mode mode);
  void set_local(std::uint32_t index, std::size_t bytes);
  void launch(const detail::launch_shape& shape, const kernel& k);
  void copy_buffer(const memory_ptr& from, const memory_ptr& to);
  void copy_to_image(const memory_ptr& from, const memory_ptr& to);
  void copy_from_image(const memory_ptr& from, const memory_ptr& to);
  void copy_to_host(const memory_ptr& from, void* to);
  void copy_from_host(const void* from, const memory_ptr& to);
  void fill_buffer(const memory_ptr& to, const void* value, std::size_t bytes);

  detail::command_group& group_;
};

}  // namespace facet::runtime
