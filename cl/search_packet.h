// A search through trees of eight children a node for a packet of rays (packet.h), until few of them are
// left in a node: those go on alone.
//
// Rays visit more than each would by itself, which changes no hit (box.h); nothing is left out that one of
// them must visit.
#ifndef FACET_SEARCH_PACKET_H
#define FACET_SEARCH_PACKET_H

#include "packet_hits.h"
#include "traverse.h"

// So many rays go on alone from a node.
#define FEW_RAYS 2u
// A ray alone is tested with the eight triangles of a block in about the time that eight rays are tested
// with four of them.
#define TESTS_OF_RAY 4u

// The lanes whose rays meet a node's child before their best hits, as box.h has it.
static inline uint rays_that_meet(const PacketPart* p, const Rays* r, const Beam* b,
                                  __global const float* faces) {
  const Real nx = fma(in_all(faces[b->side[0]]), r->inverse.x, r->near_offset.x);
  const Real fx = fma(in_all(faces[FACET_SIDE - b->side[0]]), r->inverse.x, r->far_offset.x);
  const Real ny = fma(in_all(faces[2u * FACET_SIDE + b->side[1]]), r->inverse.y, r->near_offset.y);
  const Real fy = fma(in_all(faces[3u * FACET_SIDE - b->side[1]]), r->inverse.y, r->far_offset.y);
  const Real nz = fma(in_all(faces[4u * FACET_SIDE + b->side[2]]), r->inverse.z, r->near_offset.z);
  const Real fz = fma(in_all(faces[5u * FACET_SIDE - b->side[2]]), r->inverse.z, r->far_offset.z);
  const Real near = larger_each(nz, larger_each(ny, larger_each(nx, p->tmin)));
  const Real far = smaller_each(fz, smaller_each(fy, smaller_each(fx, p->t)));
  return lanes_of(near <= far);
}

// The children of a node that some ray may meet.
static inline uint children_in_beam(const Beam* b, __global const float* faces, float best, Each* near) {
  Each nx, fx, ny, fy, nz, fz, far;
  read_sides(faces, b->side[0], &nx, &fx);
  read_sides(faces + 2u * FACET_SIDE, b->side[1], &ny, &fy);
  read_sides(faces + 4u * FACET_SIDE, b->side[2], &nz, &fz);
  beam_intervals(b, nx, fx, ny, fy, nz, fz, best, near, &far);
  return lanes_of(*near <= far);
}

// The triangles of a block that some ray may meet, by their boxes, to which t is held (triangle.h).
static inline uint triangles_in_beam(const Beam* b, Triangles block, float best) {
  Points lo, hi;
  bounds_of(block, &lo, &hi);
  const bool x = b->side[0] == 0u, y = b->side[1] == 0u, z = b->side[2] == 0u;
  Each near, far;
  beam_intervals(b, x ? lo.x : hi.x, x ? hi.x : lo.x, y ? lo.y : hi.y, y ? hi.y : lo.y, z ? lo.z : hi.z,
                 z ? hi.z : lo.z, best, &near, &far);
  return lanes_of(near <= far);
}

// One ray's search from a node on.
APART void search_alone(const Scene* s, GEOMETRY positions, uint node, const PacketSpace* in, uint part,
                        PacketPart* p, uint lane, uint mode) {
  float *t = (float*)&p->t, *det = (float*)&p->det;
  uint* slot = (uint*)&p->slot;
  Space space = space_in_lane(&in->rays[part], axis_in_lane(in, part, lane), lane);
  Interval outer = {-INFINITY, INFINITY};
#ifndef FACET_NO_INSTANCES
  if (in->place != FACET_NONE) {
    outer.near = stored_lane(&in->outer[part].near, lane);
    outer.far = stored_lane(&in->outer[part].far, lane);
  }
#endif
  Query q = found_in_lane(p, lane);
#ifndef FACET_NO_TRANSPARENCY
  if (mode == FACET_CROSSINGS) {
    q.t_end = stored_lane(&p->t_end, lane);
    for (int c = 0; c < 3; ++c) q.depth[c] = p->depth[lane][c];
  }
#endif
  search_from(s, positions, node, in->place, outer, point_in_lane(&p->o, lane), point_in_lane(&p->d, lane),
              stored_lane(&p->tmin, lane), mode, &space, &q);
  if (mode == FACET_CLOSEST) {
    if (q.slot == slot[lane] && q.place == place_in_lane(p, lane)) return;
    t[lane] = q.t;
    slot[lane] = q.slot;
    det[lane] = 0.0f;
#ifndef FACET_NO_INSTANCES
    ((uint*)&p->place)[lane] = q.place;
#endif
    return;
  }
#ifndef FACET_NO_TRANSPARENCY
  if (mode == FACET_CROSSINGS)
    for (int c = 0; c < 3; ++c) p->depth[lane][c] = q.depth[c];
#endif
  if (q.triangle == FACET_NONE) return;
  t[lane] = -INFINITY;
  slot[lane] = 0u;
}

