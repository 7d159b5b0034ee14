#include "tracer/morton.hpp"

#include <algorithm>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t codes_group = 256;
constexpr std::uint32_t bounds_words = 6;  // of local memory a work-item (cl/morton.cl)

}  // namespace

template <class Primitive>
morton<Primitive>::morton(const runtime::queue& q, const runtime::source_tree& kernels,
                          const tuning& t)
    : queue_(q),
      is_alone_(t.orders_alone()),
      group_(t.bounds_group),
      most_groups_(t.bounds_groups),
      partial_(most_groups_),
      program_(is_alone_
                   ? compiled(q, kernels, order_file, t.flags())
                   : compiled(q, kernels, "morton.cl", t.flags() + primitive_options<Primitive>())),
      partial_bounds_(program_.get_kernel("partial_bounds")),
      total_bounds_(program_.get_kernel("total_bounds")),
      codes_(program_.get_kernel("morton_codes")) {}

template <class Primitive>
void morton<Primitive>::codes(runtime::buffer<Primitive>& primitives, runtime::buffer<Curve>& curve,
                              runtime::buffer<std::uint32_t>& codes, std::uint32_t count,
                              std::vector<step>& steps) {
  const std::uint32_t most = std::min(most_groups_, (count + group_ - 1) / group_);
  const std::uint32_t share = (count + most - 1) / most, groups = (count + share - 1) / share;
  steps.push_back({"partial_bounds", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor in{primitives, h, runtime::read_only};
                     const runtime::accessor out{partial_, h, runtime::write_only};
                     const runtime::local_accessor<float> pool(bounds_words * group_, h);
                     if (is_alone_)
                       h.set_args(in, primitive_rows<Primitive>, out, count, share, pool);
                     else
                       h.set_args(in, out, count, share, pool);
                     h.parallel_for(in_groups(groups, group_), partial_bounds_);
                   })});
  steps.push_back({"total_bounds", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor in{partial_, h, runtime::read_only};
                     const runtime::accessor out{curve, h, runtime::write_only};
                     const runtime::local_accessor<float> pool(bounds_words * group_, h);
                     h.set_args(in, out, groups, pool);
                     h.parallel_for(in_groups(1, group_), total_bounds_);
                   })});
  steps.push_back({"morton_codes", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor in{primitives, h, runtime::read_only};
                     const runtime::accessor along{curve, h, runtime::read_only};
                     const runtime::accessor out{codes, h, runtime::write_only};
                     if (is_alone_)
                       h.set_args(in, primitive_rows<Primitive>, along, out, count);
                     else
                       h.set_args(in, along, out, count);
                     h.parallel_for(padded(count, codes_group), codes_);
                   })});
}

template class morton<texel>;
template class morton<Box>;

}  // namespace facet::tracer
