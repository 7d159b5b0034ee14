#include "scene/world_bounds.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using facet::box3;
using facet::box3d;
using facet::box3f;
using facet::transform;
using facet::vec3d;
using facet::vec3f;
using facet::world_box;

namespace {

facet::mesh triangle(vec3f a, vec3f b, vec3f c) {
  facet::mesh m;
  m.positions = {a, b, c};
  m.indices = {0, 1, 2};
  return m;
}

const box3f unit_box{{-1, -2, -3}, {1, 2, 3}};

template <class T>
bool holds(const box3<T>& box, vec3d p) {
  for (int i = 0; i < 3; ++i)
    if (!(double(box.lo[i]) <= p[i] && p[i] <= double(box.hi[i]))) return false;
  return true;
}

}  // namespace

TEST_CASE_TEMPLATE("under the identity the box is the mesh's bounds exactly", T, float, double) {
  const auto box = world_box<T>(transform{}, unit_box);
  CHECK(vec3f(box.lo) == unit_box.lo);
  CHECK(vec3f(box.hi) == unit_box.hi);
}

TEST_CASE_TEMPLATE("the box holds every point of the moved mesh, with the growth to spare", T,
                   float, double) {
  const double growth = sizeof(T) == 4 ? 0x1p-20 : 0x1p-45;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10, 6 * number(random));
    const transform t =
        transform::translate({1e6 * number(random), number(random), 0}) *
        transform::rotate({number(random), number(random), 1.5}, 180 * number(random)) *
        transform::scale({size, 2 * size, -size});
    const auto box = world_box<T>(t, unit_box);
    for (int corner = 0; corner < 8; ++corner) {
      const vec3d p =
          t.point({corner & 1 ? 1. : -1., corner & 2 ? 2. : -2., corner & 4 ? 3. : -3.});
      CHECK(holds(box, p));
      for (int axis = 0; axis < 3; ++axis) {
        const double spare = growth / 2 * std::abs(t.row[axis][3]);
        CHECK(double(box.lo[axis]) <= p[axis] - spare);
        CHECK(double(box.hi[axis]) >= p[axis] + spare);
      }
    }
  }
}

TEST_CASE("the growth is the stated one, rounded outward") {
  // Sums to 2 * 1 + 8 = 10 on x, where the corners reach 6 and 10.
  const transform t = transform::translate({8, 0, 0}) * transform::scale({2, 1, 1});
  const box3d exact = world_box<double>(t, unit_box);
  CHECK(exact.lo.x == 6 - 10 * 0x1p-45);
  CHECK(exact.hi.x == 10 + 10 * 0x1p-45);
  const box3f box = world_box<float>(t, unit_box);
  CHECK(double(box.lo.x) <= 6 - 10 * 0x1p-20);
  CHECK(double(std::nextafter(box.lo.x, 7.f)) > 6 - 10 * 0x1p-20);
  CHECK(double(box.hi.x) >= 10 + 10 * 0x1p-20);
  CHECK(double(std::nextafter(box.hi.x, 7.f)) < 10 + 10 * 0x1p-20);
}

TEST_CASE("numbers that float cannot hold are rounded outward, not to nearest") {
  const transform t = transform::translate({1 + 0x1p-30, 0, 0}) * transform::scale({0x1p-60, 1, 1});
  const box3f box = world_box<float>(t, unit_box);
  CHECK(double(box.lo.x) < 1 + 0x1p-30 - 0x1p-20);
  CHECK(double(box.hi.x) > 1 + 0x1p-30 + 0x1p-20);
}

TEST_CASE("a scene's box is the union over its instances, and empty without any") {
  facet::scene s;
  s.meshes = {triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), triangle({5, 5, 5}, {6, 5, 5}, {5, 6, 9})};
  CHECK(world_box<float>(s).empty());
  s.instances = {{0, {}}, {1, {}}};
  const box3f both = world_box<float>(s);
  CHECK(both.lo == vec3f(0, 0, 0));
  CHECK(both.hi == vec3f(6, 6, 9));
  s.instances.push_back({0, transform::translate({-10, 0, 0})});
  const box3f wider = world_box<float>(s);
  CHECK(wider.lo.x < -10);
  CHECK(wider.lo.x > -10.001f);
  CHECK(wider.hi == vec3f(6, 6, 9));
  CHECK(world_box<float>(s.instances[2], s.meshes[0]).lo.x == wider.lo.x);
  s.instances.push_back({2, {}});
  CHECK_THROWS_AS(world_box<float>(s), std::out_of_range);
}

TEST_CASE("positions that no triangle uses do not count") {
  facet::mesh m = triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  m.positions.push_back({100, 100, 100});
  CHECK(world_box<float>(facet::instance{}, m).hi == vec3f(1, 1, 0));
}
