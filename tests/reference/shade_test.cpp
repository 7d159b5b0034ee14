// Light: what analysis says that mirrors, glass and lamps do.
#include "reference/shade.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;
using test::add;
using test::seen;

namespace {

constexpr vec3f red{1, 0.25f, 0.125f};

/// A floor at z = 0 that is lit and seen from above.
scene lit_floor(material m, light l) {
  scene s;
  add(s, test::rectangle({0, 0, 0}, {50, 0, 0}, {0, 50, 0}), std::move(m));
  s.lights.push_back(l);
  return s;
}

light lamp_at(vec3d position) {
  light l;
  l.position = position;
  return l;
}
light sun_along(vec3d direction) {
  light l;
  l.type = light::kind::directional;
  l.direction = direction;
  return l;
}

/// A closed box around the origin.
mesh block(double x, double y, double z) { return generate("box", {{"x", x}, {"y", y}, {"z", z}}); }

/// A glowing square of half side `half` around `at`, facing `towards`.
void add_target(scene& s, vec3d at, vec3d towards, double half) {
  const vec3d n = normalize(towards);
  const vec3d u = normalize(cross(n, std::abs(n.x) < 0.5 ? vec3d(1, 0, 0) : vec3d(0, 1, 0)));
  add(s, test::rectangle(vec3f(at), vec3f(u * half), vec3f(cross(n, u) * half)),
      test::glowing(red));
}

}  // namespace

TEST_CASE_TEMPLATE("emission and ambient light are taken as they are", T, float, double) {
  material m = test::glowing({0.5f, 0.25f, 2});
  m.Ka = {0.5f, 1, 0};
  scene s;
  add(s, test::unit_triangle(), m);
  s.ambient = {0.25f, 0.5f, 4};
  s.background = {3, 2, 1};
  CHECK(seen<T>(s, {0.25, 0.25, 1}, {0, 0, -1}) == vec3<T>(T(0.625), T(0.75), 2));
  CHECK(seen<T>(s, {0.25, 0.25, -1}, {0, 0, 1}) == vec3<T>(T(0.625), T(0.75), 2));
  CHECK(seen<T>(s, {0.25, 0.25, 1}, {0, 0, 1}) == vec3<T>(3, 2, 1));
}

TEST_CASE("a white furnace: mirrors and glass neither add nor lose") {
  scene s;
  s.background = {1, 1, 1};
  material m = test::black();
  m.Kr = {1, 1, 1};
  add(s, generate("icosphere", {{"subdivisions", 3}}), m);
  CHECK(seen<double>(s, {0.3, 0.2, 4}, {0, 0, -1}) == vec3d(1, 1, 1));

  m = test::clear(1.5f);
  m.Kr = {0.125f, 0.125f, 0.125f};
  m.Kt = {0.875f, 0.875f, 0.875f};
  m.has_attenuation = true;
  s.materials[0] = m;
  // A ray that got into a sphere leaves it again at each surface but for Kr: after 10 bounces
  // 0.875 * 0.125^9 of it is not yet out.
  const vec3d c = seen<double>(s, {0.3, 0.2, 4}, {0, 0, -1}, 10);
  CHECK(c.x <= 1 + 1e-15);
  CHECK(c.x >= 1 - std::pow(0.125, 9) - 1e-15);
}

