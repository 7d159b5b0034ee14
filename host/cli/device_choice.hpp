// Which OpenCL device a command runs on.
#pragma once

#include <stdexcept>
#include <string>

#include "cli/console.hpp"
#include "runtime/device.hpp"

namespace facet::cli {

/// There is no device to run on (exit code 4).
class device_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Says which package provides a device, and offers the serial tracer.
[[noreturn]] void no_device();

/// `text` as --device takes it; empty is the first GPU, or else the first device. Of several that
/// match it is the first, said with -v. Throws device_error if there is none at all, and
/// runtime::exception with the list of devices if none matches.
runtime::device choose_device(const std::string& text, const console& out);

}  // namespace facet::cli
