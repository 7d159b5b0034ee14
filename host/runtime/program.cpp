#include "runtime/program.hpp"

#include <chrono>

#include "runtime/program_state.hpp"

namespace facet::runtime {
namespace {

using detail::call;

/// What the compilers said, each under its device's name if there are several.
std::string build_log(const cl::Program& p, const std::vector<device>& devices) {
  std::string all;
  for (const device& d : devices) {
    std::string log;
    p.getBuildInfo(cl::Device(d.get(), true), CL_PROGRAM_BUILD_LOG, &log);
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n' || log.back() == ' '))
      log.pop_back();
    if (log.empty()) continue;
    if (devices.size() > 1) all += d.name() + ":\n";
    all += log + "\n";
  }
  return all;
}

}  // namespace

program::program(const context& c, const source_tree& sources, const std::string& main_file,
                 const std::string& options) {
  const auto start = std::chrono::steady_clock::now();
  auto state = std::make_shared<detail::program_state>();
  state->context = c.state();
  state->options = options + (options.empty() ? "" : " ") + "-cl-kernel-arg-info";
  const std::string text = expand(sources, main_file);
  state->program = call([&] { return cl::Program(c.state()->context, text); });
  const cl_int result =
      clBuildProgram(state->program(), 0, nullptr, state->options.c_str(), nullptr, nullptr);
  state->log = with_places(build_log(state->program, c.get_devices()), text);
  if (result != CL_SUCCESS) {
    const exception failed = failed_call(
        "clBuildProgram", result,
        "file '" + main_file + "', options '" + state->options + "', build log:\n" + state->log);
    throw exception(failed.code() == errc::memory_allocation ? failed.code() : errc::build,
                    failed.what(), result);
  }
  state->build_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  state_ = std::move(state);
}

std::vector<std::string> program::kernel_names() const {
  const std::string list = call([&] { return state_->program.getInfo<CL_PROGRAM_KERNEL_NAMES>(); });
  std::vector<std::string> names;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(';', at), list.size());
    if (end > at) names.push_back(list.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

kernel program::get_kernel(std::string_view name) const {
  std::string there;
  for (const std::string& k : kernel_names()) {
    if (k == name) return kernel(detail::make_kernel(state_, k));
    there += (there.empty() ? "" : ", ") + k;
  }
  throw exception(errc::kernel, "no kernel '" + std::string(name) + "' in the program, which has " +
                                    (there.empty() ? "none" : there));
}

double program::build_ms() const noexcept { return state_->build_ms; }
const std::string& program::options() const noexcept { return state_->options; }
const std::string& program::log() const noexcept { return state_->log; }
native::program program::get() const noexcept { return state_->program(); }

}  // namespace facet::runtime
