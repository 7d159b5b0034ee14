#include "study/variant_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "tracer/kernels.hpp"

using namespace facet;

namespace {

bool has(const std::vector<study::listed_variant>& all, const std::string& name) {
  return std::any_of(all.begin(), all.end(), [&](const auto& v) { return v.name == name; });
}

}  // namespace

TEST_CASE("strict comes first, unchanged; names are single words, each once") {
  const auto all = study::variant_list(6);
  CHECK(all.size() >= 12);
  CHECK(all[0].name == "strict");
  CHECK(all[0].is_exact);
  CHECK(all[0].options.edits.empty());
  CHECK(all[0].options.compiler_flags.empty());
  std::set<std::string> names;
  for (const study::listed_variant& v : all) {
    CAPTURE(v.name);
    CHECK(names.insert(v.name).second);
    CHECK(v.name.find_first_of(" ,") == std::string::npos);
    CHECK(!v.about.empty());
    CHECK(!v.family.empty());
    CHECK(v.max_depth <= 6);
    CHECK(!(v.is_exact && v.is_shading_only));
  }
  for (const char* name : {"images", "no-tree", "all-features", "contracted", "fast-math",
                           "moller-trumbore", "moller-trumbore-contracted", "plain-edges-fast-math",
                           "depth-5", "depth-4", "depth-3", "cutoff-1/64"})
    CHECK(has(all, name));
}

TEST_CASE("depths lie below the scene's, each once") {
  CHECK(has(study::variant_list(8), "depth-4"));
  const auto one = study::variant_list(1);
  CHECK(has(one, "depth-0"));
  CHECK(has(one, "cutoff-1/16"));
  const auto none = study::variant_list(0);
  CHECK(std::none_of(none.begin(), none.end(), [](const auto& v) { return v.is_shading_only; }));
}

// Whatever changes in the kernels, the variants must still find what they change.
TEST_CASE("every edit finds its text in the library's kernels, exactly once") {
  for (const study::listed_variant& v : study::variant_list(6)) {
    CAPTURE(v.name);
    auto files = tracer::kernel_sources().files;
    for (const tracer::kernel_edit& e : v.options.edits) {
      CAPTURE(e.from);
      std::string& text = files.at(e.file);
      const std::size_t at = text.find(e.from);
      REQUIRE(at != std::string::npos);
      CHECK(text.find(e.from, at + 1) == std::string::npos);
      text.replace(at, e.from.size(), e.to);
      if (v.is_shading_only) CHECK(e.file == "states.h");  // which tracing rays does not read
    }
  }
  const auto files = tracer::kernel_sources().files;
  CHECK(files.at("trace.cl").find("states.h") == std::string::npos);
}
