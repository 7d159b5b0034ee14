#include "image/npy.hpp"

#include <bit>
#include <cctype>
#include <fstream>
#include <limits>

#include "image/output.hpp"
#include "scene/error.hpp"
#include "scene/scene.hpp"

namespace facet::image {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little,
              "arrays go from memory to file as they are");

constexpr std::string_view magic = "\x93NUMPY";

std::string in_quotes(std::string_view text) { return std::string("\"").append(text) + "\""; }

std::string shape_text(const std::vector<std::uint64_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i)
    text.append(i ? ", " : "").append(std::to_string(shape[i]));
  return text + (shape.size() == 1 ? ",)" : ")");
}

/// Reads the header's Python dictionary: three known keys, in any order.
class header_reader {
 public:
  header_reader(const fs::path& path, std::string_view text) : path_(path), text_(text) {}

  std::vector<std::uint64_t> shape_of_floats() {
    bool has_type = false, has_order = false, has_shape = false;
    std::vector<std::uint64_t> shape;
    expect('{');
    while (!accept('}')) {
      const std::string key = word();
      expect(':');
      if (key == "descr") {
        if (peek() == '[') fail("holds a structured array; float32 ('<f4') is allowed");
        const std::string type = word();
        if (type != "<f4")
          fail("holds values of type " + in_quotes(type) + "; float32 ('<f4') is allowed");
        has_type = true;
      } else if (key == "fortran_order") {
        if (accept_text("True"))
          fail("is in Fortran order; save it in C order (numpy.ascontiguousarray)");
        if (!accept_text("False")) malformed();
        has_order = true;
      } else if (key == "shape") {
        shape = tuple();
        has_shape = true;
      } else {
        fail("its header has the unknown key " + in_quotes(key));
      }
      if (!accept(',') && peek() != '}') malformed();
    }
    if (!has_type || !has_order || !has_shape) malformed();
    return shape;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw scene_error(path_.string(), "", what);
  }
  [[noreturn]] void malformed() const {
    fail("its header is damaged at byte " + std::to_string(at_) +
         "; it should read like {'descr': '<f4', 'fortran_order': False, 'shape': (3, 8), }");
  }
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) malformed();
  }
  bool accept_text(std::string_view expected) {
    peek();
    if (text_.substr(at_, expected.size()) != expected) return false;
    at_ += expected.size();
    return true;
  }
  std::string word() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') malformed();
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) malformed();
    std::string result(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return result;
  }
  std::vector<std::uint64_t> tuple() {
    std::vector<std::uint64_t> numbers;
    expect('(');
    while (!accept(')')) {
      if (!std::isdigit(static_cast<unsigned char>(peek()))) malformed();
      std::uint64_t n = 0;
      for (; at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])); ++at_) {
        const auto digit = std::uint64_t(text_[at_] - '0');
        if (n > (std::numeric_limits<std::uint64_t>::max() - digit) / 10) malformed();
        n = n * 10 + digit;
      }
      numbers.push_back(n);
      if (!accept(',') && peek() != ')') malformed();
    }
    return numbers;
  }

  const fs::path& path_;
  std::string_view text_;
  std::size_t at_ = 0;
};

void write(const fs::path& path, const std::string& type, const std::vector<std::uint64_t>& shape,
           std::span<const std::byte> values) {
  std::string header =
      "{'descr': " + type + ", 'fortran_order': False, 'shape': " + shape_text(shape) + ", }";
  // The values start at a multiple of 64 bytes, for those who map the file.
  constexpr std::size_t before = magic.size() + 4;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string start(magic);
  start += {'\x01', '\x00', char(header.size() & 0xff), char(header.size() >> 8)};
  start += header;

  output_file file(path);
  file.write(start.data(), start.size());
  file.write(values.data(), values.size());
  file.commit();
}

}  // namespace

float_array read_npy(const fs::path& path) {
  const auto fail = [&](const std::string& what) -> void {
    throw scene_error(path.string(), "", what);
  };
  std::error_code error;
  if (!fs::exists(path, error)) fail("there is no such file");
  if (fs::is_directory(path, error)) fail("is a folder, not a .npy file");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) fail("cannot be read");
  const auto size = std::uint64_t(in.tellg());
  in.seekg(0);

  unsigned char start[12] = {};
  in.read(reinterpret_cast<char*>(start), 8);
  if (!in || std::string_view(reinterpret_cast<char*>(start), magic.size()) != magic)
    fail("is not a .npy file: it does not begin with \\x93NUMPY");
  const int version = start[6];
  if (version < 1 || version > 3)
    fail("is of .npy version " + std::to_string(version) + "; 1 to 3 are allowed");
  const int length_bytes = version == 1 ? 2 : 4;
  in.read(reinterpret_cast<char*>(start + 8), length_bytes);
  std::uint64_t length = 0;
  for (int i = 0; i < length_bytes; ++i) length |= std::uint64_t(start[8 + i]) << (8 * i);
  const std::uint64_t offset = 8 + std::uint64_t(length_bytes) + length;
  if (!in || offset > size) fail("ends within its header");
  if (length > 1u << 20) fail("its header is too long: " + std::to_string(length) + " bytes");
  std::string header(length, '\0');
  in.read(header.data(), std::streamsize(length));

  float_array array;
  array.shape = header_reader(path, header).shape_of_floats();
  std::uint64_t count = 1;
  for (const std::uint64_t side : array.shape) {
    if (side != 0 && count > (std::uint64_t(1) << 60) / side)
      fail("its shape " + shape_text(array.shape) + " is too large");
    count *= side;
  }
  if (size - offset != count * sizeof(float))
    fail("its shape " + shape_text(array.shape) + " needs " +
         std::to_string(count * sizeof(float)) + " bytes of values, found " +
         std::to_string(size - offset));
  array.values.resize(count);
  in.read(reinterpret_cast<char*>(array.values.data()), std::streamsize(count * sizeof(float)));
  if (!in) fail("cannot be read to its end");
  return array;
}

std::vector<float> read_npy_rows(const fs::path& path, std::uint64_t columns) {
  float_array array = read_npy(path);
  if (array.shape.size() != 2 || array.shape[1] != columns)
    throw scene_error(path.string(), "",
                      "holds an array of shape " + shape_text(array.shape) + "; (N, " +
                          std::to_string(columns) + ") is allowed");
  return std::move(array.values);
}

picture read_npy_picture(const fs::path& path) {
  float_array array = read_npy(path);
  const auto side = [&](std::size_t axis) {
    return array.shape[axis] >= 1 && array.shape[axis] <= limits::image_side;
  };
  if (array.shape.size() != 3 || array.shape[2] != 4 || !side(0) || !side(1))
    throw scene_error(path.string(), "",
                      "holds an array of shape " + shape_text(array.shape) +
                          "; a picture is (height, width, 4), with sides from 1 to " +
                          std::to_string(limits::image_side));
  picture p;
  p.height = std::uint32_t(array.shape[0]), p.width = std::uint32_t(array.shape[1]);
  p.rgba = std::move(array.values);
  return p;
}

void write_npy(const fs::path& path, const std::vector<npy_field>& fields, std::uint64_t count,
               std::span<const std::byte> records) {
  std::string type = "[";
  for (const npy_field& f : fields)
    type += (type.size() > 1 ? ", ('" : "('") + f.name + "', '" + f.type + "')";
  write(path, type + "]", {count}, records);
}

void write_npy(const fs::path& path, const picture& p) {
  write(path, "'<f4'", {p.height, p.width, 4}, std::as_bytes(std::span(p.rgba)));
}

}  // namespace facet::image
