// A search through trees of eight children a node for a packet of rays (packet.h), until few of them are
// left in a node: those go on alone. Without instances.
//
// Rays visit more than each would by itself, which changes no hit (box.h); nothing is left out that one of
// them must visit.
#ifndef FACET_SEARCH_PACKET_H
#define FACET_SEARCH_PACKET_H

#ifndef FACET_NO_INSTANCES
#error "packets are for scenes without instances"
#endif

#include "packet.h"
#include "search_wide.h"

// So many rays go on alone from a node.
#define FEW_RAYS 2u
// A ray alone is tested with the eight triangles of a block in about the time that eight rays are tested
// with four of them.
#define TESTS_OF_RAY 4u

// The lanes whose rays meet a node's child before their best hits, as box.h has it.
static inline uint rays_that_meet(const PacketPart* p, const Beam* b, __global const float* faces) {
  const Rays* r = &p->rays;
  const Real nx = fma(in_all(faces[b->x.side]), r->inverse.x, r->near_offset.x);
  const Real fx = fma(in_all(faces[FACET_SIDE - b->x.side]), r->inverse.x, r->far_offset.x);
  const Real ny = fma(in_all(faces[2u * FACET_SIDE + b->y.side]), r->inverse.y, r->near_offset.y);
  const Real fy = fma(in_all(faces[3u * FACET_SIDE - b->y.side]), r->inverse.y, r->far_offset.y);
  const Real nz = fma(in_all(faces[4u * FACET_SIDE + b->z.side]), r->inverse.z, r->near_offset.z);
  const Real fz = fma(in_all(faces[5u * FACET_SIDE - b->z.side]), r->inverse.z, r->far_offset.z);
  const Real near = larger_each(nz, larger_each(ny, larger_each(nx, p->tmin)));
  const Real far = smaller_each(fz, smaller_each(fy, smaller_each(fx, p->t)));
  return lanes_of(near <= far);
}

// The children of a node that some ray may meet.
static inline uint children_in_beam(const Beam* b, __global const float* faces, float best, Each* near) {
  Each nx, fx, ny, fy, nz, fz, far;
  read_sides(faces, b->x.side, &nx, &fx);
  read_sides(faces + 2u * FACET_SIDE, b->y.side, &ny, &fy);
  read_sides(faces + 4u * FACET_SIDE, b->z.side, &nz, &fz);
  beam_intervals(b, nx, fx, ny, fy, nz, fz, best, near, &far);
  return lanes_of(*near <= far);
}

// The triangles of a block that some ray may meet, by their boxes, to which t is held (triangle.h).
static inline uint triangles_in_beam(const Beam* b, Triangles block, float best) {
  Points lo, hi;
  bounds_of(block, &lo, &hi);
  const bool x = b->x.side == 0u, y = b->y.side == 0u, z = b->z.side == 0u;
  Each near, far;
  beam_intervals(b, x ? lo.x : hi.x, x ? hi.x : lo.x, y ? lo.y : hi.y, y ? hi.y : lo.y, z ? lo.z : hi.z,
                 z ? hi.z : lo.z, best, &near, &far);
  return lanes_of(near <= far);
}

// Of the lanes in `tied`, which meet a triangle at their best hit's distance, those that keep their best hit.
SELDOM Mask keep_of(const Scene* s, uint8 best, uint slot, uint tied) {
  uint slots[FACET_LANES];
  int keep[FACET_LANES] = {0};
  vstore8(best, 0, slots);
  for (; tied != 0u; tied = without_first(tied)) {
    const uint lane = first_lane(tied);
    keep[lane] = slots[lane] == FACET_NONE || is_before(s, 0u, slot, 0u, slots[lane]) ? 0 : -1;
  }
  return vload8(0, keep);
}

