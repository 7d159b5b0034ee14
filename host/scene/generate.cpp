#include "scene/generate.hpp"

#include <cmath>
#include <iterator>

#include "scene/error.hpp"
#include "scene/generator.hpp"
#include "scene/nearest.hpp"
#include "scene/scene.hpp"
#include "scene/text_file.hpp"

namespace facet {
namespace {

const std::vector<generator>& all_generators() {
  static const std::vector<generator> all = [] {
    std::vector<generator> list;
    for (auto* some :
         {plain_generators, sphere_generators, surface_generators, recursive_generators}) {
      std::vector<generator> part = some();
      std::move(part.begin(), part.end(), std::back_inserter(list));
    }
    return list;
  }();
  return all;
}

const generator& find_generator(const std::string& kind) {
  std::vector<std::string> known;
  for (const generator& g : all_generators()) {
    if (g.info.kind == kind) return g;
    known.push_back(g.info.kind);
  }
  throw scene_error("", "", unknown_name("generator", kind, known));
}

void check_value(const generator_info::parameter& p, double value) {
  const bool fits = value >= p.least && value <= p.most && (!p.whole || value == std::floor(value));
  if (fits) return;
  throw scene_error("", p.name,
                    "found " + text_of(value) + "; allowed is a " +
                        (p.whole ? "whole number" : "number") + " from " + text_of(p.least) +
                        " to " + text_of(p.most));
}

arguments complete(const generator_info& info, const generator_parameters& given) {
  std::map<std::string, double> values;
  std::vector<std::string> known;
  for (const auto& p : info.parameters) {
    values[p.name] = p.fallback;
    known.push_back(p.name);
  }
  for (const auto& [name, value] : given)
    if (!values.count(name))
      throw scene_error("", name,
                        unknown_name("parameter of " + in_quotes(info.kind), name, known));
  for (const auto& p : info.parameters) {
    const auto found = given.find(p.name);
    if (found == given.end()) continue;
    check_value(p, found->second);
    values[p.name] = found->second;
  }
  return arguments(std::move(values));
}

/// The parameter to blame for too large a mesh: the one that makes most when it alone is given.
std::string largest_parameter(const generator& g, const generator_parameters& given) {
  std::string name;
  double most = -1;
  for (const auto& [candidate, value] : given) {
    const double triangles = g.triangles(complete(g.info, {{candidate, value}}));
    if (triangles > most) most = triangles, name = candidate;
  }
  return name;
}

}  // namespace

const std::vector<generator_info>& generators() {
  static const std::vector<generator_info> infos = [] {
    std::vector<generator_info> list;
    for (const generator& g : all_generators()) list.push_back(g.info);
    return list;
  }();
  return infos;
}

mesh generate(const std::string& kind, const generator_parameters& p) {
  const generator& g = find_generator(kind);
  const arguments a = complete(g.info, p);
  const double triangles = g.triangles(a);
  if (triangles > double(limits::triangles))
    throw scene_error("", largest_parameter(g, p),
                      "this " + in_quotes(kind) + " would have " + text_of(triangles) +
                          " triangles; allowed are " + text_of(double(limits::triangles)));
  mesh m = g.make(a);
  m.name = kind;
  return m;
}

}  // namespace facet
