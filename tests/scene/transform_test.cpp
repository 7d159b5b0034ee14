#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace {

using facet::transform;
using facet::vec3d;

double distance(vec3d a, vec3d b) { return facet::length(a - b); }

transform any_transform(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-2, 2);
  const auto vector = [&] {
    const double x = number(random), y = number(random), z = number(random);
    return vec3d(x, y, z);
  };
  return transform::translate(vector()) * transform::rotate(vector(), 90 * number(random)) *
         transform::scale({0.5 + std::abs(number(random)), 1.5, -0.75});
}

}  // namespace

TEST_CASE("a rotation is right-handed") {
  CHECK(transform::rotate({0, 0, 1}, 90).point({1, 0, 0}) == vec3d(0, 1, 0));
  CHECK(transform::rotate({1, 0, 0}, 90).point({0, 1, 0}) == vec3d(0, 0, 1));
  CHECK(transform::rotate({0, 1, 0}, 90).point({0, 0, 1}) == vec3d(1, 0, 0));
}

TEST_CASE("quarter turns move integers to integers exactly, whatever the axis's length") {
  for (double turns : {-7, -4, -3, -2, -1, 0, 1, 2, 3, 4, 6, 401}) {
    const vec3d p = transform::rotate({0, 1e-200, 0}, 90 * turns).point({3, 5, 7});
    CHECK(p.y == 5);
    CHECK(std::abs(p.x) + std::abs(p.z) == 10);
    CHECK(std::abs(p.x) == (std::fmod(turns, 2) == 0 ? 3 : 7));
  }
}

TEST_CASE("a rotation keeps lengths and its axis") {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const vec3d axis(number(random), number(random), number(random) + 1.5);
    const vec3d p(number(random), number(random), number(random));
    const transform t = transform::rotate(axis, 360 * number(random));
    // Each entry of the matrix carries less than 8 roundings of numbers of at most 2 in size, and
    // coordinates are at most 2.5: 3 * 8 * 2 * 2.5 * 2^-53 < 2^-46.
    CHECK(std::abs(facet::length(t.vector(p)) - facet::length(p)) < 0x1p-46);
    CHECK(distance(t.vector(axis), axis) < 0x1p-46);
  }
}

TEST_CASE("a product applies its right factor first") {
  const transform move = transform::translate({1, 2, 3}), grow = transform::scale({2, 2, 2});
  CHECK((grow * move).point({1, 1, 1}) == vec3d(4, 6, 8));
  CHECK((move * grow).point({1, 1, 1}) == vec3d(3, 4, 5));
}

TEST_CASE("vectors do not feel the offset") {
  CHECK(transform::translate({1, 2, 3}).vector({4, 5, 6}) == vec3d(4, 5, 6));
}

TEST_CASE("transposed_vector is the adjoint of vector") {
  std::mt19937 random(2);
  const transform t = any_transform(random);
  const vec3d a(0.3, -0.7, 1.1), b(-1.3, 0.2, 0.9);
  // Sums of 9 products below 10 in size, each rounded a few times.
  CHECK(std::abs(dot(t.vector(a), b) - dot(a, t.transposed_vector(b))) < 9 * 10 * 4 * 0x1p-53);
}

TEST_CASE("the inverse undoes the map, mirrors included") {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const transform t = any_transform(random);
    CHECK(t.determinant() < 0);
    const vec3d p(0.25, -3, 2);
    // Condition numbers here stay below 4 (scales 0.5 to 2.5, 0.75, 1.5) and coordinates below 16:
    // some dozens of roundings of numbers below 64.
    CHECK(distance(t.inverse().point(t.point(p)), p) < 64 * 64 * 0x1p-53);
  }
}

TEST_CASE("scales of a millionth and of a million have exact powers in their inverse") {
  const transform t = transform::translate({8, 0, -8}) * transform::scale({0x1p-20, 0x1p20, 1});
  CHECK(t.inverse().point(t.point({1, 2, 3})) == vec3d(1, 2, 3));
  CHECK(t.determinant() == 1);
}

TEST_CASE("a singular transform has no inverse") {
  CHECK_THROWS_AS(transform::scale({1, 0, 1}).inverse(), std::domain_error);
  CHECK_THROWS_AS(transform::scale({1, INFINITY, 1}).inverse(), std::domain_error);
  transform rows;
  rows.row = {{{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}}};
  CHECK_THROWS_AS(rows.inverse(), std::domain_error);
}

TEST_CASE("only the identity is the identity") {
  CHECK(transform{}.is_identity());
  CHECK(transform::rotate({0, 1, 0}, 360).is_identity());
  CHECK(!transform::translate({0, 0x1p-1000, 0}).is_identity());
  CHECK(!transform::scale({1, 1, -1}).is_identity());
}
