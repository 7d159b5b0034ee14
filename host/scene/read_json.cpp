#include "scene/read_json.hpp"

#include <limits>
#include <string>
#include <vector>

#include "scene/framing.hpp"
#include "scene/json_reader.hpp"
#include "scene/name_table.hpp"
#include "scene/place.hpp"
#include "scene/read_json_meshes.hpp"
#include "scene/scene_terms.hpp"
#include "scene/validate.hpp"
#include "scene/world_bounds.hpp"

namespace facet {
namespace {

camera read_camera(const json_node& node) {
  node.check_keys("a camera", scene_keys("camera"));
  camera c;
  if (const auto v = node.find("position")) c.position = v->vector();
  if (const auto v = node.find("look_at")) c.look_at = v->vector();
  if (const auto v = node.find("up")) c.up = v->vector();
  if (const auto v = node.find("vertical_fov")) c.vertical_fov = v->number();
  return c;
}

void read_picture(const json_node& node, scene& s) {
  node.check_keys("a picture", scene_keys("picture"));
  if (const auto v = node.find("width")) s.width = v->whole(1, limits::image_side);
  if (const auto v = node.find("height")) s.height = v->whole(1, limits::image_side);
  if (const auto v = node.find("max_depth")) s.max_depth = v->whole(0, limits::max_depth);
  if (const auto v = node.find("samples")) s.samples = v->whole(1, limits::samples);
}

void read_background(const json_node& node, scene& s) {
  if (!node.is_array() || node.size("") != 4) {
    s.background = node.colour();
    return;
  }
  float* const channels[] = {&s.background.x, &s.background.y, &s.background.z,
                             &s.background_alpha};
  for (std::size_t i = 0; i < 4; ++i) *channels[i] = node.element(i).single();
}

material read_material(const json_node& node) {
  node.check_keys("a material", scene_keys("material"));
  material m;
  if (const auto v = node.find("Ke")) m.Ke = v->colour();
  if (const auto v = node.find("Ka")) m.Ka = v->colour();
  if (const auto v = node.find("Kd")) m.Kd = v->colour();
  if (const auto v = node.find("Ks")) m.Ks = v->colour();
  if (const auto v = node.find("Ns")) m.Ns = v->single();
  if (const auto v = node.find("Kr")) m.Kr = v->colour();
  if (const auto v = node.find("Kt")) m.Kt = v->colour();
  if (const auto v = node.find("Ni")) m.Ni = v->single();
  if (const auto v = node.find("attenuation"))
    m.attenuation = v->colour(), m.has_attenuation = true;
  if (const auto v = node.find("attenuation_distance")) m.attenuation_distance = v->single();
  return m;
}

void read_materials(const json_node& node, name_table& names, scene& s) {
  if (!node.is_object()) node.expected("an object of materials by their names");
  for (const std::string& name : node.keys()) {
    names.add(name, std::uint32_t(s.materials.size()));
    s.materials.push_back(read_material(node.at(name, "a material")));
    s.materials.back().name = name;
  }
}

transform read_matrix(const json_node& node) {
  node.check_keys("a transform by matrix", scene_keys("matrix"));
  const json_node matrix = node.at("matrix", "12 or 16 numbers");
  const std::vector<double> v = matrix.numbers({12, 16}, "12 or 16 numbers, row by row");
  if (v.size() == 16 && !(v[12] == 0 && v[13] == 0 && v[14] == 0 && v[15] == 1))
    matrix.fail("the fourth row must be 0 0 0 1, for the map is affine; or leave it out");
  transform t;
  for (std::size_t i = 0; i < 12; ++i) t.row[i / 4][i % 4] = v[i];
  return t;
}

transform read_step(const json_node& node) {
  node.check_keys("a step of a transform", scene_keys("step"));
  const auto move = node.find("translate"), turn = node.find("rotate"), size = node.find("scale");
  if (int(move.has_value()) + int(turn.has_value()) + int(size.has_value()) != 1)
    node.expected("a step with exactly one of \"translate\", \"rotate\" and \"scale\"");
  if (move) return transform::translate(move->vector());
  if (turn) {
    turn->check_keys("a rotation", scene_keys("rotation"));
    const json_node axis = turn->at("axis", "3 numbers, [x, y, z]");
    const vec3d direction = axis.vector();
    if (direction == vec3d{}) axis.fail("is 0; it must point somewhere, with any length");
    return transform::rotate(direction, turn->at("degrees", "an angle").number());
  }
  if (!size->is_number()) return transform::scale(size->vector());
  const double all = size->number();
  return transform::scale({all, all, all});
}

transform read_transform(const json_node& node) {
  if (node.is_object()) return read_matrix(node);
  const std::size_t n = node.size("an array of steps, or an object with a \"matrix\"");
  transform t;
  for (std::size_t i = 0; i < n; ++i) t = read_step(node.element(i)) * t;
  return t;
}

void read_instances(const json_node& node, const name_table& materials, const name_table& meshes,
                    scene& s) {
  const std::size_t n = node.size("an array of instances");
  if (n > limits::instances)
    node.fail("holds " + std::to_string(n) + " instances; at most " +
              std::to_string(limits::instances) + " are allowed");
  s.instances.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const json_node entry = node.element(i);
    entry.check_keys("an instance", scene_keys("instance"));
    instance placed;
    placed.mesh = meshes.at(entry.at("mesh", "the name of a mesh"));
    if (const auto v = entry.find("material")) placed.material = materials.at(*v);
    if (const auto v = entry.find("transform")) placed.world_from_object = read_transform(*v);
    s.instances.push_back(placed);
  }
  if (n == 0)
    s.notes.emplace_back("the scene has no instances: nothing but its background is seen");
}

light read_light(const json_node& node) {
  if (!node.is_object()) node.expected("a light, which is an object");
  light l;
  const json_node type = node.at("type", "\"point\" or \"directional\"");
  const std::string name = type.text("\"point\" or \"directional\"");
  if (name == "point") {
    node.check_keys("a point light", scene_keys("point_light"));
    l.position = node.at("position", "3 numbers, [x, y, z]").vector();
    if (const auto attenuation = node.find("attenuation")) {
      attenuation->numbers({3}, "3 numbers, [constant, linear, quadratic]");
      l.constant = attenuation->element(0).single();
      l.linear = attenuation->element(1).single();
      l.quadratic = attenuation->element(2).single();
    }
  } else if (name == "directional") {
    node.check_keys("a directional light", scene_keys("directional_light"));
    l.type = light::kind::directional;
    l.direction = node.at("direction", "3 numbers, [x, y, z], the way the light travels").vector();
  } else {
    type.fail(unknown_name("type of light", name, {"point", "directional"}));
  }
  if (const auto v = node.find("colour")) l.colour = v->colour();
  return l;
}

void read_lights(const json_node& node, scene& s) {
  const std::size_t n = node.size("an array of lights");
  if (n > limits::lights)
    node.fail("holds " + std::to_string(n) + " lights; at most " + std::to_string(limits::lights) +
              " are allowed");
  for (std::size_t i = 0; i < n; ++i) s.lights.push_back(read_light(node.element(i)));
}

}  // namespace

