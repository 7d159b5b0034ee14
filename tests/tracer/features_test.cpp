#include "tracer/features.hpp"

#include <doctest/doctest.h>

#include "tracer/scenes_helper.hpp"

using namespace facet;
using tracer::features;

TEST_CASE("a plain scene needs no feature, and each flag leaves one out") {
  const features f = features::of(test::one_mesh(generate("box", {})));
  CHECK(f == features{false, false, false, false, false});
  CHECK(f.names() == "none");
  CHECK(f.flags() ==
        " -DFACET_NO_INSTANCES -DFACET_NO_TRANSPARENCY -DFACET_NO_REFLECTION -DFACET_NO_SMOOTH"
        " -DFACET_NO_SPECULAR");
}

TEST_CASE("all features are on by default") {
  CHECK(features::all().flags().empty());
  CHECK(features::of(test::every_feature()) == features::all());
}

TEST_CASE("each part of a scene asks for its feature alone") {
  const scene plain = test::one_mesh(generate("box", {}));
  scene s = plain;
  s.materials[0].Kt = {0, 0.1f, 0};
  CHECK(features::of(s) == features{false, true, false, false, false});
  s = plain;
  s.materials[0].Kr = {0, 0, 0.1f};
  CHECK(features::of(s) == features{false, false, true, false, false});
  s = plain;
  s.materials[0].Ks = {0.1f, 0, 0};
  CHECK(features::of(s) == features{false, false, false, false, true});
  s = plain;
  s.meshes[0] = generate("icosphere", {{"smooth", 1}});
  CHECK(features::of(s) == features{false, false, false, true, false});
  s = plain;
  s.instances.push_back({});
  CHECK(features::of(s) == features{true, false, false, false, false});
  s = plain;
  s.instances[0].world_from_object = transform::scale({2, 2, 2});
  CHECK(features::of(s) == features{true, false, false, false, false});
}

TEST_CASE("a material that nothing shows asks for nothing") {
  scene s = test::one_mesh(generate("box", {}));
  material glass;
  glass.Kt = {1, 1, 1};
  s.materials.push_back(glass);
  CHECK(features::of(s).transparency == false);
  s.instances[0].material = 1;
  CHECK(features::of(s).transparency == true);
}
