#include "scene/read_obj.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <map>
#include <set>

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "scene/obj_text.hpp"
#include "scene/read_mtl.hpp"
#include "scene/scene.hpp"

namespace facet {
namespace {

namespace fs = std::filesystem;

/// tinyobj::LoadObjWithCallback splits the file into statements and calls back on each. The text of
/// the statement is looked at again where the library keeps silent: it reads a coordinate that is
/// not a number as 0, wraps large indices, and checks none.
class obj_reader : public tinyobj::MaterialReader {
 public:
  explicit obj_reader(const fs::path& path)
      : path_(path), text_(read_whole_file(path)), builder_(path) {}

  mesh_file read() {
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = [](void* self, float, float, float, float) { of(self).add_position(); };
    callbacks.normal_cb = [](void* self, float, float, float) {
      of(self).builder_.normals.push_back(of(self).three_numbers());
    };
    callbacks.index_cb = [](void* self, tinyobj::index_t* corners, int count) {
      of(self).add_face(std::span(corners, std::size_t(count)));
    };
    callbacks.usemtl_cb = [](void* self, const char* name, int) {
      of(self).material_ = of(self).material_named(std::string(trimmed(name)));
    };
    std::istream stream(&text_);
    tinyobj::LoadObjWithCallback(stream, callbacks, this, this);
    check_greatest(position_list_, builder_.positions.size());
    check_greatest(normal_list_, builder_.normals.size());

    mesh_file result = builder_.finish(first_unusable_);
    note_undefined_materials();
    result.materials = std::move(materials_);
    result.notes.insert(result.notes.begin(), notes_.begin(), notes_.end());
    return result;
  }

 private:
  /// Indices into one of the file's lists. A face may name what only follows it: the greatest index
  /// is checked at the end.
  struct index_list {
    const char* name;
    std::uint32_t greatest = 0;  // counted from 1
    std::size_t offset = 0;      // of the end of the line that holds it
  };

  static obj_reader& of(void* self) { return *static_cast<obj_reader*>(self); }

  [[noreturn]] void fail(std::size_t offset, const std::string& what) const {
    throw scene_error(path_.string(), text_.line_name(offset), what);
  }
  [[noreturn]] void fail_index(const index_list& list, std::size_t offset, std::int64_t found,
                               std::size_t count) const {
    const std::string n = std::to_string(count);
    fail(offset, "a face names " + std::string(list.name) + ' ' + std::to_string(found) +
                     (count ? "; allowed are 1 to " + n + ", or -" + n +
                                  " to -1 to count back from the face"
                            : "; there is none"));
  }
  void note(const std::string& what) { notes_.push_back(path_.filename().string() + ": " + what); }

  /// The three numbers of a v or vn statement; NaN for what is missing or not a number.
  vec3f three_numbers() const {
    std::string_view words = text_.line();
    take_word(words);
    vec3f result;
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = float(number_of(take_word(words)).value_or(NAN));
    return result;
  }

  void add_position() {
    const vec3f p = three_numbers();
    if (!mesh_builder::is_usable(p) && first_unusable_.empty())
      first_unusable_ = text_.line_name(text_.offset()) + ", " + in_quotes(trimmed(text_.line()));
    builder_.positions.push_back(p);
  }

  void add_face(std::span<const tinyobj::index_t> corners) {
    check_digits();
    corners_.clear();
    for (const tinyobj::index_t& c : corners.first(std::min(corners.size(), corners_in_line()))) {
      mesh_builder::corner corner;
      corner.position = resolve(position_list_, c.vertex_index, builder_.positions.size());
      if (c.normal_index != 0)
        corner.normal = resolve(normal_list_, c.normal_index, builder_.normals.size());
      corners_.push_back(corner);
    }
    if (material_ == none) material_ = material_named("");
    if (!builder_.add_face(corners_, material_)) fail(text_.offset(), mesh_builder::too_many());
  }

  std::uint32_t resolve(index_list& list, int found, std::size_t so_far) const {
    if (found == 0 || found < -std::int64_t(so_far))
      fail_index(list, text_.offset(), found, so_far);
    if (found < 0) return std::uint32_t(std::int64_t(so_far) + found);
    if (std::uint32_t(found) > list.greatest)
      list.greatest = std::uint32_t(found), list.offset = text_.offset();
    return std::uint32_t(found) - 1;
  }

