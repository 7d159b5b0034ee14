#include "scene/material.hpp"

#include <doctest/doctest.h>

#include <cmath>

using facet::material;
using facet::vec3d;

TEST_CASE("a distance D inside leaves the attenuation colour, and 2 D its square") {
  material m;
  m.Kt = {1, 1, 1};
  m.has_attenuation = true;
  m.attenuation = {0.5f, 0.25f, 0.9f};
  m.attenuation_distance = 3;
  const vec3d sigma = m.absorption();
  for (int i = 0; i < 3; ++i) {
    const double a = m.attenuation[i];
    // One logarithm, one exponential, a division and a product: each within 2 units of 2^-53.
    CHECK(std::abs(std::exp(-3 * sigma[i]) - a) < 8 * 0x1p-53);
    CHECK(std::abs(std::exp(-6 * sigma[i]) - a * a) < 16 * 0x1p-53);
  }
}

TEST_CASE("without an attenuation colour it is Kt") {
  material m;
  m.Kt = {0.5f, 0.25f, 1};
  CHECK(m.absorption() == vec3d(-std::log(0.5), -std::log(0.25), -std::log(1.0)));
}

TEST_CASE("an opaque material absorbs nothing") {
  material m;
  m.has_attenuation = true;
  m.attenuation = {0, 0, 0};
  CHECK(m.absorption() == vec3d(0, 0, 0));
}

TEST_CASE("a black channel of a transparent material has a finite absorption") {
  material m;
  m.Kt = {1, 0, 0};
  const vec3d sigma = m.absorption();
  CHECK(sigma.x == 0);
  CHECK(sigma.y == -std::log(1e-30));
  CHECK(std::exp(-sigma.y) > 0);
}

TEST_CASE("one channel makes a material transparent, or a mirror") {
  material m;
  CHECK(!m.is_transparent());
  CHECK(!m.is_mirror());
  m.Kt = {0, 0, 0.1f};
  m.Kr = {0, 0.1f, 0};
  CHECK(m.is_transparent());
  CHECK(m.is_mirror());
}
