// A tile of a picture, one sample of each pixel at a time, by several kernels (ray_tree.h):
//
//   eye_rays                  depth 0, a ray a pixel
//   for each depth
//     trace_rays              what rays of it meet
//     shade_rays              the surfaces, and the rays that follow
//   light_rays                what a light adds to all of them, for each light
//   sum_samples               each pixel's tree, in the order of states.h
//
// Shading by itself waits for memory, and traversal for work-items that are many: together they would need
// registers that keep work-items few.
//
// A launch ends with its longest ray, while most of the device waits: so a light's rays of all depths are one.
//
// Pixels are taken in blocks of 8 by 4, so that a warp's rays go the same way.
#include "eye.h"
#include "ray_tree.h"
#include "states.h"

#define COLUMNS FACET_PACKET_COLUMNS

// The pixel of ray i, in a tile that is so many blocks wide.
static inline uint2 pixel_of(uint i, uint left, uint top, uint across) {
  const uint block = i / FACET_PACKET, k = i % FACET_PACKET;
  return (uint2)(left + COLUMNS * (block % across) + k % COLUMNS,
                 top + FACET_PACKET_ROWS * (block / across) + k / COLUMNS);
}

// A pixel beyond the tile has no ray: its direction is 0.
__kernel void eye_rays(__global const View* view, __global float4* origins, __global float4* directions,
                       __global float4* throughputs, __global uint* media, __global RayNode* tree, uint left,
                       uint top, uint right, uint bottom, uint sample, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint2 at = pixel_of(i, left, top, (right - left + COLUMNS - 1u) / COLUMNS);
  const bool is_there = at.x < right && at.y < bottom;
  const uint n = view->samples;
  const float3 direction =
      is_there ? eye_direction(view, at.x, at.y, sample % n, sample / n) : (float3)(0.0f);
  const RayLists rays = ray_lists(origins, directions, throughputs, media);
  put_ray(&rays, i, vec_global(view->origin), direction, (float3)(1.0f), media_of(view->media));
}

// Rays first to first + count: those that miss are done; of the others hits, and what they belong to, are listed.
// `counts` are those of the sample so far: of hits, of rays that follow some, and of the hits before each light.
__kernel void trace_rays(__global const World* world, __global const SceneNode* nodes,
                         __global const Instance* instances, __global const TriangleInfo* infos,
                         __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                         __global const View* view, __global const float4* origins,
                         __global const float4* directions, __global RayNode* tree, __global float4* hits,
                         __global uint2* hit_rays,
                         volatile __global uint* counts, uint depth, uint first, uint count) {
  __local uint pool[2];
  const uint i = first + (uint)get_global_id(0);
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const float3 d = i < first + count ? directions[i].xyz : (float3)(0.0f);
  bool is_met = false;
  Query q;
  if (!is_black(d)) {
    q = traverse(&s, positions, origins[i].xyz, d, 0.0f, INFINITY, FACET_CLOSEST);
    is_met = q.triangle != FACET_NONE;
    if (!is_met)
      tree[i] = ray_node(vec_global(view->background), depth == 0u ? view->background_alpha : 1.0f);
  }
  const uint at = appended(is_met ? 1u : 0u, pool, &counts[0]);
  if (!is_met) return;
  hits[at] = (float4)(q.t, q.u, q.v, as_float(q.slot));
  hit_rays[at] = (uint2)(i, q.place);
}

// A surface in memory: three vectors, each with one thing more.
static inline void put_surface(__global float4* surfaces, uint k, const Surface* f) {
  surfaces[3u * k] = (float4)(f->p, f->delta);
  surfaces[3u * k + 1u] = (float4)(f->geometric, as_float(f->material));
  surfaces[3u * k + 2u] = (float4)(f->shading, f->is_front ? 1.0f : 0.0f);
}

static inline Surface surface_in(__global const float4* surfaces, uint k) {
  const float4 p = surfaces[3u * k], geometric = surfaces[3u * k + 1u], shading = surfaces[3u * k + 2u];
  Surface f;
  f.p = p.xyz;
  f.delta = p.w;
  f.geometric = geometric.xyz;
  f.material = as_uint(geometric.w);
  f.shading = shading.xyz;
  f.is_front = shading.w != 0.0f;
  return f;
}