  void check_greatest(const index_list& list, std::size_t count) const {
    if (list.greatest > count) fail_index(list, list.offset, list.greatest, count);
  }

  void check_digits() const {
    std::size_t digits = 0;
    for (char c : text_.line()) {
      digits = c >= '0' && c <= '9' ? digits + 1 : 0;
      if (digits > 9) fail(text_.offset(), "a face holds an index of more than 9 digits");
    }
  }

  /// How many corners stand before a comment, which tinyobj takes for more of them.
  std::size_t corners_in_line() const {
    const std::size_t comment = text_.line().find('#');
    if (comment == std::string_view::npos) return std::size_t(-1);
    std::string_view words = text_.line().substr(0, comment);
    take_word(words);
    std::size_t count = 0;
    while (!take_word(words).empty()) ++count;
    return count;
  }

  /// Its index, with a default material in its place until an mtllib defines it.
  std::uint32_t material_named(const std::string& name) {
    const auto [found, fresh] = material_index_.try_emplace(name, materials_.size());
    if (fresh) {
      if (materials_.size() == limits::materials)
        fail(text_.offset(), "there are more than " + std::to_string(limits::materials) +
                                 " materials, which is all that a scene may have");
      undefined_.insert(name);
      materials_.emplace_back().name = name.empty() ? "default" : name;
    }
    return found->second;
  }

  void note_undefined_materials() {
    std::vector<std::string> known;
    for (const auto& [name, index] : material_index_)
      if (!undefined_.count(name)) known.push_back(name);
    for (const std::string& name : undefined_)
      if (!name.empty())
        note("usemtl: " + unknown_name("material", name, known) + "; a default one stands for it");
    if (!undefined_.count("")) return;
    if (materials_.size() == 1)
      materials_.clear();  // the file has no materials at all
    else
      note("faces before the first usemtl have a default material");
  }

  // tinyobj calls this for each word of an mtllib statement. A name may hold blanks, so that the
  // statement's text decides, once. `false` keeps tinyobj from reading materials itself.
  bool operator()(const std::string&, std::vector<tinyobj::material_t>*,
                  std::map<std::string, int>*, std::string*, std::string*) override {
    if (text_.offset() == last_library_) return false;
    last_library_ = text_.offset();
    std::string_view names = text_.line();
    take_word(names);
    names = trimmed(names);
    if (is_file(folder() / names)) {
      read_library(std::string(names));
    } else {
      while (!names.empty()) read_library(std::string(take_word(names)));
    }
    return false;
  }

  fs::path folder() const { return path_.has_parent_path() ? path_.parent_path() : fs::path("."); }

  static bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
  }

  bool lies_in_folder(const fs::path& file) const {
    const fs::path relative =
        fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder()));
    return !relative.empty() && *relative.begin() != "..";
  }

  void read_library(std::string name) {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path file = folder() / name;
    if (!libraries_.insert(file).second) return;
    if (!lies_in_folder(file))
      return note("mtllib " + in_quotes(name) +
                  " lies outside of the file's folder: it is not read");
    if (!is_file(file)) return note("mtllib " + in_quotes(name) + " is not there");
    for (material& m : read_mtl(file, notes_)) {
      const std::uint32_t index = material_named(m.name);
      undefined_.erase(m.name);
      materials_[index] = std::move(m);
    }
  }

  static constexpr std::uint32_t none = 0xffffffffu;

  fs::path path_;
  obj_text text_;
  mesh_builder builder_;
  std::string first_unusable_;
  index_list position_list_{"vertex"}, normal_list_{"normal"};
  std::vector<mesh_builder::corner> corners_;
  std::vector<std::string> notes_;

  std::vector<material> materials_;
  std::map<std::string, std::uint32_t> material_index_;
  std::set<std::string> undefined_;  // names in use that no mtllib has defined so far
  std::uint32_t material_ = none;    // of the faces that follow
  std::set<fs::path> libraries_;
  std::size_t last_library_ = std::size_t(-1);
};

}  // namespace

mesh_file read_obj(const fs::path& path) { return obj_reader(path).read(); }

}  // namespace facet
