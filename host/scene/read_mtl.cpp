#include "scene/read_mtl.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "scene/scene.hpp"
#include "scene/text_file.hpp"

namespace facet {
namespace {

constexpr vec3f black{0, 0, 0}, white{1, 1, 1};

/// What a file says about one material, as it says it.
struct statements {
  std::string name;
  std::optional<vec3f> Ke, Ka, Kd, Ks, Tf;
  std::optional<float> Ns, Ni, d, Tr;
  int illum = 2;
  bool has_texture = false;  ///< map_Kd
};

/// The reading of it; read_mtl.hpp gives the rules.
material material_of(const statements& s) {
  material m;
  m.name = s.name;
  m.Ke = s.Ke.value_or(black);
  m.Ka = s.Ka.value_or(black);
  m.Ks = s.Ks.value_or(black);
  if (s.Ns) m.Ns = *s.Ns;
  const float d = s.d ? *s.d : s.Tr ? 1 - *s.Tr : 1;
  const bool states_colour = s.Ke || s.Ka || s.Kd || s.Ks || s.Tf || s.d || s.Tr;
  const bool wants_texture = s.has_texture && s.Kd.value_or(black) == black;
  if (states_colour && !wants_texture) m.Kd = s.Kd.value_or(black);
  m.Ka = m.Ka * d;
  m.Kd = m.Kd * d;

  if (s.illum == 3 || s.illum == 5 || s.illum == 8) m.Kr = min(m.Ks, white);

  const bool glass = s.illum == 4 || s.illum == 6 || s.illum == 7 || s.illum == 9;
  const bool tinted = s.Tf && *s.Tf != white;
  const float Ni = s.Ni.value_or(1.0f);
  if (glass && d == 1 && !tinted) {
    const bool filler = s.Tf && Ni == 1;
    if (!filler) m.Kt = white;
  } else if (glass || d < 1) {
    m.Kt = tinted ? *s.Tf : vec3f(1 - d, 1 - d, 1 - d);
  }
  if (glass) {
    m.Ni = Ni;
  } else if (m.is_transparent()) {
    m.has_attenuation = true;
    m.attenuation = white;
  }
  return m;
}

class mtl_reader {
 public:
  mtl_reader(const std::filesystem::path& path, std::vector<std::string>& notes)
      : path_(path), text_(read_whole_file(path)), notes_(notes) {}

  std::vector<material> read() {
    for (std::string_view rest(text_); !rest.empty();) {
      ++line_;
      std::string_view words = take_line(rest);
      const std::string keyword(take_word(words));
      if (keyword.empty() || keyword.front() == '#') continue;
      if (keyword == "newmtl")
        begin_material(std::string(trimmed(words)));
      else if (materials_.empty())
        remark(in_quotes(keyword) + " before the first newmtl: ignored");
      else
        read_statement(keyword, words.substr(0, words.find('#')));
    }
    for (const auto& [what, where] : remarks_)
      notes_.push_back(path_.filename().string() + ": line " + std::to_string(where.line) + ": " +
                       what + (where.more ? " (and " + std::to_string(where.more) + " more)" : ""));
    std::vector<material> result;
    result.reserve(materials_.size());
    for (const statements& s : materials_) result.push_back(material_of(s));
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw scene_error(path_.string(), "line " + std::to_string(line_), what);
  }

  /// A note of which the first place and the number are given, however often it occurs.
  void remark(const std::string& what) {
    const auto [found, fresh] = remarks_.try_emplace(what, occurrence{line_, 0});
    if (!fresh) ++found->second.more;
  }

  void begin_material(const std::string& name) {
    if (name.empty()) fail("newmtl without a name");
    const auto [found, fresh] = index_.try_emplace(name, materials_.size());
    if (fresh) {
      if (materials_.size() == limits::materials)
        fail("there are more than " + std::to_string(limits::materials) +
             " materials, which is all that a scene may have");
      materials_.emplace_back();
    } else {
      remark("newmtl " + in_quotes(name) + " again: what follows replaces what was said before");
    }
    current_ = found->second;
    materials_[current_] = statements();
    materials_[current_].name = name;
  }

