// The functions that shading is made of, asked one by one: device_scene::surfaces and passages.
#include <limits>

#include "tracer/launch.hpp"
#include "tracer/state.hpp"

namespace facet::tracer {
namespace {

vec3f vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

runtime::buffer<Ray> upload(std::span<const ray> rays) {
  if (rays.size() >= std::numeric_limits<std::uint32_t>::max())
    throw runtime::exception(
        runtime::errc::invalid,
        std::to_string(rays.size()) + " rays in one call; at most 2^32 - 2 are allowed");
  return {reinterpret_cast<const Ray*>(rays.data()), rays.size()};
}

surface_point unpacked(const SurfacePoint& p, bool with_instances) {
  if (p.triangle == miss)
    return {
        {p.t, 0, 0, miss, miss}, false, miss, {}, {}, {}, 0, {}, {}, false, false, {}, {}, {}, {}};
  return {{p.t, p.u, p.v, with_instances ? p.instance : 0, p.triangle},
          p.is_front != 0,
          p.material,
          vec(p.p),
          vec(p.geometric),
          vec(p.shading),
          p.delta,
          vec(p.near_side),
          vec(p.far_side),
          (p.children & 1) != 0,
          (p.children & 2) != 0,
          vec(p.reflected),
          vec(p.reflected_weight),
          vec(p.refracted),
          vec(p.refracted_weight)};
}

}  // namespace

std::vector<surface_point> device_scene::surfaces(std::span<const ray> rays) {
  state& s = *state_;
  std::vector<surface_point> points;
  if (rays.empty()) return points;
  runtime::kernel kernel = s.probe_kernel("probe_surfaces");
  runtime::buffer<Ray> in = upload(rays);
  runtime::buffer<SurfacePoint> out(rays.size());
  s.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = s.set_normals(h, s.set_geometry(h));
    h.set_arg(k++, runtime::accessor{in, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{out, h, runtime::write_only});
    h.set_arg(k++, std::uint32_t(rays.size()));
    h.parallel_for(padded(rays.size(), s.tuned.group), kernel);
  });
  points.reserve(rays.size());
  const runtime::host_accessor found{out, runtime::read_only};
  for (std::size_t i = 0; i < rays.size(); ++i)
    points.push_back(unpacked(found[i], s.used.instances));
  return points;
}

std::vector<passage> device_scene::passages(std::span<const ray> rays, std::uint32_t medium) {
  state& s = *state_;
  std::vector<passage> passed;
  if (rays.empty()) return passed;
  runtime::kernel kernel = s.probe_kernel("probe_passages");
  runtime::buffer<Ray> in = upload(rays);
  runtime::buffer<Passage> out(rays.size());
  s.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = s.set_geometry(h);
    h.set_arg(k++, runtime::accessor{in, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{out, h, runtime::write_only});
    h.set_arg(k++, medium);
    h.set_arg(k++, std::uint32_t(rays.size()));
    h.parallel_for(padded(rays.size(), s.tuned.group), kernel);
  });
  passed.reserve(rays.size());
  const runtime::host_accessor found{out, runtime::read_only};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Passage& p = found[i];
    passed.push_back({vec(p.transmittance), p.is_dark != 0, p.entries, p.exits});
  }
  return passed;
}

}  // namespace facet::tracer
