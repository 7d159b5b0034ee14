#include "cli/mesh_word.hpp"

#include <charconv>
#include <filesystem>

#include "scene/error.hpp"
#include "scene/generate.hpp"
#include "scene/load.hpp"

namespace facet::cli {
namespace {

namespace fs = std::filesystem;

double number(const std::string& word, const std::string& name, const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end)
    throw scene_error(word, name, "found \"" + text + "\", a number is needed");
  return value;
}

/// "1000" or "p=3,q=5" for a generator of that kind.
generator_parameters parameters_of(const std::string& word, const std::string& kind,
                                   std::string text) {
  generator_parameters parameters;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string item = text.substr(0, comma);
    text = comma == std::string::npos ? "" : text.substr(comma + 1);
    const std::size_t equals = item.find('=');
    const bool bare = equals == std::string::npos;
    const std::string name = bare ? size_parameter(kind) : item.substr(0, equals);
    if (parameters.count(name)) throw scene_error(word, name, "is given twice");
    parameters[name] = number(word, name, bare ? item : item.substr(equals + 1));
  }
  return parameters;
}

/// Is a word that is no mesh file the name of another, there or not?
bool is_file(const std::string& word) {
  std::error_code ignored;
  if (fs::exists(word, ignored)) return true;
  return fs::path(word).has_extension() && word.find(':') == std::string::npos;
}

mesh generated(const std::string& word) {
  const std::size_t colon = word.find(':');
  const std::string kind = word.substr(0, colon);
  // generate() checks the kind; without one there is no parameter to speak of.
  const generator_parameters parameters = colon == std::string::npos || size_parameter(kind).empty()
                                              ? generator_parameters{}
                                              : parameters_of(word, kind, word.substr(colon + 1));
  return generate(kind, parameters);
}

scene scene_of_parts(std::string name, mesh m) {
  scene s;
  s.name = std::move(name);
  s.materials.resize(1);
  m.materials.clear();  // a ray's hit does not depend on them
  s.meshes.push_back(std::move(m));
  s.instances.resize(1);
  return s;
}

}  // namespace

std::string size_parameter(const std::string& kind) {
  for (const generator_info& g : generators()) {
    if (g.kind != kind) continue;
    for (const char* name : {"n", "subdivisions", "depth", "divisions"})
      for (const auto& p : g.parameters)
        if (p.name == name) return name;
    return g.parameters.empty() ? "" : g.parameters.front().name;
  }
  return "";
}

scene scene_of_word(const std::string& word) {
  if (is_mesh_file(word)) {
    mesh_file file = read_mesh_file(word);
    scene s = scene_of_parts(word, std::move(file.mesh));
    s.notes = std::move(file.notes);
    return s;
  }
  return is_file(word) ? load_scene(word) : scene_of_parts(word, generated(word));
}

scene picture_of_word(const std::string& word) {
  if (is_mesh_file(word) || is_file(word)) return load_scene(word);
  mesh m = generated(word);
  m.materials.clear();
  return scene_of_mesh({std::move(m), {}, {}}, word);
}

}  // namespace facet::cli
