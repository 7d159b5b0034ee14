#include "tracer/kernels.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using namespace facet::tracer;

TEST_CASE("the library holds every file of cl/, and a folder gives the same") {
  const runtime::source_tree& embedded = kernel_sources();
  for (const char* name :
       {"layout.h", "trace.cl", "render.cl", "render_packets.cl", "morton.cl", "radix_sort.cl",
        "radix_serial.cl", "radix_buckets.cl", "levels.cl", "tree.cl"})
    CHECK(embedded.files.count(name) == 1);
  const auto folder = std::filesystem::temp_directory_path() / "facet_kernels_test";
  std::filesystem::create_directories(folder);
  for (const auto& [name, text] : embedded.files) std::ofstream(folder / name) << text;
  CHECK(runtime::read_folder(folder).files == embedded.files);

  // A kernel edited there is what runs: one that paints everything with alpha 0.5.
  {
    std::ofstream render(folder / "render.cl");
    std::string text = embedded.files.at("render.cl");
    const std::string from = "= sum / (float)(n * n);";
    text.replace(text.find(from), from.size(), "= (float4)(0.5f);");
    render << text;
  }
  options o;
  o.kernel_folder = folder.string();
  o.packets = packet_kind::off;
  device_scene edited(test::queue(), test::one_mesh(generate("box", {})), o);
  CHECK(edited.render(4, 4, 1).rgba == std::vector<float>(64, 0.5f));
  std::filesystem::remove_all(folder);
  CHECK_THROWS_AS(device_scene(test::queue(), test::one_mesh(generate("box", {})), o),
                  runtime::exception);
}

TEST_CASE("options name what is left out and what was chosen; stacks grow in steps") {
  const features none{false, false, false, false, false};
  const std::string o = traversal_options(none, 3, tree_kind::none, true, false, 33, 5, tuning{});
  CHECK(o.find("-DFACET_NO_TRANSPARENCY") != std::string::npos);
  CHECK(o.find("-DFACET_TREE_NONE") != std::string::npos);
  CHECK(o.find("-DFACET_GEOMETRY_IMAGE") != std::string::npos);
  CHECK(o.find("-DFACET_WIDE") == std::string::npos);
  CHECK(o.find("-DFACET_STACK=64") != std::string::npos);
  CHECK(o.find("-DFACET_RAY_STACK=8") != std::string::npos);
  CHECK(o.find("-DFACET_NESTING=3") != std::string::npos);
  const std::string all =
      traversal_options(features::all(), 1, tree_kind::levels, false, true, 1, 9, tuning{});
  CHECK(all.find("FACET_NO_") == std::string::npos);
  CHECK(all.find("-DFACET_WIDE") != std::string::npos);
  CHECK(all.find("-DFACET_STACK=32") != std::string::npos);
  CHECK(all.find("-DFACET_RAY_STACK=16") != std::string::npos);
}

TEST_CASE("kernels call no function whose last bits are a device's own") {
  const std::regex comment("//[^\\n]*");
  const std::regex inexact(
      "\\b(exp(2|10|m1)?|log(2|10|1p|b)?|pow[nr]?|rootn|[rc]brt|hypot|rsqrt|erfc?|[lt]gamma|"
      "a?(sin|cos|tan)(h|pi)?|atan2(pi)?|sincos|mad|mix|smoothstep|degrees|radians|"
      "dot|cross|length|distance|normalize|(fast|native)_\\w+|"
      "half_(cos|divide|exp|log|pow|recip|rsqrt|sin|sqrt|tan)\\w*)\\(");
  const auto calls = [&](const std::string& text) {
    std::smatch found;
    const std::string code = std::regex_replace(text, comment, "");
    return std::regex_search(code, found, inexact) ? found.str() : "";
  };
  CHECK(calls("x = native_exp(y);") == "native_exp(");
  CHECK(calls("x = exp_strict(y) + dot3(a, b);  // exp(y)") == "");
  for (const auto& file : kernel_sources().files) {
    CAPTURE(file.first);
    CHECK(calls(file.second) == "");
  }
}
