#include "study/variant_list.hpp"

#include <algorithm>

#include "study/variants.hpp"

namespace facet::study {
namespace {

/// "moller-trumbore, fast-math" as one word.
std::string word_of(const std::string& name) {
  std::string word;
  for (const char c : name)
    if (c == ' ')
      word += '-';
    else if (c != ',')
      word += c;
  return word;
}

/// A ray follows only if a channel of its throughput is more than 1/n.
std::vector<tracer::kernel_edit> cut_off(std::uint32_t n) {
  const auto weighs = [&](const std::string& v) {
    return "max(" + v + ".x, max(" + v + ".y, " + v + ".z)) > 1.0f / " + std::to_string(n) + ".0f";
  };
  return {{"states.h", "if (!is_black(kr)) {", "if (" + weighs("kr") + ") {"},
          {"states.h", "is_behind = !is_black(behind.throughput);",
           "is_behind = " + weighs("behind.throughput") + ";"}};
}

}  // namespace

std::vector<listed_variant> variant_list(std::uint32_t max_depth) {
  std::vector<listed_variant> all;
  const auto add = [&](std::string name, std::string family, std::string about) -> listed_variant& {
    listed_variant& v = all.emplace_back();
    v.name = std::move(name), v.family = std::move(family), v.about = std::move(about);
    v.max_depth = max_depth;
    return v;
  };
  const auto add_exact = [&](std::string name, std::string about) -> tracer::options& {
    listed_variant& v = add(std::move(name), "exact", std::move(about));
    v.is_exact = true;
    return v.options;
  };
  const auto add_edited = [&](const std::string& family, const std::vector<variant>& of) {
    for (const variant& e : of) {
      listed_variant& v = add(word_of(e.name), family, e.about);
      v.options = with(e, {});
    }
  };

  add_exact("strict", "the library's kernels as they are");
  add_exact("images", "vertices read from images").geometry = tracer::geometry_kind::image;
  add_exact("no-tree", "every ray tested against every triangle").tree = tracer::tree_kind::none;
  add_exact("all-features", "compiled with what the scene does not need").all_features = true;

  add_edited("arithmetic", other_arithmetic());
  const std::vector<variant> tests = inexact_variants();
  for (const std::string family : {"moller-trumbore", "plain edges"}) {
    std::vector<variant> some;
    for (const variant& v : tests)
      if (v.name.starts_with(family)) some.push_back(v);
    add_edited(family, some);
  }

  std::vector<std::uint32_t> depths;
  for (const std::uint32_t less : {1u, 2u, 3u})
    if (less <= max_depth) depths.push_back(max_depth - less);
  if (max_depth / 2 < max_depth) depths.push_back(max_depth / 2);
  std::sort(depths.rbegin(), depths.rend());
  depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
  for (const std::uint32_t depth : depths) {
    listed_variant& v = add("depth-" + std::to_string(depth), "fewer bounces",
                            std::to_string(depth) + " bounces, not " + std::to_string(max_depth));
    v.max_depth = depth;
    v.is_shading_only = true;
  }
  if (max_depth > 0)
    for (const std::uint32_t n : {256u, 64u, 16u}) {
      const std::string share = "1/" + std::to_string(n);
      listed_variant& v =
          add("cutoff-" + share, "cut-off", "rays that weigh at most " + share + " do not follow");
      v.options.edits = cut_off(n);
      v.is_shading_only = true;
    }
  return all;
}

}  // namespace facet::study
