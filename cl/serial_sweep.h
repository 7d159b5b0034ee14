// What cl/sweep.h does with a group of work-items, done by one alone: a tree over up to 32 boxes, by the
// surface area heuristic over all splits of all axes. The same boxes give the same tree: costs, ties and
// the order of choices are those of sweep.h.
//
// A set of boxes is a word: a bit for each of them, and for each axis a bit for each place that they have along it.
// Where a set is split, no list moves.
#ifndef FACET_SERIAL_SWEEP_H
#define FACET_SERIAL_SWEEP_H

#include "ordered.h"
#include "packed.h"

#define SWEEP_MOST FACET_SWEEP_MOST

// Up to 32 boxes. Of equal centres along an axis the box that comes first is the lower one.
typedef struct {
  Packed box[32];
  uint centre[3][32];  // doubled, and ordered; ORDERED_MOST where there is no box
  uint weight[32];
} Entries;

static inline void begin_entries(Entries* e) {
  for (uint axis = 0u; axis < 3u; ++axis)
    for (uint k = 0u; k < 4u; ++k) vstore8((uint8)(ORDERED_MOST), k, e->centre[axis]);
}

static inline void put_entry(Entries* e, uint i, Bounds b, uint weight) {
  const float3 c = centre2(b) + 0.0f;  // of two zeros one
  e->box[i] = packed(b);
  e->centre[0][i] = ordered(c.x), e->centre[1][i] = ordered(c.y), e->centre[2][i] = ordered(c.z);
  e->weight[i] = weight;
}

// Along each axis the place of each entry, and the entry at each place.
typedef struct {
  uchar place[3][32], entry[3][32];
} Orders;

// An entry's place is how many are below it: eight entries are compared with one at a time. Those before the eight
// are also below them where they are equal.
static inline void order_along(const uint* centre, uint count, uchar* place, uchar* entry) {
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  for (uint first = 0u; first < count; first += 8u) {
    const uint8 own = vload8(0, centre + first);
    int8 at = (int8)(0);  // less the place
    for (uint i = 0u; i < first; ++i) at += (uint8)(centre[i]) <= own;
    for (uint i = 0u; i < 8u; ++i) {
      const uint8 c = (uint8)(centre[first + i]);
      at += (c < own) | ((c == own) & ((int8)((int)i) < lane));
    }
    for (uint i = first + 8u; i < count; ++i) at += (uint8)(centre[i]) < own;
    int places[8];
    vstore8(-at, 0, places);
    for (uint i = 0u; i < 8u && first + i < count; ++i) {
      place[first + i] = (uchar)places[i];
      entry[places[i]] = (uchar)(first + i);
    }
  }
}

// A node's entries, and their places along each axis.
typedef struct {
  uint entries, places[3];
  uint link, depth;  // of the node above: 2 * node + side; nodes above
  float area;
} Segment;

// When a subtree becomes a leaf (bounds.h: LEAF_SURE, LEAF_MOST, and of LEAF_BLOCK the bit): known when it is built, so
// that one program has trees of any rule.
typedef struct {
  uint sure, most, block_bit;
} LeafRule;

// As tests_of (bounds.h), of integers: PoCL makes a call of ceil.
static inline float4 rounded_tests(uint4 weight, uint block_bit) {
  return convert_float4(as_int4((weight + ((1u << block_bit) - 1u)) >> block_bit));
}

// The entries at the first places go left, so many.
typedef struct {
  float cost;
  uint axis, left;
  Packed left_box, right_box;
} SerialSplit;

// Along an axis, of the entries at the first i + 1 places the box and what they count, and the box of those from
// place i on.
typedef struct {
  Packed left[32], right[33];
  uint weight[32];
} Splits;

static inline void list_splits(const Entries* e, const uchar* entry, uint places, uint count, Splits* s) {
  // No infinite box: a variant's compiler may take it that there is none.
  Packed left = e->box[entry[first_lane(places)]], right = e->box[entry[31u - clz(places)]];
  uint weight = 0u, from_left = places, from_right = places;
  for (uint i = 0u; i < count; ++i) {
    const uint l = entry[first_lane(from_left)], last = 31u - clz(from_right), r = entry[last];
    from_left = without_first(from_left);
    from_right ^= 1u << last;
    s->left[i] = left = joined_packed(e->box[l], left);
    s->weight[i] = weight += e->weight[l];
    s->right[count - 1u - i] = right = joined_packed(e->box[r], right);
  }
}

// Of two boxes the sides, less than 0.
static inline float8 two_sides(Packed a, Packed b) { return (float8)(a.lo + a.hi, b.lo + b.hi); }

// What splits 4 k to 4 k + 3 cost, as packed_cost has it, of `count`; split i has i + 1 entries on the left.
static inline float4 costs_of(const Splits* s, uint k, uint count, uint block_bit) {
  const Packed *l = s->left + 4u * k, *r = s->right + 4u * k + 1u;
  const float8 a = two_sides(l[0], r[0]), b = two_sides(l[1], r[1]), c = two_sides(l[2], r[2]),
               d = two_sides(l[3], r[3]);
  // Four boxes on the left, and four on the right.
  const float8 xy0 = (float8)(a.s0, b.s0, a.s1, b.s1, a.s4, b.s4, a.s5, b.s5),
               xy1 = (float8)(c.s0, d.s0, c.s1, d.s1, c.s4, d.s4, c.s5, d.s5),
               z0 = (float8)(a.s2, b.s2, a.s3, b.s3, a.s6, b.s6, a.s7, b.s7),
               z1 = (float8)(c.s2, d.s2, c.s3, d.s3, c.s6, d.s6, c.s7, d.s7);
  const float8 x = (float8)(xy0.s01, xy1.s01, xy0.s45, xy1.s45), y = (float8)(xy0.s23, xy1.s23, xy0.s67, xy1.s67),
               z = (float8)(z0.s01, z1.s01, z0.s45, z1.s45);
  const float8 areas = (x * y + y * z) + z * x;
  const uint4 left = vload4(k, s->weight);
  const float4 cost = areas.lo * rounded_tests(left, block_bit) +
                      areas.hi * rounded_tests(s->weight[count] - left, block_bit);
  const int4 is_split = (uint4)(4u * k) + (uint4)(0, 1, 2, 3) < (uint4)(count);
  return (is_split & (cost < INFINITY)) ? cost : (float4)(INFINITY);
}