// Puts the children in `lanes` on the stack, the nearest last, each as node and lane: which rays meet it is asked
// when it is taken, for their best hits may then be nearer.
static inline void push_in_order(const Scene* s, GEOMETRY positions, uint node, uint lanes, Each near,
                                 ulong* stack, int* top) {
  float at[8];
  vstore8(near, 0, at);
  const int base = *top;
  for (; lanes != 0u; lanes = without_first(lanes)) {
    const uint lane = first_lane(lanes);
    fetch_child(s, positions, s->nodes[node].child[lane]);
    const ulong next = (ulong)as_uint(at[lane]) << 32 | (8u * node + lane);
    int k = (*top)++;
    for (; k > base && stack[k - 1] < next; --k) stack[k] = stack[k - 1];
    stack[k] = next;
  }
}

static inline void all_alone(const Scene* s, GEOMETRY positions, uint node, const PacketSpace* space,
                             PacketPart* part, uint rays, uint mode) {
  for (; rays != 0u; rays = without_first(rays)) {
    const uint k = first_lane(rays) / FACET_LANES, lane = first_lane(rays) % FACET_LANES;
    search_alone(s, positions, node, space, k, &part[k], lane, mode);
  }
}

// The triangles of a leaf; `rays` meet its box.
static inline void meet_block(const Scene* s, GEOMETRY positions, uint leaf, const PacketSpace* space,
                              PacketPart* part, uint rays, float best, uint mode) {
  const uint block = FACET_LEAF_FIRST(leaf);
  const uint left = triangles_in_beam(&space->beam, triangles_from(positions, block), best);
  uint parts = 0u;
  for (uint k = 0u; k < FACET_PARTS; ++k) parts += (rays >> FACET_LANES * k & 0xffu) != 0u;
  if (popcount(rays) <= popcount(left) * parts / TESTS_OF_RAY)
    return all_alone(s, positions, leaf, space, part, rays, mode);
  if (space->others != 0u) return meet_mixed(s, positions, block, left, space, part, rays, mode);
  meet_each(s, positions, block, left, space, part, rays, mode, false);
}

// Takes from the stack the next child that rays meet, lane k of part j being bit FACET_LANES * j + k; false if
// there is none.
static inline bool next_child(const Scene* s, const PacketPart* part, PacketSpace* world, PacketSpace** space,
                              float best, const ulong* stack, int* top, uint* child, uint* rays) {
  while (*top > 0) {
    const ulong entry = stack[--*top];
    if (entry == FACET_INSTANCE_ENDS) {
      *space = world;
      continue;
    }
    if (near_of(entry) > best) continue;
    __global const WideNode* parent = s->nodes + (uint)entry / 8u;
    const uint lane = (uint)entry % 8u;
    uint some = 0u;
    for (uint k = 0u; k < FACET_PARTS; ++k)
      some |= rays_that_meet(&part[k], &(*space)->rays[k], &(*space)->beam, parent->x[0] + lane)
              << FACET_LANES * k;
    if (some == 0u) continue;
    *rays = some;
    *child = parent->child[lane];
    return true;
  }
  return false;
}

// Of the packet's rays those in `rays`, which have anything to look for.
//
// A node leaves at most seven children waiting once its nearest is taken, and all eight until then: one entry
// more than what search_wide.h needs.
static inline void search_packet(const Scene* s, GEOMETRY positions, PacketSpace* world, uint rays, uint mode,
                                 PacketPart* part) {
  ulong stack[FACET_STACK + 1];
  int top = 0;
  uint child = s->root;
  float best = best_of(part);
  PacketSpace* space = world;
#ifdef FACET_NO_INSTANCES
  const bool is_in_tree = true;
#else
  bool is_in_tree = false;
  PacketSpace inner;
#endif
  for (;;) {
    const bool is_leaf = child & FACET_LEAF_BIT, are_few = popcount(rays) <= FEW_RAYS;
    if (!is_leaf && !are_few) {
      Each near;
      const uint lanes = children_in_beam(&space->beam, s->nodes[child].x[0], best, &near);
      push_in_order(s, positions, child, lanes, near, stack, &top);
    } else {
#ifndef FACET_NO_INSTANCES
      if (!is_in_tree && !are_few &&
          packet_in_instance(s, FACET_LEAF_FIRST(child), part, world, &inner)) {
        stack[top++] = FACET_INSTANCE_ENDS;
        space = &inner;
        is_in_tree = true;
        child = s->instances[inner.place].root;
        continue;
      }
#endif
      if (is_leaf && is_in_tree)
        meet_block(s, positions, child, space, part, rays, best, mode);
      else
        all_alone(s, positions, child, space, part, rays, mode);
      best = best_of(part);
      if (best == -INFINITY) return;
    }
    if (!next_child(s, part, world, &space, best, stack, &top, &child, &rays)) return;
#ifndef FACET_NO_INSTANCES
    is_in_tree = space != world;
#endif
  }
}

// The hit that a ray has met, its shares computed anew.
static inline Query met_by(const Scene* s, GEOMETRY positions, const PacketPart* part, const PacketSpace* world,
                           uint ray) {
  const uint k = ray / FACET_LANES, lane = ray % FACET_LANES;
  const PacketPart* p = &part[k];
  Query q = found_in_lane(p, lane);
  Space space = space_in_lane(&world->rays[k], axis_in_lane(world, k, lane), lane);
  finish(s, positions, point_in_lane(&p->o, lane), point_in_lane(&p->d, lane), &space, &q);
  return q;
}

#endif
