#include "scene/read_json_meshes.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "scene/error.hpp"
#include "scene/generate.hpp"
#include "scene/load.hpp"
#include "scene/place.hpp"
#include "scene/scene_terms.hpp"

namespace facet {
namespace {

namespace fs = std::filesystem;

/// The file that the node names, checked to lie within `folder`.
fs::path file_within(const fs::path& folder, const json_node& node) {
  const std::string text = node.text("the path of a mesh file");
  const fs::path relative(text);
  const auto leaves = [&] {
    node.fail("the path " + in_quotes(text) +
              " leaves the scene's folder; put the mesh beside the scene file, or in a folder "
              "there, and give its relative path");
  };
  if (relative.is_absolute() || std::find(relative.begin(), relative.end(), "..") != relative.end())
    leaves();
  const fs::path path = folder / relative;
  std::error_code failed;
  const fs::path real = fs::canonical(path, failed), root = fs::canonical(folder);
  if (failed) node.fail("there is no file " + in_quotes(text) + " in the scene's folder");
  if (std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end())
    leaves();
  if (!fs::is_regular_file(real)) node.fail(in_quotes(text) + " is not a file");
  return path;
}

mesh_file read_file_mesh(const fs::path& folder, const json_node& node) {
  node.check_keys("a mesh from a file", scene_keys("file_mesh"));
  const json_node file = node.at("file", "a path");
  const fs::path path = file_within(folder, file);
  if (!is_mesh_file(path)) file.fail("is not a mesh file; these end in .obj or .ply");
  mesh_file result = read_mesh_file(path);
  for (std::string& note : result.notes) note = path.filename().string() + ": " + note;
  return result;
}

const generator_info& generator_named(const json_node& node) {
  std::vector<std::string> kinds;
  const std::string kind = node.text("the name of a generator");
  for (const generator_info& info : generators()) {
    if (info.kind == kind) return info;
    kinds.push_back(info.kind);
  }
  node.fail(unknown_name("generator", kind, kinds));
}

mesh generate_mesh(const json_node& node) {
  const generator_info& info = generator_named(node.at("generate", "the name of a generator"));
  std::vector<std::string> known = scene_keys("generated_mesh");
  for (const auto& parameter : info.parameters) known.push_back(parameter.name);
  node.check_keys("a mesh from the generator " + in_quotes(info.kind), known);
  generator_parameters values;
  for (const auto& parameter : info.parameters) {
    const std::optional<json_node> value = node.find(parameter.name);
    if (!value) continue;
    const bool is_switch = parameter.whole && parameter.least == 0 && parameter.most == 1;
    if (is_switch && value->is_boolean())
      values[parameter.name] = value->boolean() ? 1 : 0;
    else
      values[parameter.name] = value->number();
  }
  try {
    return generate(info.kind, values);
  } catch (const scene_error& e) {
    if (const auto parameter = node.find(e.place())) parameter->fail(e.message());
    node.fail((e.place().empty() ? "" : e.place() + ": ") + e.message());
  }
}

/// What the node says about materials: for each slot, or for triangles in turn.
struct material_choice {
  std::vector<std::uint32_t> slots;    ///< empty: the mesh's own
  std::vector<std::uint32_t> pattern;  ///< empty: go by slots
};

std::vector<std::uint32_t> named_materials(const json_node& node, const name_table& materials) {
  std::vector<std::uint32_t> result;
  const std::size_t n = node.size("an array of names of materials");
  for (std::size_t i = 0; i < n; ++i) result.push_back(materials.at(node.element(i)));
  return result;
}

material_choice read_choice(const json_node& node, std::size_t slots, const name_table& materials) {
  const auto one = node.find("material"), each = node.find("materials"),
             turns = node.find("material_pattern");
  if (int(one.has_value()) + int(each.has_value()) + int(turns.has_value()) > 1)
    node.fail(
        "has more than one of \"material\", \"materials\" and \"material_pattern\"; keep one");
  material_choice choice;
  if (one) choice.slots.assign(slots, materials.at(*one));
  if (each) {
    choice.slots = named_materials(*each, materials);
    if (choice.slots.size() != slots)
      each->fail("names " + std::to_string(choice.slots.size()) + " materials; this mesh has " +
                 std::to_string(slots) + (slots == 1 ? " slot" : " slots"));
  }
  if (turns) {
    choice.pattern = named_materials(*turns, materials);
    if (choice.pattern.empty()) turns->fail("is empty; name at least one material");
  }
  return choice;
}

/// The slots of a mesh file's own materials, which join the scene.
std::vector<std::uint32_t> add_own_materials(std::vector<material> own,
                                             const std::string& mesh_name,
                                             const name_table& materials, scene& s) {
  std::vector<std::uint32_t> slots;
  for (material& m : own) {
    if (const std::uint32_t* index = materials.find(m.name)) {
      slots.push_back(*index);
      continue;
    }
    m.name = mesh_name + '.' + m.name;
    slots.push_back(std::uint32_t(s.materials.size()));
    s.materials.push_back(std::move(m));
  }
  return slots;
}

void assign(const material_choice& choice, mesh& m) {
  const std::size_t n = m.triangle_count();
  if (m.materials.empty()) m.materials.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    m.materials[i] = choice.pattern.empty() ? choice.slots.at(m.materials[i])
                                            : choice.pattern[i % choice.pattern.size()];
  // An empty vector says "all 0" in no memory.
  if (std::all_of(m.materials.begin(), m.materials.end(), [](auto i) { return i == 0; }))
    m.materials = {};
}

}  // namespace

std::uint32_t default_material(scene& s, const name_table& materials) {
  if (const std::uint32_t* index = materials.find("default")) return *index;
  const auto made_up = std::find_if(s.materials.begin(), s.materials.end(),
                                    [](const material& m) { return m.name == "default"; });
  const auto index = std::uint32_t(made_up - s.materials.begin());
  if (made_up == s.materials.end()) s.materials.emplace_back().name = "default";
  return index;
}

void read_meshes(const json_node& node, const fs::path& folder, const name_table& materials,
                 name_table& meshes, scene& s) {
  if (!node.is_object()) node.expected("an object of meshes by their names");
  for (const std::string& name : node.keys()) {
    const json_node entry = node.at(name, "a mesh");
    if (!entry.is_object() || entry.find("file").has_value() == entry.find("generate").has_value())
      entry.expected("an object with either \"file\" or \"generate\"");

    const bool from_file = entry.find("file").has_value();
    mesh_file loaded;
    if (from_file)
      loaded = read_file_mesh(folder, entry);
    else
      loaded.mesh = generate_mesh(entry);
    mesh& m = loaded.mesh;
    if (m.triangle_count() > limits::triangles - s.triangle_count())
      entry.fail("takes the scene to " + std::to_string(m.triangle_count() + s.triangle_count()) +
                 " triangles; at most " + std::to_string(limits::triangles) + " are allowed");

    const std::size_t used =
        m.materials.empty() ? 1 : *std::max_element(m.materials.begin(), m.materials.end()) + 1;
    material_choice choice =
        read_choice(entry, std::max<std::size_t>(used, loaded.materials.size()), materials);
    if (choice.slots.empty() && choice.pattern.empty())
      choice.slots = add_own_materials(std::move(loaded.materials), name, materials, s);
    if (choice.slots.size() < used && choice.pattern.empty())
      choice.slots.resize(used, default_material(s, materials));
    assign(choice, m);

    m.name = name;
    meshes.add(name, std::uint32_t(s.meshes.size()));
    s.notes.insert(s.notes.end(), loaded.notes.begin(), loaded.notes.end());
    s.meshes.push_back(std::move(m));
  }
}

}  // namespace facet