scene read_json(const std::filesystem::path& path) {
  const json_document document = read_json_document(path);
  const json_node root(document);
  root.check_keys("a scene", scene_keys("scene"));
  for (const char* key : {"$schema", "about"})
    if (const auto v = root.find(key)) v->text();

  scene s;
  s.name = path.stem().string();
  if (const auto v = root.find("picture")) read_picture(*v, s);
  if (const auto v = root.find("camera")) s.view = read_camera(*v);
  if (const auto v = root.find("ambient")) s.ambient = v->colour();
  if (const auto v = root.find("background")) read_background(*v, s);
  if (const auto v = root.find("nesting")) s.nesting = v->whole(1, limits::nesting);
  if (const auto v = root.find("lights")) read_lights(*v, s);

  name_table materials("material"), meshes("mesh");
  if (const auto v = root.find("materials")) read_materials(*v, materials, s);
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  read_meshes(root.at("meshes", "the meshes by their names"), folder, materials, meshes, s);
  read_instances(root.at("instances", "an array of instances"), materials, meshes, s);
  if (s.materials.empty()) default_material(s, materials);

  if (!root.find("camera")) {
    s.view = camera_that_frames(world_box<double>(s));
    s.notes.emplace_back("the scene has no camera: one was made up that frames it, y up");
  }
  validate(s, document.file);
  return s;
}

}  // namespace facet
