#include "study/cases/lab.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "study/parallel.hpp"

namespace facet::study {
namespace {

std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Failures from several threads: how many, and the smallest of their numbers.
class tally {
 public:
  explicit tally(finding& to) : to_(to) {}

  void add(std::vector<std::uint64_t> failures) {
    if (failures.empty()) return;
    const std::lock_guard lock(mutex_);
    std::vector<std::uint64_t> all(
        to_.first.begin(),
        to_.first.begin() + std::ptrdiff_t(std::min<std::uint64_t>(to_.failed, to_.first.size())));
    to_.failed += failures.size();
    all.insert(all.end(), failures.begin(), failures.end());
    const std::size_t kept = std::min(all.size(), to_.first.size());
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(kept), all.end());
    std::copy_n(all.begin(), kept, to_.first.begin());
  }

 private:
  finding& to_;
  std::mutex mutex_;
};

/// Rays a launch: enough to fill a GPU, few enough to be held several times over.
std::uint64_t batch_size(const runtime::queue& q) {
  return q.get_device().is_gpu() ? 1u << 22 : 1u << 18;
}

}  // namespace

bool finding::is_met() const {
  if (!is_goal) return true;
  return failed == 0 && (!measured || !limit || *measured <= *limit);
}

std::uint64_t finding::failures() const { return failed != 0 ? failed : is_met() ? 0 : 1; }

tracer::device_scene lab::place(const scene& s) const { return place(s, options); }

tracer::device_scene lab::place(const scene& s, tracer::options o) const {
  return {queue, s, wrong ? with(*wrong, std::move(o)) : std::move(o)};
}

void lab::report_figure(std::string what, double measured, double limit, std::string unit) {
  finding f;
  f.what = std::move(what);
  f.measured = measured;
  f.limit = limit;
  f.unit = std::move(unit);
  f.failed = measured <= limit ? 0 : 1;
  report(std::move(f));
}

void lab::note_figure(std::string what, double measured, std::string unit) {
  finding f;
  f.what = std::move(what);
  f.measured = measured;
  f.unit = std::move(unit);
  f.is_goal = false;
  report(std::move(f));
}

void in_parallel(const lab& l, std::uint64_t count,
                 const std::function<void(std::uint64_t, std::uint64_t)>& body) {
  in_parallel(l.threads, count, body);
}

void in_batches(const lab& l, std::uint64_t count,
                const std::function<void(std::uint64_t, std::uint64_t)>& body) {
  const std::uint64_t batch = batch_size(l.queue);
  for (std::uint64_t first = 0; first < count; first += batch) {
    if (l.on_batch) l.on_batch();
    body(first, std::min(batch, count - first));
  }
}

finding trace_and_check(lab& l, tracer::device_scene& on, const std::string& what,
                        std::uint64_t count, const ray_maker& make, const hit_check& check) {
  finding f;
  f.what = what;
  f.tried = count;
  tally failures(f);
  in_batches(l, count, [&](std::uint64_t first, std::uint64_t size) {
    std::vector<tracer::ray> rays(size);
    in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
      for (std::uint64_t i = a; i < b; ++i) rays[i] = make(first + i);
    });
    const std::vector<tracer::hit> hits = on.trace(rays);
    in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
      std::vector<std::uint64_t> bad;
      for (std::uint64_t i = a; i < b; ++i)
        if (!check(first + i, rays[i], hits[i])) bad.push_back(first + i);
      failures.add(std::move(bad));
    });
  });
  l.report(f);
  return f;
}

finding count_failures(lab& l, const std::string& what, std::uint64_t count,
                       const std::function<bool(std::uint64_t)>& check) {
  finding f;
  f.what = what;
  f.tried = count;
  tally failures(f);
  in_parallel(l, count, [&](std::uint64_t a, std::uint64_t b) {
    std::vector<std::uint64_t> bad;
    for (std::uint64_t i = a; i < b; ++i)
      if (!check(i)) bad.push_back(i);
    failures.add(std::move(bad));
  });
  if (l.on_batch) l.on_batch();
  l.report(f);
  return f;
}

draw::draw(std::uint64_t seed, std::uint64_t index)
    : state_(mix(seed + 0x9e3779b97f4a7c15u) ^ mix(index + 0xd1b54a32d192ed03u)) {}

std::uint64_t draw::bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }

vec3d draw::direction() {
  const double z = signed_uniform(), angle = 2 * std::numbers::pi * uniform();
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

tracer::ray make_ray(vec3f o, vec3f d, float tmin, float tmax) {
  return {{o.x, o.y, o.z}, tmin, {d.x, d.y, d.z}, tmax};
}
vec3f origin_of(const tracer::ray& r) { return {r.origin[0], r.origin[1], r.origin[2]}; }
vec3f direction_of(const tracer::ray& r) {
  return {r.direction[0], r.direction[1], r.direction[2]};
}

}  // namespace facet::study
