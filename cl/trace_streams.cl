// Rays from a buffer, hits to a buffer, for one mesh that is placed by the identity: those together that stay close
// (search_packet.h), and of the others up to FACET_STREAM as a stream (search_stream.h).
#include "search_stream.h"
#include "trace_packet.h"

// Takes up those of a packet's rays that do not go together; traces what a stream does not take, too.
static inline void take_up(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint first, uint which,
                           uint mode, __global Hit* hits, __global uint* hit_instances, __global Stream* x,
                           uint* count) {
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    const uint of_part = which >> FACET_LANES * k & (1u << FACET_LANES) - 1u, from = first + FACET_LANES * k;
    if (of_part == 0u) continue;
    PacketPart part;
    read_part(rays + from, &part);
    const uint left = add_rays(x, count, part.o, part.d, part.tmin, part.t, s->reach, of_part, from);
    if (left != 0u) trace_alone(s, positions, rays + from, left, mode, hits + from, hit_instances + from);
  }
}

static inline Hit found_in_stream(const Scene* s, __global const StreamRay* ray, __global const StreamRest* rest,
                                  uint mode) {
  Hit h;
  h.t = ray->t;
  h.u = h.v = 0.0f;
  h.triangle = FACET_NONE;
  if (ray->slot == FACET_NONE) return h;
  if (mode == FACET_ANY) {
    h.t = 0.0f;
    h.triangle = 0u;
    return h;
  }
  h.u = rest->v / rest->det;
  h.v = rest->w / rest->det;
  h.triangle = s->infos[ray->slot].triangle;
  return h;
}

// The rays of a stream, each by itself.
APART void trace_each(const Scene* s, GEOMETRY positions, __global const Ray* rays, __global const Stream* x,
                      uint count, uint mode, __global Hit* hits, __global uint* hit_instances) {
  for (uint i = 0u; i < count; ++i) {
    const uint from = x->rest[i].from;
    trace_alone(s, positions, rays + from, 1u, mode, hits + from, hit_instances + from);
  }
}

// At most FACET_STREAM rays.
static inline void trace_chunk(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint count, uint mode,
                               __global Hit* hits, __global uint* hit_instances, __global Stream* x) {
  uint taken = 0u;
  for (uint first = 0u; first < count; first += FACET_PACKET) {
    if (count - first < FACET_PACKET || s->triangle_count == 0u) {
      trace_alone(s, positions, rays + first, WHOLE_PACKET >> (FACET_PACKET - min(count - first, FACET_PACKET)), mode,
                  hits + first, hit_instances + first);
      continue;
    }
    const uint left = trace_packet(s, positions, rays + first, mode, hits + first, hit_instances + first);
    if (left != 0u) take_up(s, positions, rays, first, left, mode, hits, hit_instances, x, &taken);
  }
  if (!search_stream(s, positions, x, taken, mode))
    return trace_each(s, positions, rays, x, taken, mode, hits, hit_instances);
  for (uint i = 0u; i < taken; ++i)
    hits[x->rest[i].from] = found_in_stream(s, &x->ray[i], &x->rest[i], mode);
}

// Work-items take `each` rays, at most FACET_STREAM and a multiple of FACET_PACKET, from the counter `next`, until there
// are none: each has a stream to itself.
static inline void trace_all(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint count, uint mode,
                             __global Hit* hits, __global uint* hit_instances, __global Stream* streams,
                             __global uint* next, uint each) {
  for (;;) {
    const ulong first = (ulong)each * atomic_inc((volatile __global uint*)next);
    if (first >= count) return;
    trace_chunk(s, positions, rays + first, (uint)min((ulong)each, count - first), mode, hits + first,
                hit_instances + first, streams + get_global_id(0));
  }
}

__kernel void trace_closest(__global const World* world, __global const SceneNode* nodes,
                            __global const Instance* instances, __global const TriangleInfo* infos,
                            __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                            __global const Ray* rays, __global Hit* hits, __global uint* hit_instances, uint count,
                            __global Stream* streams, __global uint* next, uint each) {
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_all(&s, positions, rays, count, FACET_CLOSEST, hits, hit_instances, streams, next, each);
}

__kernel void trace_any(__global const World* world, __global const SceneNode* nodes,
                        __global const Instance* instances, __global const TriangleInfo* infos,
                        __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                        __global const Ray* rays, __global Hit* hits, __global uint* hit_instances, uint count,
                        __global Stream* streams, __global uint* next, uint each) {
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_all(&s, positions, rays, count, FACET_ANY, hits, hit_instances, streams, next, each);
}