TEST_CASE("lamps: cosine, f(d) = min(1, 1 / (a + b d + c d^2)), nothing from behind") {
  material m = test::black();
  m.Kd = {0.5f, 0.25f, 1};
  light l = lamp_at({3, 0, 4});
  l.colour = {2, 2, 2};
  l.constant = 0.5f, l.linear = 0.25f, l.quadratic = 0.125f;
  const double g = 0.5 + 0.25 * 5 + 0.125 * 25;
  CHECK(length(seen<double>(lit_floor(m, l), {0, 0, 1}, {0, 0, -1}) -
               vec3d(0.5, 0.25, 1) * (2 * 0.8 / g)) < 1e-15);

  l.position = {0, 0, 0.5};  // g = 0.65625: clamped
  CHECK(length(seen<double>(lit_floor(m, l), {0.0, 0, 1}, {0, 0, -1}) - vec3d(1, 0.5, 2)) < 1e-15);
  l.position = {0, 0, -4};
  CHECK(seen<double>(lit_floor(m, l), {0, 0, 1}, {0, 0, -1}) == vec3d());
  CHECK(seen<double>(lit_floor(m, lamp_at({0, 0, 0})), {0, 0, 1}, {0, 0, -1}) == vec3d());
  CHECK(length(seen<double>(lit_floor(m, sun_along({-30, 0, -40})), {9, 0, 1}, {0, 0, -1}) -
               vec3d(0.4, 0.2, 0.8)) < 1e-15);
}

TEST_CASE("the highlight is (r.v)^Ns, and 1 in the mirrored direction") {
  material m = test::black();
  m.Ks = {1, 0.5f, 0};
  m.Ns = 8;
  const light l = sun_along({1, 0, -1});
  const auto at = [&](vec3d eye) { return seen<double>(lit_floor(m, l), eye, -eye); };
  CHECK(length(at({1, 0, 1}) - vec3d(1, 0.5, 0)) < 1e-14);
  const double c = 1 / std::sqrt(2.0);
  CHECK(length(at({0, 0, 1}) - vec3d(1, 0.5, 0) * std::pow(c, 8)) < 1e-14);
  CHECK(at({-1, 0, 0.5}) == vec3d());
}

TEST_CASE("a shadow falls where something opaque stands between, and only there") {
  material m = test::black();
  m.Kd = {1, 1, 1};
  scene s = lit_floor(m, lamp_at({0, 0, 10}));
  add(s, test::rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0}), m);
  // The blocker's shadow reaches to 2; behind the lamp it does not count.
  CHECK(seen<double>(s, {1.99, 0, 1}, {0, 0, -1}) == vec3d());
  CHECK(seen<double>(s, {2.01, 0, 1}, {0, 0, -1}).x > 0.9);
  s.lights[0].position = {0, 0, 4};
  CHECK(seen<double>(s, {0, 0, 1}, {0, 0, -1}) == vec3d(1, 1, 1));
}

TEST_CASE_TEMPLATE("a mirror shows what lies in the mirrored direction, times Kr", T, float,
                   double) {
  for (const double shift : {0.0, 0.01}) {
    scene s;
    material m = test::black();
    m.Kr = {0.5f, 0.5f, 0.25f};
    add(s, test::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), m);
    add_target(s, {3, 1.5 + shift, 6}, {-2, -1, -4}, 1e-3);
    const vec3<T> c = seen<T>(s, {-2, -1, 4}, {2, 1, -4});
    CHECK(c == (shift == 0 ? vec3<T>(T(0.5), T(0.125), T(0.03125)) : vec3<T>()));
    CHECK(seen<T>(s, {-2, -1, 4}, {2, 1, -4}, 0) == vec3<T>());
  }
}

TEST_CASE("a slab shifts a ray by Snell's law and keeps its direction") {
  const double n = 1.5, angle = 0.9, thick = 0.5;
  const vec3d d{std::sin(angle), 0, -std::cos(angle)};
  const double inner = std::asin(std::sin(angle) / n);
  for (const double shift : {0.0, 0.002}) {
    scene s;
    add(s, block(20, 20, thick), test::clear(float(n)));
    const vec3d out{thick * std::tan(inner) + shift, 0, -thick / 2};
    add_target(s, out + d * 3.0, -d, 5e-4);
    // In at (0, 0, thick/2): there and back in double to 1e-15, the target's corners to 1e-6.
    const vec3d c = seen<double>(s, vec3d(0, 0, thick / 2) - d * 3.0, d);
    CHECK(c == (shift == 0 ? vec3d(red) : vec3d()));
  }
}