static inline void meet_one(const Scene* s, PacketPart* p, Triangles one, uint slot, uint mode) {
  const Interval outer = {-INFINITY, INFINITY};
  TriangleHits hits;
  Mask met = hit_triangles(&p->rays, one, outer, p->tmin, p->t, false, false, &hits);
  if (is_none(met)) return;
  if (mode == FACET_ANY) {
    p->t = met ? in_all(-INFINITY) : p->t;
    p->slot = met ? (uint8)(slot) : p->slot;
    return;
  }
  const uint tied = lanes_of(met & (hits.t == p->t));
  if (tied != 0u) met &= ~keep_of(s, p->slot, slot, tied);
  p->t = met ? hits.t : p->t;
  p->v = met ? hits.v : p->v;
  p->w = met ? hits.w : p->w;
  p->det = met ? hits.det : p->det;
  p->slot = met ? (uint8)(slot) : p->slot;
}

// One ray's search from a node on.
SELDOM void search_alone(const Scene* s, GEOMETRY positions, uint node, PacketPart* p, uint lane,
                                uint mode) {
  float *t = (float*)&p->t, *det = (float*)&p->det;
  uint* slot = (uint*)&p->slot;
  Space space = space_in_lane(&p->rays, lane);
  Query q;
  q.t = t[lane];
  q.place = 0u;
  q.slot = slot[lane];
  q.triangle = FACET_NONE;
  // No instances: the ray in the world is not asked for.
  search_from(s, positions, node, space.o, space.o, stored_lane(&p->tmin, lane), mode, &space, &q);
  if (mode == FACET_ANY) {
    if (q.triangle == FACET_NONE) return;
    t[lane] = -INFINITY;
    slot[lane] = 0u;
  } else if (q.slot != slot[lane]) {
    t[lane] = q.t;
    slot[lane] = q.slot;
    det[lane] = 0.0f;
  }
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

// A node leaves at most seven children waiting once its nearest is taken, and all eight until then: one entry
// more than what search_wide.h needs.
static inline void search_packet(const Scene* s, GEOMETRY positions, const Beam* b, uint mode,
                                 PacketPart* part) {
  ulong stack[FACET_STACK + 1];
  int top = 0;
  uint node = s->root;
  float best = best_of(part);
  for (;;) {
    Each near;
    const uint lanes = children_in_beam(b, s->nodes[node].x[0], best, &near);
    push_in_order(s, positions, node, lanes, near, stack, &top);
    for (;;) {
      if (top == 0) return;
      const ulong entry = stack[--top];
      if (near_of(entry) > best) continue;
      __global const WideNode* parent = s->nodes + (uint)entry / 8u;
      const uint lane = (uint)entry % 8u, child = parent->child[lane];
      uint rays = 0u, parts = 0u;
      for (uint k = 0u; k < FACET_PARTS; ++k) {
        const uint some = rays_that_meet(&part[k], b, parent->x[0] + lane);
        rays |= some << FACET_LANES * k;
        parts += some != 0u;
      }
      if (rays == 0u) continue;
      const bool is_leaf = child & FACET_LEAF_BIT;
      const uint block = FACET_LEAF_FIRST(child);
      const Triangles triangles = triangles_from(positions, block);
      uint left = is_leaf ? triangles_in_beam(b, triangles, best) : 0u;
      if (popcount(rays) <= (is_leaf ? popcount(left) * parts / TESTS_OF_RAY : FEW_RAYS)) {
        for (; rays != 0u; rays = without_first(rays)) {
          const uint ray = first_lane(rays);
          search_alone(s, positions, child, &part[ray / FACET_LANES], ray % FACET_LANES, mode);
        }
      } else if (is_leaf) {
        for (; left != 0u; left = without_first(left)) {
          const uint at = first_lane(left);
          for (uint k = 0u; k < FACET_PARTS; ++k)
            if (rays >> FACET_LANES * k & 0xffu)
              meet_one(s, &part[k], one_triangle(triangles, at), FACET_LANES * block + at, mode);
        }
      } else {
        node = child;
        break;
      }
      best = best_of(part);
      if (best == -INFINITY) return;
    }
  }
}

#endif
