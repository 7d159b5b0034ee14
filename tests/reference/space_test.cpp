// Slab intervals: nested boxes have nested intervals, the walk's looser ones contain them, nothing
// is lost where a direction has zeros.
#include "reference/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/scenes.hpp"
#include "reference/walk.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

/// Any sign, zero at times, sizes over `decades` powers of two.
template <class T>
T wild(test::random& r, int decades) {
  if (r.below(12) == 0) return r.below(2) ? T(0) : T(-0.0);
  const T x = T(r.between(1, 2)) * std::exp2(T(int(r.below(std::uint32_t(2 * decades))) - decades));
  return r.below(2) ? x : -x;
}
template <class T>
vec3<T> wild_vec(test::random& r, int decades) {
  const T x = wild<T>(r, decades), y = wild<T>(r, decades), z = wild<T>(r, decades);
  return {x, y, z};
}

/// A box of float coordinates, as all boxes of trees are, and a space whose extent covers it.
template <class T>
struct wild_case {
  box3<T> outer, inner;
  space<T> s;

  wild_case(test::random& r, int decades) {
    for (int k = 0; k < 4; ++k) {
      const vec3<T> p(wild_vec<float>(r, decades));
      outer.add(p);
      if (k < 2) inner.add(p);
    }
    vec3<T> d;
    do d = wild_vec<T>(r, decades);
    while (is_refused(vec3<T>(), d));
    s = {wild_vec<T>(r, decades), d, max(abs(outer.lo), abs(outer.hi))};
  }
};

}  // namespace

TEST_CASE_TEMPLATE("the slab interval of a box contains that of every box inside it", T, float,
                   double) {
  test::random r(1);
  for (int i = 0; i < 100000; ++i) {
    const wild_case<T> c(r, i % 2 == 0 ? 4 : 55);
    const interval<T> a = c.s.slab(c.outer), b = c.s.slab(c.inner);
    REQUIRE(a.near <= b.near);
    REQUIRE(a.far >= b.far);
  }
}

TEST_CASE_TEMPLATE("the walk's slabs contain the canonical ones", T, float, double) {
  test::random r(2);
  for (int i = 0; i < 100000; ++i) {
    const wild_case<T> c(r, i % 2 == 0 ? 4 : 55);
    const interval<T> exact = c.s.slab(c.inner);
    const loose_slabs<T> loose(c.s);
    T near = -infinity<T>, far = infinity<T>;
    for (int k = 0; k < 3; ++k) {
      const auto& axis = loose.axes[std::size_t(k)];
      const bool up = axis.near_plane % 2 == 0;
      near = std::max<T>(near,
                         (up ? c.inner.lo : c.inner.hi)[k] * axis.inverse[0] + axis.near_offset[0]);
      far = std::min<T>(far,
                        (up ? c.inner.hi : c.inner.lo)[k] * axis.inverse[0] + axis.far_offset[0]);
    }
    REQUIRE(near <= exact.near);
    REQUIRE(far >= exact.far);
  }
}

TEST_CASE_TEMPLATE("a ray in a face, along an edge or through a flat box is not lost", T, float,
                   double) {
  const box3<T> flat{{-1, -1, 0}, {1, 1, 0}}, cube{{-1, -1, -1}, {1, 1, 1}};
  for (const T zero : {T(0), T(-0.0)}) {
    for (const box3<T>& b : {flat, cube}) {
      const T z = b.hi.z;
      for (const vec3<T>& o : {vec3<T>(-3, 0, z), vec3<T>(-3, 1, z), vec3<T>(-3, -1, z)}) {
        const interval<T> t = space<T>(o, {1, zero, zero}, {1, 1, 1}).slab(b);
        CHECK(t.near <= 2);
        CHECK(t.far >= 4);
      }
    }
    const interval<T> across = space<T>({0, 1, 5}, {zero, zero, -1}, {1, 1, 1}).slab(flat);
    CHECK(across.near <= 5);
    CHECK(across.far >= 5);
    // Beyond the pad (24u * 4 here) on an axis without motion there is nothing to meet.
    const interval<T> beside = space<T>({-3, T(1.5), 0}, {1, zero, zero}, {1, 1, 1}).slab(cube);
    CHECK_FALSE((beside.near <= beside.far && beside.far >= 0));
  }
}

TEST_CASE_TEMPLATE("an axis whose offset overflows constrains nothing", T, float, double) {
  const box3<T> b{{299, -1, -1}, {301, 1, 1}};
  const space<T> s({300, 0, 10}, {0, 0, -T(0x1p-60)}, {301, 1, 1});
  const interval<T> t = s.slab(b);
  CHECK(t.near <= 10 * T(0x1p60));
  CHECK(t.far >= 10 * T(0x1p60));
}

TEST_CASE_TEMPLATE("rays beyond the limits are refused, those at the limits are not", T, float,
                   double) {
  const T big = T(0x1p60), small = T(0x1p-60), inf = infinity<T>;
  const vec3<T> o(0, 0, 1), d(0, 0, -1);
  CHECK_FALSE(is_refused(ray<T>{o, 0, d, inf}));
  CHECK_FALSE(is_refused(ray<T>{{big, -big, big}, -5, {big, 0, -big}, 1}));
  CHECK_FALSE(is_refused(ray<T>{o, 0, {0, small, 0}, 1}));
  CHECK(is_refused(ray<T>{o, 0, {0, small / 2, 0}, 1}));
  CHECK(is_refused(ray<T>{o, 0, {0, 0, 0}, 1}));
  CHECK(is_refused(ray<T>{o, 0, {0, big * 2, 0}, 1}));
  CHECK(is_refused(ray<T>{{big * 2, 0, 0}, 0, d, 1}));
  CHECK(is_refused(ray<T>{o, NAN, d, 1}));
  CHECK(is_refused(ray<T>{o, 0, d, NAN}));
  for (int i = 0; i < 3; ++i)
    for (const T bad : {T(NAN), inf, -inf}) {
      vec3<T> x = o, y = d;
      x[i] = bad, y[i] = bad;
      CHECK(is_refused(ray<T>{x, 0, d, 1}));
      CHECK(is_refused(ray<T>{o, 0, y, 1}));
    }
}
