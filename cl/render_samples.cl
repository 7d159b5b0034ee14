// A tile of a picture, one sample of a pixel a work-item: where they are many more than run at once, and a launch ends
// with its longest, a pixel's samples one after the other would end last. For the same reason work-groups go first
// that are likely to take long: from glass two rays go on, and near its silhouettes they stay within it for longest.
//
// Neighbours among all samples are neighbours in a work-group.
#include "eye.h"
#include "group_sum.h"
#include "states.h"

// So many rays are followed to see whether a sample comes to glass, at once or by mirrors.
#define RAYS_AHEAD 2u

static inline bool comes_to_glass(const Scene* s, GEOMETRY positions, GEOMETRY normals, __global const View* view,
                                  float3 direction) {
  PendingRay none[1];
  Path p = path_of(view, direction);
  for (uint k = 0u; k < RAYS_AHEAD; ++k) {
    const Query q = traverse(s, positions, p.ray.origin, p.ray.direction, 0.0f, INFINITY, FACET_CLOSEST);
    if (q.triangle == FACET_NONE) return false;
    const Surface f = surface_at(s, positions, normals, &q, p.ray.direction);
    __global const Material* m = &s->materials[f.material];
    if (m->transparent) return true;
    if (branch(s, &f, m, &p.ray, none, &p.count, view->max_depth) == RESUME) return false;
  }
  return false;
}

// A work-item for each corner of the work-groups of render_samples, which are `across` * `down`. If the sample there
// comes to glass, bits of marks[], 0 before, are set for those that meet at the corner. Faults go to `untold`: they are
// of rays that will be traced again.
__kernel void mark_groups(__global const World* world, __global const SceneNode* nodes,
                          __global const Instance* instances, __global const TriangleInfo* infos,
                          __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                          GEOMETRY normals, __global const Light* lights, __global const View* view,
                          volatile __global uint* marks, __global Faults* untold, uint left, uint top,
                          uint group_width, uint group_height, uint across, uint down) {
  const uint column = (uint)get_global_id(0) % (across + 1u), row = (uint)get_global_id(0) / (across + 1u);
  if (row > down) return;
  Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  s.faults = untold;
  const uint n = view->samples, x = column * group_width, y = row * group_height;
  const float3 direction = eye_direction(view, left + x / n, top + y / n, x % n, y % n);
  if (!comes_to_glass(&s, positions, normals, view, direction)) return;
  for (uint i = 0u; i < 4u; ++i) {
    const uint gx = column - (i & 1u), gy = row - (i >> 1), group = gy * across + gx;
    if (gx < across && gy < down) atomic_or(&marks[group / 32u], 1u << group % 32u);  // also 0 - 1
  }
}

// groups[]: those that are marked, then the others, both in order. A work-item for each; the group's size is a
// multiple of 32.
__kernel void list_groups(__global const uint* marks, __global uint* groups, uint count, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0);
  const uint own = (uint)get_global_id(0), first = (own - lid) / 32u;
  uint before = 0u, after = 0u;
  for (uint i = lid; i < first; i += size) before += popcount(marks[i]);
  for (uint i = first + lid; i < (count + 31u) / 32u; i += size) after += popcount(marks[i]);
  sum_before(before, sums);
  before = sums[size - 1u];
  barrier(CLK_LOCAL_MEM_FENCE);
  sum_before(after, sums);
  const uint all = before + sums[size - 1u];
  if (own >= count) return;
  for (uint i = first; i < own / 32u; ++i) before += popcount(marks[i]);
  const uint word = marks[own / 32u];
  before += popcount(word & ((1u << own % 32u) - 1u));
  groups[(word >> own % 32u & 1u) != 0u ? before : all + own - before] = own;
}

// Sample (x, y) of the tile's grid of samples is at samples[y * its columns + x], or if a pixel has but one, in the
// picture.
__kernel void render_samples(__global const World* world, __global const SceneNode* nodes,
                             __global const Instance* instances, __global const TriangleInfo* infos,
                             __global const Material* materials, __global Faults* faults,
                             GEOMETRY positions, GEOMETRY normals, __global const Light* lights,
                             __global const View* view, __global float4* samples, __global const uint* groups,
                             uint is_listed, uint left, uint top, uint right, uint bottom) {
  const uint across = (uint)get_num_groups(0);
  uint group = (uint)get_group_id(1) * across + (uint)get_group_id(0);
  if (is_listed != 0u) group = groups[group];
  const uint x = group % across * (uint)get_local_size(0) + (uint)get_local_id(0);
  const uint y = group / across * (uint)get_local_size(1) + (uint)get_local_id(1);
  const uint n = view->samples, columns = n * (right - left);
  if (x >= columns || y >= n * (bottom - top)) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const float3 direction = eye_direction(view, left + x / n, top + y / n, x % n, y % n);
  const float4 sample = radiance(&s, positions, normals, lights, view, direction);
  if (n == 1u)
    samples[(size_t)(top + y) * view->width + left + x] = sample;
  else
    samples[(size_t)y * columns + x] = sample;
}

// The mean of each pixel's, in the order of render.cl.
__kernel void mean_samples(__global const View* view, __global const float4* samples, __global float4* pixels,
                           uint left, uint top, uint right, uint bottom) {
  const uint x = (uint)get_global_id(0), y = (uint)get_global_id(1);
  if (x >= right - left || y >= bottom - top) return;
  const uint n = view->samples, columns = n * (right - left);
  float4 sum = (float4)(0.0f);
  for (uint j = 0u; j < n; ++j)
    for (uint i = 0u; i < n; ++i) sum = sum + samples[(size_t)(n * y + j) * columns + n * x + i];
  pixels[(size_t)(top + y) * view->width + left + x] = sum / (float)(n * n);
}
