// One OpenCL driver on this machine (SYCL 2020, section 4.6.2).
#pragma once

#include <string>
#include <vector>

#include "runtime/native.hpp"

namespace facet::runtime {

class device;

class platform {
 public:
  explicit platform(native::platform handle) : handle_(handle) {}

  /// All platforms that the ICD loader finds; none is no error.
  static std::vector<platform> get_platforms();

  /// All devices of this platform; none is no error.
  std::vector<device> get_devices() const;

  std::string name() const;
  std::string vendor() const;
  std::string version() const;

  native::platform get() const noexcept { return handle_; }
  friend bool operator==(const platform&, const platform&) = default;

 private:
  native::platform handle_;
};

}  // namespace facet::runtime
