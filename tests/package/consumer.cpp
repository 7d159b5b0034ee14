// Somebody else's program: traces one ray through the installed library, on the first device.
#include <cstdio>

#include "scene/generate.hpp"
#include "tracer/tracer.hpp"

int main() {
  facet::scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back(facet::generate("box", {{"size", 2}}));
  scene.instances.emplace_back();
  facet::runtime::queue queue{facet::runtime::select_device("0")};
  facet::tracer::device_scene on_device(queue, scene);
  const facet::tracer::ray ray{{0, 0, 5}, 0, {0.1f, 0.2f, -4}, 10};
  const auto hits = on_device.trace({&ray, 1});
  std::printf("t = %g, triangle %u\n", double(hits[0].t), hits[0].triangle);
  return hits[0].t == 1.0f ? 0 : 1;
}
