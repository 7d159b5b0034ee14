#include "tracer/layout.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"

using namespace facet;
using namespace facet::tracer;

// Each field of the shared structures by name, once for both languages: the text below is compiled
// here and, as a string, on the device.
// clang-format off
#define FIELDS(SIZE, FIELD) \
  SIZE(Box) FIELD(Box, hi) FIELD(Box, spare1) \
  SIZE(TreeNode) FIELD(TreeNode, left) FIELD(TreeNode, right) FIELD(TreeNode, height) \
  SIZE(Node) FIELD(Node, y) FIELD(Node, z) FIELD(Node, child) \
  SIZE(WideNode) FIELD(WideNode, y) FIELD(WideNode, z) FIELD(WideNode, child) \
  SIZE(TriangleBlock) \
  SIZE(FoldCost) FIELD(FoldCost, nodes) FIELD(FoldCost, depth) \
  SIZE(FoldPlan) FIELD(FoldPlan, next) \
  SIZE(TriangleInfo) FIELD(TriangleInfo, material) \
  SIZE(Instance) FIELD(Instance, world_from_object) FIELD(Instance, lo) FIELD(Instance, id) \
    FIELD(Instance, hi) FIELD(Instance, root) FIELD(Instance, reach) FIELD(Instance, material) \
    FIELD(Instance, first_triangle) FIELD(Instance, triangle_count) \
  SIZE(Material) FIELD(Material, Ns) FIELD(Material, Ka) FIELD(Material, Ni) \
    FIELD(Material, Kd) FIELD(Material, transparent) FIELD(Material, Ks) \
    FIELD(Material, specular) FIELD(Material, Kr) FIELD(Material, Kt) \
    FIELD(Material, minus_ln_Kt) FIELD(Material, sigma) \
  SIZE(Light) FIELD(Light, kind) FIELD(Light, colour) FIELD(Light, falloff) \
  SIZE(View) FIELD(View, width) FIELD(View, corner) FIELD(View, height) FIELD(View, dx) \
    FIELD(View, max_depth) FIELD(View, dy) FIELD(View, samples) FIELD(View, background) \
    FIELD(View, background_alpha) FIELD(View, ambient) FIELD(View, light_count) \
    FIELD(View, media) \
  SIZE(Faults) FIELD(Faults, crowded) \
  SIZE(SurfacePoint) FIELD(SurfacePoint, triangle) FIELD(SurfacePoint, delta) \
    FIELD(SurfacePoint, near_side) FIELD(SurfacePoint, children) FIELD(SurfacePoint, refracted_weight) \
  SIZE(Passage) FIELD(Passage, is_dark) FIELD(Passage, exits) \
  SIZE(World) FIELD(World, root) FIELD(World, instance_count) FIELD(World, triangle_count) \
  SIZE(Ray) FIELD(Ray, tmin) FIELD(Ray, direction) FIELD(Ray, tmax) \
  SIZE(Hit) FIELD(Hit, triangle)
// clang-format on

#define TEXT(...) #__VA_ARGS__
#define HOST_SIZE(type) std::uint32_t(sizeof(type)),
#define HOST_FIELD(type, field) std::uint32_t(offsetof(type, field)),
#define DEVICE_SIZE(type) *out++ = (uint)sizeof(type);
#define DEVICE_FIELD(type, field) \
  *out++ = (uint)(size_t)((__private char*)&x_##type.field - (__private char*)&x_##type);
#define EXPANDED(...) TEXT(__VA_ARGS__)

TEST_CASE("the device lays out every shared structure as the host does") {
  const std::vector<std::uint32_t> expected{FIELDS(HOST_SIZE, HOST_FIELD)};
  runtime::source_tree sources = kernel_sources();
  sources.files["layout_test.cl"] =
      "#include \"layout.h\"\n"
      "__kernel void ask(__global uint* out) {\n"
      "Box x_Box; TreeNode x_TreeNode; Node x_Node; WideNode x_WideNode;\n"
      "TriangleBlock x_TriangleBlock; FoldCost x_FoldCost; FoldPlan x_FoldPlan; TriangleInfo "
      "x_TriangleInfo; Instance x_Instance;\n"
      "Material x_Material; Light x_Light; View x_View; World x_World; Ray x_Ray; Hit "
      "x_Hit; Faults x_Faults; SurfacePoint x_SurfacePoint; Passage "
      "x_Passage;\n" EXPANDED(FIELDS(DEVICE_SIZE, DEVICE_FIELD)) "\n}\n";
  runtime::queue& q = test::queue();
  runtime::program program(q.get_context(), sources, "layout_test.cl", "");
  runtime::kernel ask = program.get_kernel("ask");
  runtime::buffer<std::uint32_t> found(expected.size());
  q.submit([&](runtime::handler& h) {
    const runtime::accessor out{found, h, runtime::write_only};
    h.set_args(out);
    h.single_task(ask);
  });
  const runtime::host_accessor read{found, runtime::read_only};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(read[i] == expected[i]);
  }
}