static inline SerialSplit best_serial_split(const Entries* e, const Orders* o, const Segment* of, uint block_bit) {
  SerialSplit best;
  const uint count = popcount(of->entries) - 1u;
  for (uint axis = 0u; axis < 3u; ++axis) {
    Splits s;
    list_splits(e, o->entry[axis], of->places[axis], count + 1u, &s);
    float8 cost[4], least = (float8)(INFINITY);
    for (uint k = 0u; 8u * k < count; ++k) {
      cost[k] = (float8)(costs_of(&s, 2u * k, count, block_bit), costs_of(&s, 2u * k + 1u, count, block_bit));
      least = cost[k] < least ? cost[k] : least;
    }
    const float4 four = least.lo < least.hi ? least.lo : least.hi;
    const float2 two = four.lo < four.hi ? four.lo : four.hi;
    const float found = two.x < two.y ? two.x : two.y;
    if (axis > 0u && !(found < best.cost)) continue;
    uint at = 0u;
    for (uint k = 0u; 8u * k < count; ++k) {
      const uint lanes = lanes_of(cost[k] == (float8)(found)) & ((1u << min(count - 8u * k, 8u)) - 1u);
      if (lanes == 0u) continue;
      at = 8u * k + first_lane(lanes);
      break;
    }
    best.cost = found;
    best.axis = axis;
    best.left = at + 1u;
    best.left_box = s.left[at];
    best.right_box = s.right[at + 1u];
  }
  return best;
}

// Parts a segment's entries; `right` may be the segment itself. (Sets are written one by one: vectors that are copied
// from what was just written in parts would wait for it.)
static inline void part_segment(const Orders* o, const Segment* s, uint axis, uint count, Segment* left,
                                Segment* right) {
  uint entries = 0u, x = 0u, y = 0u, z = 0u;
  for (uint some = deposit((1u << count) - 1u, s->places[axis]); some != 0u; some = without_first(some)) {
    const uint i = o->entry[axis][first_lane(some)];
    entries |= 1u << i;
    x |= 1u << o->place[0][i], y |= 1u << o->place[1][i], z |= 1u << o->place[2][i];
  }
  right->entries = s->entries & ~entries;
  right->places[0] = s->places[0] & ~x, right->places[1] = s->places[1] & ~y, right->places[2] = s->places[2] & ~z;
  left->entries = entries;
  left->places[0] = x, left->places[1] = y, left->places[2] = z;
}

// The tree over entries 0 .. count - 1, its nodes numbered from `base` on; leaf i, from the left, is leaves[i].
// Returns the nodes; *leaf_count.
APART uint serial_sweep(const Entries* e, uint count, LeafRule rule, uint base, Node* nodes, Segment* leaves,
                        uint* leaf_count) {
  Orders orders;
  for (uint axis = 0u; axis < 3u && count > rule.sure; ++axis)
    order_along(e->centre[axis], count, orders.place[axis], orders.entry[axis]);
  // The last one is the next; a node's right side takes its place.
  Segment stack[33];
  uint top = 1u, made = 0u, found = 0u;
  Packed all = e->box[0];
  for (uint i = 1u; i < count; ++i) all = joined_packed(e->box[i], all);
  stack->entries = stack->places[0] = stack->places[1] = stack->places[2] = 0xffffffffu >> (32u - count);
  stack->link = FACET_NONE, stack->depth = 0u;
  stack->area = packed_area(all);
  while (top > 0u) {
    Segment* s = &stack[top - 1u];
    const uint size = popcount(s->entries);
    bool is_leaf = size <= rule.sure;
    SerialSplit split;
    if (!is_leaf) {
      split = best_serial_split(e, &orders, s, rule.block_bit);
      if (size <= rule.most) is_leaf = !(s->area * (float)(size - 1u) > split.cost);
    }
    if (is_leaf) {
      leaves[found].entries = s->entries, leaves[found].link = s->link, leaves[found].depth = s->depth;
      ++found, --top;
      continue;
    }
    const uint at = made++, depth = s->depth + 1u;
    put_packed(&nodes[at], 0u, split.left_box);
    put_packed(&nodes[at], 1u, split.right_box);
    nodes[at].child[0] = nodes[at].child[1] = FACET_NONE;
    nodes[at].spare[0] = nodes[at].spare[1] = 0u;
    if (s->link != FACET_NONE) nodes[s->link >> 1].child[s->link & 1u] = base + at;
    Segment* right = s++;
    part_segment(&orders, right, split.axis, split.left, s, right);
    right->link = 2u * at + 1u, right->depth = depth, right->area = packed_area(split.right_box);
    s->link = 2u * at, s->depth = depth, s->area = packed_area(split.left_box);
    ++top;
  }
  *leaf_count = found;
  return made;
}

#endif
