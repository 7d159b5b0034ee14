// Kernels compiled from source for a context (SYCL 2020, section 4.11: kernel bundles; an
// executable one, whose specialisation constants are -D options).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/context.hpp"
#include "runtime/native.hpp"
#include "runtime/source_tree.hpp"

namespace facet::runtime {

namespace detail {
struct kernel_state;
struct program_state;
}  // namespace detail

/// A cheap handle: copies are the same kernel. May be used from several threads: arguments are kept
/// by the command group and set under the kernel's lock as it is launched.
class kernel {
 public:
  explicit kernel(std::shared_ptr<detail::kernel_state> state) : state_(std::move(state)) {}

  std::string name() const;
  std::uint32_t num_args() const;
  /// The most work-items of a group that this kernel, as compiled, can have on this device.
  std::size_t work_group_size(const device& d) const;
  /// Sizes are best a multiple of this.
  std::size_t preferred_work_group_size_multiple(const device& d) const;
  std::uint64_t private_mem_size(const device& d) const;  ///< bytes a work-item
  std::uint64_t local_mem_size(const device& d) const;    ///< bytes a group, but for arguments

  native::kernel get() const noexcept;
  const std::shared_ptr<detail::kernel_state>& state() const noexcept { return state_; }
  friend bool operator==(const kernel&, const kernel&) = default;

 private:
  std::shared_ptr<detail::kernel_state> state_;
};

/// A cheap handle to an immutable program.
class program {
 public:
  /// Compiles main_file, expanded, for all devices of the context, with `options` and
  /// -cl-kernel-arg-info (argument checks need it). Throws errc::build with options and build log.
  program(const context& c, const source_tree& sources, const std::string& main_file,
          const std::string& options = "");

  /// Throws errc::kernel for an unknown name, with the names there are.
  kernel get_kernel(std::string_view name) const;
  std::vector<std::string> kernel_names() const;

  double build_ms() const noexcept;             ///< host clock, expansion included
  const std::string& options() const noexcept;  ///< as the compiler got them
  const std::string& log() const noexcept;      ///< warnings; empty if there were none

  native::program get() const noexcept;

 private:
  std::shared_ptr<const detail::program_state> state_;
};

}  // namespace facet::runtime
