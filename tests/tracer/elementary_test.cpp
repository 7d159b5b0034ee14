// exp, log and x^y of the kernels: the host's bits on every device, and how far from the truth.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/elementary_shim_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
namespace host = facet::test::elementary;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float least = std::numeric_limits<float>::denorm_min();

// The limits, in units in the last place of the exact result.
//
// exp: 1/2 for the last rounding. Before it, e^r is 1 + r, without error, and r^2 p(r), with r^2
// and p rounded: at r = -ln2/2 e^r is 0.707, its last place 2^-24, r^2 is 0.12, rounded to within
// 2^-28, and p is 0.45, rounded to within 2^-26. That leaves (0.45 2^-28 + 0.12 2^-26) / 2^-24 =
// 0.06; the product added to what 1 + r lost, 0.06 in all, is rounded to within 2^-29: 0.03. In sum
// 0.59, and below 0.01 for the polynomial (2^-33) and for roundings of what is below 2^-24.
constexpr double exp_limit = 0.6;
// log: 1/2, and 2^-35 of the result, whose last place is at least 2^-24 of it.
constexpr double log_limit = 0.5 + 0x1p-11;
// pow: as exp, and y ln(x), at most 104 where the result is not 0 nor infinite, to within 2^-35 of
// itself: 104 * 2^-35 / 2^-24 = 0.05.
constexpr double pow_limit = exp_limit + 0.05;

struct argument {
  float x, y;
};

/// NaN is one value, with whatever bits.
bool same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) ||
         (std::isnan(a) && std::isnan(b));
}

/// |found - exact| in units of the last place that a float of exact's size has. What rounds to
/// infinity must be it.
double ulps(float found, long double exact) {
  if (std::isnan(exact)) return std::isnan(found) ? 0 : infinity;
  const long double overflow = 0x1p128L - 0x1p103L;
  if (std::abs(exact) >= overflow)
    return found == (exact > 0 ? infinity : -infinity) ? 0 : infinity;
  const int exponent = exact == 0 ? -126 : std::max(std::ilogb(exact), -126);
  return double(std::abs((long double)found - exact) / std::ldexp(1.0L, exponent - 23));
}

std::vector<float> on_device(const std::string& call, const std::vector<argument>& in) {
  runtime::source_tree sources = tracer::kernel_sources();
  sources.files["elementary_test.cl"] =
      "#include \"elementary.h\"\n"
      "__kernel void evaluate(__global const float2* in, __global float* out, uint count) {\n"
      "  const uint i = (uint)get_global_id(0);\n"
      "  if (i >= count) return;\n"
      "  const float x = in[i].x, y = in[i].y;\n"
      "  out[i] = " +
      call + ";\n}\n";
  runtime::queue& q = test::queue();
  runtime::kernel kernel =
      tracer::compiled(q, sources, "elementary_test.cl", tracer::tuning_for(test::device()).flags())
          .get_kernel("evaluate");
  runtime::buffer<argument> arguments(in.data(), in.size());
  runtime::buffer<float> results(in.size());
  q.submit([&](runtime::handler& h) {
    h.set_args(runtime::accessor{arguments, h, runtime::read_only},
               runtime::accessor{results, h, runtime::write_only}, std::uint32_t(in.size()));
    h.parallel_for(tracer::padded(in.size(), 64), kernel);
  });
  const runtime::host_accessor read{results, runtime::read_only};
  return {read.begin(), read.end()};
}

/// Holds the device to the host's bits, and those to `exact` within `limit`; the largest error.
template <class OnHost, class Exact>
double check(const std::string& call, const std::vector<argument>& in, OnHost on_host, Exact exact,
             double limit) {
  const std::vector<float> found = on_device(call, in);
  std::size_t differing = 0;
  double worst = 0;
  argument at{};
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float expected = on_host(in[i]);
    differing += !same(found[i], expected);
    const double e = ulps(expected, exact(in[i]));
    if (e > worst) worst = e, at = in[i];
  }
  CAPTURE(call);
  CAPTURE(in.size());
  CAPTURE(at.x);
  CAPTURE(at.y);
  CHECK(differing == 0);
  CHECK(worst <= limit);
  return worst;
}

/// Every step-th float from `from` to `to`, of one sign, by its bits.
void add_range(std::vector<argument>& to_list, float from, float to, std::uint32_t step) {
  const auto first = std::bit_cast<std::uint32_t>(from), last = std::bit_cast<std::uint32_t>(to);
  for (std::uint32_t b = first; b <= last && b >= first; b += step)
    to_list.push_back({std::bit_cast<float>(b), 0});
}

/// x and the `count` floats on each side of it.
void add_around(std::vector<argument>& to_list, float x, int count) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  for (int k = -count; k <= count; ++k)
    to_list.push_back({std::bit_cast<float>(bits + std::uint32_t(k)), 0});
}

