#include "scene/read_ply.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "scene/ply_header.hpp"
#include "scene/text_file.hpp"

namespace facet {
namespace {

/// What is wrong with the element at hand; its reader adds where that is.
struct data_error {
  std::string what;
};

constexpr const char* truncated = "the file ends before its data does";

class ascii_source {
 public:
  explicit ascii_source(std::string_view data) : data_(data) {}

  double next(ply_scalar) {
    const std::string_view word = take_word(data_);
    if (word.empty()) throw data_error{truncated};
    const std::optional<double> value = number_of(word);
    if (!value) throw data_error{"found " + in_quotes(word) + " where a number belongs"};
    return *value;
  }

  /// The most elements with that many values each that the rest of the data can hold.
  std::size_t room_for(const ply_element& e) const {
    return (data_.size() + 1) / (2 * e.properties.size());
  }
  std::size_t room_for(ply_scalar) const { return (data_.size() + 1) / 2; }

 private:
  std::string_view data_;
};

template <std::endian order>
class binary_source {
 public:
  explicit binary_source(std::string_view data) : data_(data) {}

  double next(ply_scalar type) {
    switch (type) {
      case ply_scalar::int8:
        return take<std::int8_t>();
      case ply_scalar::uint8:
        return take<std::uint8_t>();
      case ply_scalar::int16:
        return take<std::int16_t>();
      case ply_scalar::uint16:
        return take<std::uint16_t>();
      case ply_scalar::int32:
        return take<std::int32_t>();
      case ply_scalar::uint32:
        return take<std::uint32_t>();
      case ply_scalar::float32:
        return double(take<float>());
      case ply_scalar::float64:
        return take<double>();
    }
    throw data_error{"a type that the format does not have"};
  }

  std::size_t room_for(const ply_element& e) const {
    std::size_t size = 0;
    for (const ply_property& p : e.properties) size += size_of(p.is_list ? p.count_type : p.type);
    return data_.size() / size;
  }
  std::size_t room_for(ply_scalar type) const { return data_.size() / size_of(type); }

 private:
  template <class T>
  T take() {
    if (data_.size() < sizeof(T)) throw data_error{truncated};
    char bytes[sizeof(T)];
    std::memcpy(bytes, data_.data(), sizeof(T));
    if constexpr (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
    data_.remove_prefix(sizeof(T));
    return std::bit_cast<T>(bytes);
  }

  std::string_view data_;
};

class ply_reader {
 public:
  ply_reader(const std::filesystem::path& path, const ply_header& header)
      : path_(path), header_(header), builder_(path) {
    for (const ply_element& e : header.elements)
      if (e.name == "vertex") vertices_ = e.count;
  }

  template <class Source>
  mesh_file read(Source source) {
    for (const ply_element& e : header_.elements) {
      if (e.properties.empty()) continue;  // takes no room, whatever its count
      if (e.count > source.room_for(e))
        throw scene_error(path_.string(), "element " + e.name,
                          "the header promises " + std::to_string(e.count) +
                              "; the rest of the file has room for at most " +
                              std::to_string(source.room_for(e)));
      read_element(source, e);
    }
    return builder_.finish(first_unusable_);
  }

 private:
  template <class Source>
  void read_element(Source& source, const ply_element& e) {
    const bool vertex = e.name == "vertex", face = e.name == "face";
    if (vertex) builder_.positions.reserve(e.count);
    for (std::size_t i = 0; i < e.count; ++i) try {
        if (vertex)
          read_vertex(source, e, i);
        else if (face)
          read_face(source, e);
        else
          skip(source, e.properties);
      } catch (const data_error& error) {
        throw scene_error(path_.string(), e.name + ' ' + std::to_string(i), error.what);
      }
  }

  template <class Source>
  void read_vertex(Source& source, const ply_element& e, std::size_t index) {
    double value[7];  // x, y, z, nx, ny, nz and all others
    for (const ply_property& p : e.properties) {
      if (p.is_list)
        skip(source, std::span(&p, 1));
      else
        value[p.role] = source.next(p.type);
    }
    const vec3f position{vec3d(value[0], value[1], value[2])};
    if (!mesh_builder::is_usable(position) && first_unusable_.empty())
      first_unusable_ = "vertex " + std::to_string(index);
    builder_.positions.push_back(position);
    if (header_.has_normals) builder_.normals.emplace_back(vec3d(value[3], value[4], value[5]));
  }

  template <class Source>
  void read_face(Source& source, const ply_element& e) {
    corners_.clear();
    for (const ply_property& p : e.properties) {
      if (p.role != ply_property::corners) {
        skip(source, std::span(&p, 1));
        continue;
      }
      for (std::size_t n = list_length(source, p); n > 0; --n) {
        const double found = source.next(p.type);
        if (!(found >= 0 && found < double(vertices_) && found == std::floor(found)))
          throw data_error{"it names vertex " + text_of(found) +
                           (vertices_ ? "; allowed are 0 to " + std::to_string(vertices_ - 1)
                                      : "; there is none")};
        const auto i = std::uint32_t(found);
        corners_.push_back({i, header_.has_normals ? i : mesh_builder::none});
      }
    }
    if (!builder_.add_face(corners_, 0)) throw data_error{mesh_builder::too_many()};
  }

  template <class Source>
  std::size_t list_length(Source& source, const ply_property& p) {
    const double found = source.next(p.count_type);
    if (!(found >= 0 && found == std::floor(found)))
      throw data_error{"its list " + in_quotes(p.name) + " has the length " + text_of(found)};
    if (found > double(source.room_for(p.type)))
      throw data_error{"its list " + in_quotes(p.name) + " has the length " + text_of(found) +
                       "; the rest of the file has room for at most " +
                       std::to_string(source.room_for(p.type))};
    return std::size_t(found);
  }

  template <class Source>
  void skip(Source& source, std::span<const ply_property> properties) {
    for (const ply_property& p : properties)
      for (std::size_t n = p.is_list ? list_length(source, p) : 1; n > 0; --n) source.next(p.type);
  }

  std::filesystem::path path_;
  const ply_header& header_;
  mesh_builder builder_;
  std::size_t vertices_ = 0;
  std::string first_unusable_;
  std::vector<mesh_builder::corner> corners_;
};

mesh_file read_data(ply_reader& reader, ply_format format, std::string_view data) {
  switch (format) {
    case ply_format::ascii:
      return reader.read(ascii_source(data));
    case ply_format::little:
      return reader.read(binary_source<std::endian::little>(data));
    case ply_format::big:
      break;
  }
  return reader.read(binary_source<std::endian::big>(data));
}

}  // namespace

mesh_file read_ply(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  const ply_header header = read_ply_header(path, text);
  ply_reader reader(path, header);
  mesh_file result = read_data(reader, header.format, std::string_view(text).substr(header.size));
  result.notes.insert(result.notes.begin(), header.notes.begin(), header.notes.end());
  return result;
}

}  // namespace facet
