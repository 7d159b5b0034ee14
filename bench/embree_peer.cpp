#include "bench/embree_peer.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "bench/measure.hpp"

namespace facet::bench {

namespace {

void check(RTCDevice device) {
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
    throw std::runtime_error("Embree refused a call");
}

RTCDevice device_with(unsigned threads) {
  RTCDevice device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
  check(device);
  return device;
}

/// A scene of one mesh; `build_seconds` leaves out the copying into Embree's buffers.
RTCScene built_scene(RTCDevice device, const mesh& m, embree_quality quality, bool robust,
                     double& build_seconds) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto copy = [&](RTCBufferType type, RTCFormat format, const auto& from,
                        std::size_t stride) {
    void* to =
        rtcSetNewGeometryBuffer(g, type, 0, format, stride, from.size() * sizeof(from[0]) / stride);
    check(device);
    std::memcpy(to, from.data(), from.size() * sizeof(from[0]));
  };
  copy(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, m.positions, 3 * sizeof(float));
  copy(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, m.indices, 3 * sizeof(std::uint32_t));
  const RTCBuildQuality asked =
      quality == embree_quality::low ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
  RTCScene scene = nullptr;
  build_seconds = seconds([&] {
    rtcSetGeometryBuildQuality(g, asked);
    rtcCommitGeometry(g);
    scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, asked);
    rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcAttachGeometry(scene, g);
    rtcCommitScene(scene);
  });
  rtcReleaseGeometry(g);
  check(device);
  return scene;
}

}  // namespace

struct embree_peer::state {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double build = 0;

  ~state() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

std::string embree_version() { return std::string("Embree ") + RTC_VERSION_STRING; }

embree_peer::embree_peer(const mesh& m, unsigned threads, bool robust)
    : state_(std::make_unique<state>()) {
  state_->device = device_with(threads);
  state_->scene = built_scene(state_->device, m, embree_quality::medium, robust, state_->build);
}

embree_peer::~embree_peer() = default;

double embree_peer::build_seconds() const { return state_->build; }

void embree_peer::closest(const std::vector<ray>& rays, std::vector<hit>& hits) const {
  trace_part(rays, false, 0, rays.size(), hits);
}

void embree_peer::trace(const std::vector<ray>& rays, bool any, unsigned threads,
                        std::vector<hit>& hits, embree_calls calls) const {
  constexpr std::size_t part = 4096;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t first; (first = next.fetch_add(part)) < rays.size();) {
      const std::size_t last = std::min(rays.size(), first + part);
      if (calls == embree_calls::packets)
        trace_packets(rays, any, first, last, hits);
      else
        trace_part(rays, any, first, last, hits);
    }
  };
  std::vector<std::thread> pool;
  for (unsigned k = 1; k < threads; ++k) pool.emplace_back(work);
  work();
  for (std::thread& t : pool) t.join();
}

void embree_peer::trace_part(const std::vector<ray>& rays, bool any, std::size_t first,
                             std::size_t last, std::vector<hit>& hits) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (std::size_t i = first; i < last; ++i) {
    const ray& r = rays[i];
    RTCRayHit x{};
    x.ray.org_x = r.origin.x, x.ray.org_y = r.origin.y, x.ray.org_z = r.origin.z;
    x.ray.dir_x = r.direction.x, x.ray.dir_y = r.direction.y, x.ray.dir_z = r.direction.z;
    x.ray.tnear = r.tmin, x.ray.tfar = r.tmax;
    x.ray.mask = ~0u;
    if (any) {
      rtcOccluded1(state_->scene, &context, &x.ray);
      hits[i] = x.ray.tfar < 0 ? hit{0, 0, 0, 0, 0} : hit{r.tmax};
      continue;
    }
    x.hit.geomID = x.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(state_->scene, &context, &x);
    const bool found = x.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    hits[i] = found ? hit{x.ray.tfar, x.hit.u, x.hit.v, 0, x.hit.primID} : hit{r.tmax};
  }
}

void embree_peer::trace_packets(const std::vector<ray>& rays, bool any, std::size_t first,
                                std::size_t last, std::vector<hit>& hits) const {
  constexpr std::size_t lanes = 16;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (std::size_t i = first; i < last; i += lanes) {
    alignas(64) RTCRayHit16 x;
    alignas(64) int valid[lanes];
    for (std::size_t k = 0; k < lanes; ++k) {
      valid[k] = i + k < last ? -1 : 0;
      const ray& r = rays[std::min(i + k, last - 1)];
      x.ray.org_x[k] = r.origin.x, x.ray.org_y[k] = r.origin.y, x.ray.org_z[k] = r.origin.z;
      x.ray.dir_x[k] = r.direction.x, x.ray.dir_y[k] = r.direction.y;
      x.ray.dir_z[k] = r.direction.z;
      x.ray.tnear[k] = r.tmin, x.ray.tfar[k] = r.tmax;
      x.ray.mask[k] = ~0u, x.ray.time[k] = 0, x.ray.flags[k] = 0;
      x.hit.geomID[k] = x.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    if (any)
      rtcOccluded16(valid, state_->scene, &context, &x.ray);
    else
      rtcIntersect16(valid, state_->scene, &context, &x);
    for (std::size_t k = 0; k < lanes && i + k < last; ++k) {
      const bool found = any ? x.ray.tfar[k] < 0 : x.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
      hits[i + k] = !found ? hit{rays[i + k].tmax}
                    : any  ? hit{0, 0, 0, 0, 0}
                           : hit{x.ray.tfar[k], x.hit.u[k], x.hit.v[k], 0, x.hit.primID[k]};
    }
  }
}

struct embree_builder::state {
  const mesh& of;
  RTCDevice device;

  ~state() { rtcReleaseDevice(device); }
};

embree_builder::embree_builder(const mesh& m, unsigned threads)
    : state_(new state{m, device_with(threads)}) {}

embree_builder::~embree_builder() = default;

double embree_builder::build(embree_quality q) {
  double taken = 0;
  rtcReleaseScene(built_scene(state_->device, state_->of, q, false, taken));
  return taken;
}

}  // namespace facet::bench