const std::vector<argument>& exp_arguments() {
  static const std::vector<argument> list = [] {
    std::vector<argument> l;
    add_range(l, 0.0f, 90.0f, 8191);
    add_range(l, -0.0f, -105.0f, 8191);
    add_range(l, -87.3f, -104.0f, 37);  // denormal results
    for (int k = -310; k <= 260; ++k)   // where the reduction changes, or leaves nothing
      add_around(l, float(k * 0.34657359027997264), 3);
    for (float x :
         {1.0f, -1.0f, least, -least, 89.0f, 88.722839f, -87.33655f, -103.97208f, -104.0f})
      add_around(l, x, 8);
    for (float x : {infinity, -infinity, not_a_number, 1e30f, -1e30f}) l.push_back({x, 0});
    l.push_back({0x1.8f8dep+1f, 0});  // the hardest of all
    return l;
  }();
  return list;
}

std::vector<argument> log_arguments() {
  std::vector<argument> l;
  add_range(l, least, std::numeric_limits<float>::max(), 16381);
  add_range(l, least, 1e-38f, 65521);
  add_around(l, 1.0f, 4096);
  for (int k = -148; k < 127; ++k) {
    add_around(l, std::ldexp(1.0f, k), 3);
    add_around(l, std::ldexp(1.41421356f, k), 3);
  }
  l.push_back({0x1.6d64bcp-1f, 0});  // the hardest of all
  for (float x : {0.0f, -0.0f, -1.0f, -least, infinity, -infinity, not_a_number})
    l.push_back({x, 0});
  return l;
}

/// Bases of shading, up to a little above 1, under exponents of highlights; then any.
const std::vector<argument>& pow_arguments() {
  static const std::vector<argument> list = [] {
    std::vector<argument> bases;
    add_range(bases, least, 1.0001f, 131071);
    add_range(bases, 0.5f, 1.0001f, 4093);
    add_around(bases, 1.0f, 64);
    std::vector<argument> l;
    for (float y : {0.0f, 0.5f, 1.0f, 2.0f, 5.0f, 10.0f, 32.0f, 100.5f, 1000.0f, 1e4f, 1e6f, 1e8f})
      for (const argument& a : bases) l.push_back({a.x, y});
    test::random r(5);
    for (int k = 0; k < 100'000; ++k) {  // x^y anywhere in float's range
      const float x = std::bit_cast<float>(1 + r.below(0x7f7fffff));
      l.push_back({x, r.between(-104, 89) / std::log(x)});
    }
    for (float x : {0.0f, -0.0f, least, 0.5f, 1.0f, 1.5f, 3e38f, infinity, not_a_number})
      for (float y : {0.0f, -0.0f, least, -least, 1.0f, -1.0f, 3e38f, -3e38f, infinity, -infinity,
                      not_a_number})
        l.push_back({x, y});
    l.push_back({0x1.e419f2p-1f, -0x1.c9f61p+7f});  // the hardest of 4 * 10^8
    return l;
  }();
  return list;
}

long double exact_exp(argument a) { return std::exp((long double)a.x); }
/// x^y as C has it; of a zero its sign does not count.
long double exact_pow(argument a) { return std::pow(std::abs((long double)a.x), (long double)a.y); }

}  // namespace

TEST_CASE("exp: the host's bits, within its limit") {
  const double worst = check(
      "exp_strict(x)", exp_arguments(), [](argument a) { return host::exp_strict(a.x); }, exact_exp,
      exp_limit);
  CHECK(worst > 0.598);  // the hardest of all floats is among the arguments
}

TEST_CASE("log: the host's bits, within its limit") {
  check(
      "log_strict(x)", log_arguments(), [](argument a) { return host::log_strict(a.x); },
      [](argument a) { return std::log((long double)a.x); }, log_limit);
}

TEST_CASE("pow: the host's bits, within its limit") {
  const double worst = check(
      "pow_strict(x, y)", pow_arguments(), [](argument a) { return host::pow_strict(a.x, a.y); },
      exact_pow, pow_limit);
  CHECK(worst > 0.602);
}

TEST_CASE("the limits refuse shorter ways") {
  double one_step = 0, rounded_twice = 0, plain_log = 0;
  for (const argument& a : exp_arguments()) {
    if (!(a.x > -103 && a.x < 88)) continue;
    const float n = std::nearbyint(a.x * 1.44269504f);
    const float r = std::fma(n, -0.693147181f, a.x);
    // ln2 as one float: what n times the rest of it changes is lost.
    one_step = std::max(one_step, ulps(std::ldexp(host::exp_strict(r), int(n)), exact_exp(a)));
    // The full reduction, and a denormal result rounded once to 24 bits and once to its own.
    const float e = host::exp_of({r, n * 1.90465421e-9f});
    rounded_twice = std::max(rounded_twice, ulps(std::ldexp(e, int(n)), exact_exp(a)));
  }
  for (const argument& a : pow_arguments())
    if (a.x > 0 && std::isfinite(a.x) && a.y > 0 && std::isfinite(a.y))
      plain_log =
          std::max(plain_log, ulps(host::exp_strict(a.y * host::log_strict(a.x)), exact_pow(a)));
  CHECK(one_step > 2 * exp_limit);
  CHECK(rounded_twice > 1.2 * exp_limit);
  CHECK(plain_log > 20 * pow_limit);
}
