#include <algorithm>

#include "runtime/program.hpp"
#include "runtime/program_state.hpp"

namespace facet::runtime {
namespace detail {
namespace {

using std::string;

parameter::space space_of(cl_kernel_arg_address_qualifier q) {
  switch (q) {
    case CL_KERNEL_ARG_ADDRESS_GLOBAL:
      return parameter::space::global;
    case CL_KERNEL_ARG_ADDRESS_CONSTANT:
      return parameter::space::constant;
    case CL_KERNEL_ARG_ADDRESS_LOCAL:
      return parameter::space::local;
    default:
      return parameter::space::value;
  }
}

const char* word_of(parameter::space s) {
  switch (s) {
    case parameter::space::global:
      return "__global ";
    case parameter::space::constant:
      return "__constant ";
    case parameter::space::local:
      return "__local ";
    default:
      return "";
  }
}

/// Drivers count the final 0 in, or not.
string text(string s) {
  while (!s.empty() && s.back() == '\0') s.pop_back();
  return s;
}

parameter ask_parameter(const cl::Kernel& k, cl_uint i) {
  parameter p;
  p.where = space_of(k.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(i));
  const string type = text(k.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i));
  const auto access = k.getArgInfo<CL_KERNEL_ARG_ACCESS_QUALIFIER>(i);
  const auto qualifiers = k.getArgInfo<CL_KERNEL_ARG_TYPE_QUALIFIER>(i);
  p.is_image = type.starts_with("image");
  string front = word_of(p.where);
  if (p.is_image) {
    p.read_by_kernel = access != CL_KERNEL_ARG_ACCESS_WRITE_ONLY;
    p.written_by_kernel =
        access == CL_KERNEL_ARG_ACCESS_WRITE_ONLY || access == CL_KERNEL_ARG_ACCESS_READ_WRITE;
    front = !p.written_by_kernel ? "read_only " : p.read_by_kernel ? "read_write " : "write_only ";
  } else if (p.where == parameter::space::constant || (qualifiers & CL_KERNEL_ARG_TYPE_CONST)) {
    p.written_by_kernel = false;
    if (p.where == parameter::space::global) front += "const ";
  }
  p.text = front + type + " " + text(k.getArgInfo<CL_KERNEL_ARG_NAME>(i));
  return p;
}

/// Without argument info (a driver that keeps none) parameters stay unknown and unchecked.
std::vector<parameter> ask_parameters(const cl::Kernel& k) {
  std::vector<parameter> list(k.getInfo<CL_KERNEL_NUM_ARGS>());
  try {
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = ask_parameter(k, cl_uint(i));
  } catch (const cl::Error& e) {
    if (e.err() != CL_KERNEL_ARG_INFO_NOT_AVAILABLE) throw;
    std::fill(list.begin(), list.end(), parameter{});
  }
  return list;
}

kernel_limits ask_limits(const cl::Kernel& k, const device& on) {
  const cl::Device d(on.get(), true);
  kernel_limits l;
  l.most_items = on.max_work_item_sizes();
  l.work_group_size = k.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(d);
  l.preferred_multiple = k.getWorkGroupInfo<CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE>(d);
  const auto required = k.getWorkGroupInfo<CL_KERNEL_COMPILE_WORK_GROUP_SIZE>(d);
  for (unsigned i = 0; i < 3; ++i) l.required[i] = required[i];
  l.private_bytes = k.getWorkGroupInfo<CL_KERNEL_PRIVATE_MEM_SIZE>(d);
  l.local_bytes = k.getWorkGroupInfo<CL_KERNEL_LOCAL_MEM_SIZE>(d);
  return l;
}

}  // namespace

const kernel_limits& kernel_state::limits_on(const device& d) const {
  const auto found = limits.find(d.get());
  if (found == limits.end())
    throw exception(errc::invalid, "kernel '" + name + "' was not built for " + d.name() +
                                       ": its program is of another context");
  return found->second;
}

std::shared_ptr<kernel_state> make_kernel(std::shared_ptr<const program_state> program,
                                          const string& name) {
  auto state = std::make_shared<kernel_state>();
  state->name = name;
  state->what =
      std::make_shared<const string>("kernel '" + name + "', options '" + program->options + "'");
  call(
      [&] {
        state->kernel = cl::Kernel(program->program, name.c_str());
        state->parameters = ask_parameters(state->kernel);
        for (const device& d : program->context->devices)
          state->limits[d.get()] = ask_limits(state->kernel, d);
      },
      *state->what);
  state->program = std::move(program);
  return state;
}

}  // namespace detail

std::string kernel::name() const { return state_->name; }
std::uint32_t kernel::num_args() const { return std::uint32_t(state_->parameters.size()); }

std::size_t kernel::work_group_size(const device& d) const {
  return state_->limits_on(d).work_group_size;
}
std::size_t kernel::preferred_work_group_size_multiple(const device& d) const {
  return state_->limits_on(d).preferred_multiple;
}
std::uint64_t kernel::private_mem_size(const device& d) const {
  return state_->limits_on(d).private_bytes;
}
std::uint64_t kernel::local_mem_size(const device& d) const {
  return state_->limits_on(d).local_bytes;
}
native::kernel kernel::get() const noexcept { return state_->kernel(); }

}  // namespace facet::runtime