  void read_statement(const std::string& keyword, std::string_view words) {
    statements& s = materials_[current_];
    if (keyword == "Ke")
      s.Ke = colour(keyword, words, INFINITY);
    else if (keyword == "Ka")
      s.Ka = colour(keyword, words, INFINITY);
    else if (keyword == "Kd")
      s.Kd = colour(keyword, words, INFINITY);
    else if (keyword == "Ks")
      s.Ks = colour(keyword, words, INFINITY);
    else if (keyword == "Tf")
      s.Tf = colour(keyword, words, 1);
    else if (keyword == "Ns")
      s.Ns = clamped(keyword, number(keyword, take_word(words)), INFINITY);
    else if (keyword == "Ni")
      s.Ni = refraction(number(keyword, take_word(words)));
    else if (keyword == "d" || keyword == "Tr")
      (keyword == "d" ? s.d : s.Tr) = dissolve(keyword, words);
    else if (keyword == "illum")
      s.illum = illumination(number(keyword, take_word(words)));
    else
      ignore(keyword);
    if (keyword == "map_Kd") s.has_texture = true;
  }

  float number(const std::string& keyword, std::string_view word) const {
    const std::optional<double> value = number_of(word);
    if (!value || !std::isfinite(float(*value)))
      fail(keyword + ": found " + in_quotes(word) + " where a finite number belongs");
    return float(*value);
  }

  float clamped(const std::string& keyword, float value, float most) {
    if (value < 0) remark(keyword + " below 0: taken as 0");
    if (value > most) remark(keyword + " above 1: taken as 1");
    return std::clamp(value, 0.0f, most);
  }

  std::optional<vec3f> colour(const std::string& keyword, std::string_view words, float most) {
    const std::string_view first = take_word(words);
    if (first == "spectral" || first == "xyz") {
      remark(keyword + ' ' + std::string(first) + " is not offered, only RGB: ignored");
      return std::nullopt;
    }
    vec3f c;
    c.x = c.y = c.z = clamped(keyword, number(keyword, first), most);
    if (trimmed(words).empty()) return c;
    c.y = clamped(keyword, number(keyword, take_word(words)), most);
    c.z = clamped(keyword, number(keyword, take_word(words)), most);
    return c;
  }

  std::optional<float> dissolve(const std::string& keyword, std::string_view words) {
    std::string_view word = take_word(words);
    if (word == "-halo") {
      remark("d -halo is not offered: taken without -halo");
      word = take_word(words);
    }
    return clamped(keyword, number(keyword, word), 1);
  }

  float refraction(float value) {
    if (value > 0) return value;
    remark("Ni not above 0: taken as 1");
    return 1;
  }

  int illumination(float value) {
    if (value >= 0 && value <= 10 && value == std::floor(value)) return int(value);
    remark("illum is no whole number from 0 to 10: taken as 2");
    return 2;
  }

  void ignore(const std::string& keyword) {
    const char* const textures[] = {"bump", "disp", "decal", "refl", "norm"};
    const bool texture =
        keyword.starts_with("map_") ||
        std::any_of(std::begin(textures), std::end(textures), [&](auto t) { return keyword == t; });
    remark(in_quotes(keyword) + (texture ? " is a texture; textures are not offered: ignored"
                                         : " is not offered: ignored"));
  }

  struct occurrence {
    std::size_t line, more;
  };

  std::filesystem::path path_;
  std::string text_;
  std::vector<std::string>& notes_;
  std::size_t line_ = 0;
  std::vector<statements> materials_;
  std::map<std::string, std::size_t> index_;
  std::size_t current_ = 0;
  std::map<std::string, occurrence> remarks_;
};

}  // namespace

std::vector<material> read_mtl(const std::filesystem::path& path, std::vector<std::string>& notes) {
  return mtl_reader(path, notes).read();
}

}  // namespace facet