TEST_CASE("a ball turns a ray twice by the difference of Snell's angles") {
  const double n = 1.5, height = 0.6, in = std::asin(height), within = std::asin(height / n);
  const double turn = 2 * (in - within);
  // From the entry at angle pi - in the ray runs on through the ball to its exit.
  const vec3d d{std::cos(turn), -std::sin(turn), 0};
  const double exit_angle = std::numbers::pi - in - (std::numbers::pi - 2 * within);
  const vec3d out{std::cos(exit_angle), std::sin(exit_angle), 0};
  for (const double shift : {0.0, 0.02}) {
    scene s;
    // Facets of 6 subdivisions (edges up to 0.023) lie 7e-5 under the sphere and their smooth
    // normals are off by that much; two refractions and a way of 1 make less than 2e-3 of it.
    add(s, generate("icosphere", {{"subdivisions", 6}, {"smooth", 1}}), test::clear(float(n)));
    add_target(s, out + d + vec3d(0, 0, shift), -d, 2e-3);
    CHECK(seen<double>(s, {-4, height, 0}, {1, 0, 0}) == (shift == 0 ? vec3d(red) : vec3d()));
  }
}

TEST_CASE("a prism at 45 degrees reflects totally beyond the critical angle, and lets pass below") {
  for (const double n : {1.5, 1.2}) {
    scene s;
    // Legs on x = 0 and y = 0, hypotenuse from (1, 0) to (0, 1).
    add(s,
        test::mesh_of({{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                      {0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5}),
        test::clear(float(n)));
    const double bent = std::asin(n / std::sqrt(2.0)) - std::numbers::pi / 4;
    const vec3d out{std::cos(bent), -std::sin(bent), 0};
    const bool total = n > std::sqrt(2.0);
    const vec3d at = total ? vec3d(0.75, -3, 0) : vec3d(0.75, 0.25, 0) + out * 2.0;
    add_target(s, at, total ? vec3d(0, 1, 0) : -out, 1e-3);
    // 1.2 is rounded to float: a turn of 1e-7.
    CHECK(seen<double>(s, {-2, 0.25, 0.1}, {1, 0, 0}) == vec3d());
    CHECK(seen<double>(s, {-2, 0.25, 0}, {1, 0, 0}) == vec3d(red));
  }
}

TEST_CASE("angles around the critical one give finite colours between black and white") {
  scene s;
  s.background = {1, 1, 1};
  add(s, block(40, 40, 2), test::clear(1.5f));
  const double critical = std::asin(1 / 1.5);
  for (int i = -50; i <= 50; ++i) {
    const double a = critical + i * 1e-8;
    // From inside the glass.
    const vec3f c = seen<float>(s, {0, 0, 0}, {std::sin(a), 0, std::cos(a)}, 6);
    CHECK(c.x >= 0);
    CHECK(c.x <= 1.00001f);
  }
}

TEST_CASE_TEMPLATE("a slab dims what is seen through it as it dims the light that passes", T, float,
                   double) {
  material glass = test::clear(1);
  glass.Kt = {0.75f, 0.5f, 0.875f};
  glass.has_attenuation = true;
  glass.attenuation = {0.5f, 0.75f, 0.25f};
  glass.attenuation_distance = 2;
  for (const double thick : {0.25, 1.0, 3.0}) {
    scene through;
    add(through, block(20, 20, thick), glass, transform::translate({0, 0, 4}));
    add(through, test::rectangle({0, 0, 0}, {9, 0, 0}, {0, 9, 0}), test::glowing({1, 1, 1}));
    const vec3<T> eye = seen<T>(through, {0.1, 0.2, 8}, {0, 0, -1});

    material white = test::black();
    white.Kd = {1, 1, 1};
    for (const light& l : {sun_along({0, 0, -1}), lamp_at({0.1, 0.2, 10})}) {
      scene s = lit_floor(white, l);
      add(s, block(20, 20, thick), glass, transform::translate({0, 0, 4}));
      const vec3<T> lit = seen<T>(s, {0.1, 0.2, 1}, {0, 0, -1});
      for (int i = 0; i < 3; ++i) {
        const double exact =
            std::pow(double(glass.Kt[i]), 2) * std::pow(double(glass.attenuation[i]), thick / 2);
        // sigma < 1, distances < 10, ln Kt < 1: four terms of less than 10, each rounded thrice,
        // and 2^-33 for each by the fixed point; the eye's way has fewer.
        const double tolerance = (4 * 10 * 3 * double(unit_roundoff<T>) + 4 * 0x1p-33) * exact;
        CHECK(std::abs(double(eye[i]) - exact) <= tolerance);
        CHECK(std::abs(double(lit[i]) - exact) <= tolerance);
      }
    }
  }
}

TEST_CASE("ways inside media: the origin, the lamp or both may lie within") {
  scene s;
  material glass = test::clear(1.5f);
  glass.Kt = {0.5f, 0.5f, 0.5f};
  glass.has_attenuation = true;
  glass.attenuation = {0.25f, 0.5f, 1};
  const std::uint32_t medium = add(s, block(2, 2, 2), glass);
  const tracer<double> t(s);
  const auto check = [&](double from, double to, std::uint32_t inside, int surfaces, double way) {
    const vec3d got = t.transmittance({{0.1, 0.2, from}, 0, {0, 0, 1}, to - from}, inside);
    const vec3d brute = t.transmittance_brute({{0.1, 0.2, from}, 0, {0, 0, 1}, to - from}, inside);
    CHECK(got == brute);
    const double k = std::pow(0.5, surfaces);
    CHECK(std::abs(got.x - k * std::pow(0.25, way)) < 1e-8);
    CHECK(std::abs(got.y - k * std::pow(0.5, way)) < 1e-8);
    CHECK(std::abs(got.z - k) < 1e-8);
  };
  check(-3, 3, miss, 2, 2);
  check(-3, 0.5, miss, 1, 1.5);
  check(-0.5, 3, medium, 1, 1.5);
  check(-0.5, 0.25, medium, 0, 0.75);
  check(-3, -2, miss, 0, 0);
  check(-0.5, infinity<double>, medium, 1, 1.5);
  check(-3, infinity<double>, miss, 2, 2);

  add(s, test::rectangle({0, 0, 2}, {1, 0, 0}, {0, 1, 0}), test::black());
  CHECK(tracer<double>(s).transmittance({{0.1, 0.2, -3}, 0, {0, 0, 1}, 9}) == vec3d());
}

TEST_CASE("a shading normal below the surface keeps rays on their side and colours finite") {
  mesh m = test::rectangle({0, 0, 0}, {5, 0, 0}, {0, 5, 0});
  m.normals = {normalize(vec3f(1, 0, 0.05f)), normalize(vec3f(-1, 0, -0.3f))};
  m.normal_indices = {0, 1, 0, 1, 0, 1};
  for (material look : {test::clear(1.5f), test::clear(0.7f), test::black()}) {
    look.Kr = {0.5f, 0.5f, 0.5f};
    look.Kd = look.Ks = {0.5f, 0.5f, 0.5f};
    scene s = lit_floor(look, lamp_at({0, 3, 4}));
    s.meshes[0] = m;
    s.background = {1, 1, 1};
    test::random r(4);
    for (int i = 0; i < 300; ++i) {
      const vec3f o = r.in_cube() * 3.0f + vec3f(0, 0, i % 2 == 0 ? 4 : -4);
      const vec3f c =
          seen<float>(s, vec3d(o), vec3d(vec3f(r.in_cube().x, r.in_cube().y, 0) - o), 4);
      REQUIRE(is_finite(c));
      REQUIRE((c.x >= 0 && c.x < 10));
    }
  }
}
