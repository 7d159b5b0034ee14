// Where a result comes from: what a file of measurements must say of itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/device.hpp"

namespace facet::study {

struct device_facts {
  std::string name, platform, driver;
  std::string opencl;  ///< "OpenCL 3.0 ..."
  std::string type;    ///< "cpu", "gpu", "accelerator" or "other"
  std::uint32_t compute_units = 0;
  std::uint32_t max_clock_mhz = 0;  ///< as the driver reports it: not what it runs at
  std::uint64_t timer_ns = 0;       ///< a tick of the clock that times kernels
};
device_facts facts_of(const runtime::device& d);

/// The CPU's model from the system, or "unknown".
std::string cpu_name();

/// Facet's own version, "0.1.0".
std::string version();

/// The commit that this was built from, with "-modified" after it if files differed from it; or
/// "unknown" outside a git repository.
const char* commit();

/// Now, in UTC: "2026-01-31T23:59:59Z".
std::string date();

/// All of this, of a result that is measured now.
struct origin {
  std::string date, version, commit;
  std::string cpu;                     ///< that the host, and with it the references, run on
  std::optional<device_facts> device;  ///< none where no OpenCL device takes part
};
origin origin_now(const runtime::device& d);
origin origin_now();

}  // namespace facet::study
