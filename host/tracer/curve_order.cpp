#include "tracer/curve_order.hpp"

#include <utility>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {

template <class Primitive>
curve_order<Primitive>::curve_order(const runtime::queue& q, const runtime::source_tree& kernels,
                                    const tuning& t)
    : queue_(q), kernels_(kernels), tuning_(t), few_(t.ordered_at_once()) {
  prepare(few_ > 0 ? 1 : 0);
}

template <class Primitive>
void curve_order<Primitive>::prepare(std::uint32_t count) {
  const bool is_few = count > 0 && count <= few_;
  if (is_few && !at_once_) {
    const runtime::program p = compiled(queue_, kernels_, serial_file, tuning_.flags());
    at_once_.emplace(at_once{p, p.get_kernel("order_few")});
  }
  if (!is_few && !in_steps_)
    in_steps_.emplace(in_steps{morton<Primitive>(queue_, kernels_, tuning_),
                               radix_sort<std::uint32_t>(queue_, kernels_, tuning_),
                               subtrees(queue_, kernels_, tuning_)});
}

template <class Primitive>
std::uint32_t curve_order<Primitive>::make(runtime::buffer<Primitive>& primitives,
                                           std::uint32_t count, runtime::buffer<Curve>& curve,
                                           runtime::buffer<std::uint32_t>& codes,
                                           runtime::buffer<std::uint32_t>& order,
                                           std::vector<step>& steps) {
  prepare(count);
  if (count <= few_) return make_at_once(primitives, count, curve, codes, order, steps);
  in_steps& by = *in_steps_;
  by.curve.codes(primitives, curve, codes, count, steps);
  for (step& s : by.sort.sort_order(codes, order, count)) steps.push_back(std::move(s));
  starts_ = &by.cut.starts();
  return by.cut.list(codes, count, steps);
}

template <class Primitive>
std::uint32_t curve_order<Primitive>::make_at_once(runtime::buffer<Primitive>& primitives,
                                                   std::uint32_t count,
                                                   runtime::buffer<Curve>& curve,
                                                   runtime::buffer<std::uint32_t>& codes,
                                                   runtime::buffer<std::uint32_t>& order,
                                                   std::vector<step>& steps) {
  at_once& by = *at_once_;
  for (auto& records : by.records) hold(records, count);
  hold(by.starts, std::size_t(count) + 1);
  steps.push_back({"order_few", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor in{primitives, h, runtime::read_only};
                     const runtime::accessor along{curve, h, runtime::read_write};
                     const runtime::accessor out{codes, h, runtime::read_write};
                     const runtime::accessor out_order{order, h, runtime::write_only};
                     const runtime::accessor records{by.records[0], h, runtime::write_only};
                     const runtime::accessor others{by.records[1], h, runtime::write_only};
                     const runtime::accessor starts{by.starts, h, runtime::write_only};
                     const runtime::accessor total{by.total, h, runtime::write_only};
                     h.set_args(in, primitive_rows<Primitive>, along, out, out_order, records,
                                others, starts, total, count);
                     h.single_task(by.kernel);
                   })});
  starts_ = &by.starts;
  const runtime::host_accessor total{by.total, runtime::read_only};
  return total[0];
}

template <class Primitive>
void curve_order<Primitive>::add_programs(program_set& to) const {
  if (at_once_) to.add(at_once_->program);
  if (!in_steps_) return;
  in_steps_->curve.add_programs(to);
  in_steps_->sort.add_programs(to);
  in_steps_->cut.add_programs(to);
}

template class curve_order<texel>;
template class curve_order<Box>;

}  // namespace facet::tracer