// Hits of one depth: from first_hit on. Rays that follow go behind the eye rays; beyond `capacity` they are counted,
// and not written.
__kernel void shade_rays(__global const World* world, __global const SceneNode* nodes,
                         __global const Instance* instances, __global const TriangleInfo* infos,
                         __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                         GEOMETRY normals, __global const Light* lights, __global const View* view,
                         __global float4* origins, __global float4* directions, __global float4* throughputs,
                         __global uint* media, __global RayNode* tree, __global const float4* hits,
                         __global const uint2* hit_rays, __global float4* surfaces, __global uint* lit_hits,
                         volatile __global uint* counts, uint depth, uint first_hit, uint eyes,
                         uint capacity) {
  __local uint pool[2];
  const uint k = first_hit + (uint)get_global_id(0);
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const RayLists rays = ray_lists(origins, directions, throughputs, media);
  PendingRay followed, other[1];
  Surface f;
  uint followers = 0u, others = 0u, i = 0u;
  const bool is_there = k < counts[0];
  if (is_there) {
    const uint2 of = hit_rays[k];
    const float4 hit = hits[k];
    Query q;
    q.t = hit.x, q.u = hit.y, q.v = hit.z;
    q.slot = as_uint(hit.w);
    q.place = of.y;
    i = of.x;
    followed.direction = directions[i].xyz;
    followed.throughput = throughputs[i].xyz;
    followed.depth = depth;
    followed.media = media_at(&rays, i);
    f = arrive(&s, positions, normals, &q, &followed);
    put_surface(surfaces, k, &f);
    throughputs[i] = (float4)(followed.throughput, 0.0f);
    if (branch(&s, &f, &materials[f.material], &followed, other, &others, view->max_depth) == TRACE)
      followers = 1u;
  }
  // A group's reflected rays lie together, and so do its refracted ones.
  volatile __global uint* length = &counts[1];
  const uint first = eyes + appended(followers, pool, length);
  const uint second = eyes + appended(others, pool, length);
  for (uint l = 0u; l < view->light_count; ++l) {
    Lighting to;
    const bool is_lit = is_there && stands_before(&lights[l], &f, &to);
    const uint at = appended(is_lit ? 1u : 0u, pool, &counts[2u + l]);
    if (is_lit) lit_hits[(size_t)capacity * l + at] = k;
  }
  if (!is_there) return;
  RayNode node = ray_node(unlit(view, &materials[f.material]), 1.0f);
  if (followers > 0u && first < capacity) {
    node.first = first;
    put_ray(&rays, first, followed.origin, followed.direction, followed.throughput, followed.media);
  }
  if (others > 0u && second < capacity) {
    node.second = second;
    put_ray(&rays, second, other[0].origin, other[0].direction, other[0].throughput, other[0].media);
  }
  tree[i] = node;
}

// Hits that one light stands before.
__kernel void light_rays(__global const World* world, __global const SceneNode* nodes,
                         __global const Instance* instances, __global const TriangleInfo* infos,
                         __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                         __global const Light* lights, __global float4* origins, __global float4* directions,
                         __global float4* throughputs, __global uint* media, __global RayNode* tree,
                         __global const uint2* hit_rays, __global const float4* surfaces,
                         __global const uint* lit_hits, __global const uint* counts, uint l, uint capacity) {
  if (get_global_id(0) >= counts[2u + l]) return;
  const uint k = lit_hits[(size_t)capacity * l + get_global_id(0)], i = hit_rays[k].x;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const RayLists rays = ray_lists(origins, directions, throughputs, media);
  const Surface f = surface_in(surfaces, k);
  const float3 lit = lit_from(&s, positions, &lights[l], &f, &materials[f.material], directions[i].xyz,
                              media_at(&rays, i));
  const float3 light = vec_global(tree[i].light) + lit;
  tree[i].light[0] = light.x;
  tree[i].light[1] = light.y;
  tree[i].light[2] = light.z;
}

// Adds a sample to each pixel, and divides by their number at the last.
__kernel void sum_samples(__global const View* view, __global const float4* throughputs,
                          __global const RayNode* tree, __global float4* pixels,
                          uint left, uint top, uint right, uint bottom, uint sample, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint2 at = pixel_of(i, left, top, (right - left + COLUMNS - 1u) / COLUMNS);
  if (at.x >= right || at.y >= bottom) return;
  uint waiting[FACET_RAY_STACK], top_of = 0u;
  float3 light = (float3)(0.0f);
  for (uint k = i;;) {
    const RayNode node = tree[k];
    light = light + throughputs[k].xyz * vec(node.light);
    if (node.second != FACET_NONE) waiting[top_of++] = node.second;
    if (node.first != FACET_NONE)
      k = node.first;
    else if (top_of > 0u)
      k = waiting[--top_of];
    else
      break;
  }
  const size_t pixel = (size_t)at.y * view->width + at.x;
  const uint last = view->samples * view->samples - 1u;
  const float4 sum = (sample == 0u ? (float4)(0.0f) : pixels[pixel]) + (float4)(light, tree[i].alpha);
  pixels[pixel] = sample == last ? sum / (float)(last + 1u) : sum;
}
