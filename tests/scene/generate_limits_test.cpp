// What generators refuse: parameters beyond their limits, unknown names, too many triangles.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "scene/generate.hpp"
#include "scene/mesh_checks.hpp"
#include "scene/scratch_folder.hpp"

using namespace facet;
using namespace facet::test;

TEST_CASE("parameters are described within their own limits, and refused beyond them by name") {
  for (const generator_info& info : generators())
    for (const auto& p : info.parameters) {
      CAPTURE(info.kind);
      CAPTURE(p.name);
      CHECK(p.least <= p.fallback);
      CHECK(p.fallback <= p.most);
      CHECK(!p.about.empty());
      std::vector<double> refused{p.least - 1, p.most * 1.5 + 1, NAN, INFINITY, -INFINITY};
      if (p.whole) refused.push_back(p.least + 0.5);
      for (double value : refused) {
        const scene_error error = error_of([&] { generate(info.kind, {{p.name, value}}); });
        CHECK(error.place() == p.name);
        CHECK(contains(error.what(), "found "));
        CHECK(contains(error.what(), "allowed is a "));
      }
      if (p.whole) {
        CHECK(p.least == std::floor(p.least));
        CHECK(p.fallback == std::floor(p.fallback));
        CHECK(broken_promise(generate(info.kind, {{p.name, p.least}})) == "");
      }
    }
}

TEST_CASE("unknown kinds and parameters name the nearest known") {
  CHECK(contains(error_of([] { generate("icospere", {}); }).what(), "did you mean \"icosphere\""));
  const scene_error error = error_of([] { generate("icosphere", {{"subdivision", 2}}); });
  CHECK(error.place() == "subdivision");
  CHECK(contains(error.what(), "did you mean \"subdivisions\""));
}

TEST_CASE("too many triangles are refused before any is made, by the parameter that asks") {
  const scene_error error = error_of([] {
    generate("sphereflake", {{"depth", 8}, {"subdivisions", 8}});
  });
  CHECK(error.place() == "depth");
  CHECK(contains(error.what(), "would have 6.347497275e+13 triangles; allowed are 134217728"));
  CHECK(error_of([] { generate("menger", {{"depth", 6}}); }).place() == "depth");
  CHECK(contains(error_of([] {
                   generate("uv_sphere", {{"slices", 65536}, {"stacks", 65536}});
                 }).what(),
                 "would have"));
}

TEST_CASE("a knot that would run over itself is refused") {
  CHECK(error_of([] { generate("torus_knot", {{"p", 4}, {"q", 6}}); }).place() == "q");
}
