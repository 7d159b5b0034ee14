#include "scene/read_ply.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#include "scene/mesh_checks.hpp"
#include "scene/scratch_folder.hpp"

using namespace facet;
using namespace facet::test;

namespace {

using numbers = std::vector<std::uint32_t>;
enum class format { ascii, little, big };
constexpr format formats[] = {format::ascii, format::little, format::big};

/// The data of a PLY file, value by value, in any of its formats.
class writer {
 public:
  explicit writer(format f) : format_(f) {}

  template <class T>
  writer& add(T value) {
    if (format_ == format::ascii) {
      text_ += std::to_string(value) + ' ';
      return *this;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    const bool is_little = std::endian::native == std::endian::little;
    if (is_little != (format_ == format::little)) std::reverse(bytes, bytes + sizeof(T));
    text_.append(bytes, sizeof(T));
    return *this;
  }
  writer& end_line() {
    if (format_ == format::ascii) text_ += '\n';
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  format format_;
  std::string text_;
};

std::string header(format f, const std::string& elements) {
  const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  return "ply\nformat " + std::string(names[int(f)]) + " 1.0\ncomment a test\n" + elements +
         "end_header\n";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string corners = "property list uchar int vertex_indices\n";

/// A square as a quad and a triangle, with normals, and much that readers have to pass over.
std::string rich(format f) {
  writer w(f);
  w.add(7).add(2.5).end_line();  // camera
  for (int i = 0; i < 4; ++i) {
    w.add(std::uint8_t(9)).add(double(i % 2)).add(double(i / 2)).add(0.25);
    w.add(std::uint8_t(2)).add(std::int16_t(-1)).add(std::int16_t(5));
    w.add(0.f).add(0.f).add(2.f).end_line();
  }
  w.add(1.5f).add(std::uint8_t(4)).add(0u).add(1u).add(3u).add(2u).add(std::int16_t(0)).end_line();
  w.add(1.5f).add(std::uint8_t(3)).add(1u).add(3u).add(2u).add(std::int16_t(1)).add(4.f).end_line();
  w.add(std::uint8_t(1)).end_line();  // after the faces
  return header(f,
                "element camera 1\nproperty int id\nproperty double focus\n"
                "element vertex 4\nproperty uint8 red\nproperty double x\nproperty float64 y\n"
                "property double z\nproperty list uint8 int16 tags\nproperty float nx\n"
                "property float ny\nproperty float32 nz\n"
                "element nothing 99999999999999\n"
                "element face 2\nproperty float area\nproperty list uchar uint vertex_index\n"
                "property list short float more\n"
                "element after 1\nproperty uchar a\n") +
         w.text();
}

/// The smallest file: one triangle.
std::string triangle(format f, const std::string& vertex_count = "3",
                     const std::string& face_count = "1", int third = 2) {
  writer w(f);
  for (int i = 0; i < 3; ++i) w.add(float(i % 2)).add(float(i / 2)).add(0.f).end_line();
  w.add(std::uint8_t(3)).add(0).add(1).add(third).end_line();
  return header(f, "element vertex " + vertex_count + '\n' + xyz + "element face " + face_count +
                       '\n' + corners) +
         w.text();
}

mesh_file read_text(const std::string& text) {
  const scratch_folder scratch;
  return read_ply(scratch.write("thing.ply", text));
}
scene_error error_of_text(const std::string& text) {
  return error_of([&] { read_text(text); });
}

}  // namespace

TEST_CASE("the three formats of one file give one mesh, past all that is not asked for") {
  for (format f : formats) {
    CAPTURE(int(f));
    const mesh_file file = read_text(rich(f));
    CHECK(broken_promise(file.mesh) == "");
    CHECK(file.mesh.name == "thing");
    CHECK(file.mesh.positions ==
          std::vector<vec3f>{{0, 0, .25f}, {1, 0, .25f}, {0, 1, .25f}, {1, 1, .25f}});
    CHECK(file.mesh.indices == numbers{0, 1, 3, 0, 3, 2, 1, 3, 2});
    CHECK(file.mesh.normal_indices == file.mesh.indices);
    CHECK(file.mesh.normals == std::vector<vec3f>(4, {0, 0, 1}));
    CHECK(file.materials.empty());
    REQUIRE(file.notes.size() == 1);
    CHECK(contains(file.notes[0], "colours of element \"vertex\""));
  }
}

TEST_CASE("a file without normals is flat, and line ends of all kinds are read") {
  const mesh_file file = read_text(triangle(format::ascii));
  CHECK(file.mesh.indices == numbers{0, 1, 2});
  CHECK(!file.mesh.is_smooth());
  CHECK(file.notes.empty());
  for (const char* end : {"\r\n", "\r"}) {
    std::string text;
    for (char c : triangle(format::ascii)) text += c == '\n' ? end : std::string(1, c);
    CHECK(read_text(text).mesh.indices == numbers{0, 1, 2});
  }
  std::string unended = triangle(format::ascii);
  while (unended.back() == '\n' || unended.back() == ' ') unended.pop_back();
  CHECK(read_text(unended).mesh.triangle_count() == 1);
}

TEST_CASE("integers of every width and sign, and doubles, are read as they are") {
  for (format f : formats) {
    writer w(f);
    w.add(std::int8_t(-5)).add(std::uint8_t(250)).add(std::int16_t(-30000)).end_line();
    w.add(std::int8_t(5)).add(std::uint8_t(0)).add(std::int16_t(30000)).end_line();
    w.add(std::int8_t(0)).add(std::uint8_t(1)).add(std::int16_t(0)).end_line();
    w.add(3u).add(std::uint16_t(2)).add(std::uint16_t(0)).add(std::uint16_t(1)).end_line();
    const mesh m = read_text(header(f,
                                    "element vertex 3\nproperty char x\nproperty uchar y\n"
                                    "property short z\nelement face 1\n"
                                    "property list uint ushort vertex_index\n") +
                             w.text())
                       .mesh;
    CHECK(m.positions[0] == vec3f(-5, 250, -30000));
    CHECK(m.positions[1] == vec3f(5, 0, 30000));
    CHECK(m.indices == numbers{2, 0, 1});
  }
}

TEST_CASE("faces may come before the vertices that they name") {
  CHECK(read_text(header(format::ascii, "element face 1\n" + corners + "element vertex 3\n" + xyz) +
                  "3 0 1 2\n0 0 0 1 0 0 0 1 0\n")
            .mesh.indices == numbers{0, 1, 2});
}

TEST_CASE("an index out of range is an error that names the face") {
  for (format f : formats)
    for (int third : {3, -1, 1 << 30}) {
      const scene_error e = error_of_text(triangle(f, "3", "1", third));
      CHECK(e.place() == "face 0");
      CHECK(contains(e.what(), "names vertex " + std::to_string(third) + "; allowed are 0 to 2"));
    }
  CHECK(contains(error_of_text(header(format::ascii,
                                      "element vertex 0\n" + xyz + "element face 1\n" + corners) +
                               "3 0 0 0\n")
                     .what(),
                 "there is none"));
}

TEST_CASE("counts that the file has no room for are refused before anything is allocated") {
  for (format f : formats)
    for (const char* count : {"1000", "4000000000", "18446744073709551615"}) {
      const scene_error vertices = error_of_text(triangle(f, count));
      CHECK((vertices.place() == "element vertex" || vertices.place().starts_with("line")));
      CHECK(error_of_text(triangle(f, "3", count)).place() == "element face");
    }
  CHECK(contains(error_of_text(triangle(format::ascii, "18446744073709551616")).what(),
                 "allowed is a whole number"));
  // The length of one list.
  writer w(format::little);
  for (int i = 0; i < 9; ++i) w.add(0.f);
  w.add(0xffffffffu).add(0);
  const scene_error e = error_of_text(
      header(format::little, "element vertex 3\n" + xyz +
                                 "element face 1\nproperty list uint int vertex_indices\n") +
      w.text());
  CHECK(e.place() == "face 0");
  CHECK(contains(e.what(), "4294967295; the rest of the file has room for at most 1"));
}

TEST_CASE("what is no number is an error that names the element") {
  const std::string start =
      header(format::ascii, "element vertex 3\n" + xyz + "element face 1\n" + corners);
  CHECK(error_of_text(start + "0 0 0\n1 a 0\n0 1 0\n3 0 1 2\n").place() == "vertex 1");
  CHECK(error_of_text(start + "0 0 0\n1 1 0\n0 1 0\n3 0 1.5 2\n").place() == "face 0");
  CHECK(error_of_text(start + "0 0 0\n1 1 0\n0 1 0\n-3 0 1 2\n").place() == "face 0");
  CHECK(error_of_text(start + "0 0 0\n1 1 0\n0 1 0\n3 0 1\n").place() == "face 0");
}

TEST_CASE("triangles with unusable coordinates are dropped, counted, and leave the others' ids") {
  const mesh_file file =
      read_text(header(format::ascii, "element vertex 5\n" + xyz + "element face 4\n" + corners) +
                "0 0 0 1 0 0 1 1 0 0 1 0 nan 0 1e30\n3 0 1 2 4 0 1 2 4 2 0 1 3 0 2 3\n");
  CHECK(file.mesh.indices == numbers{0, 1, 2, 0, 1, 2, 0, 2, 3});
  CHECK(file.mesh.source == numbers{0, 1, 3});
  CHECK(file.mesh.dropped == 1);
  CHECK(broken_promise(file.mesh) == "");
  CHECK(any_holds(file.notes, "1 triangle dropped"));
  CHECK(any_holds(file.notes, "vertex 4"));
  CHECK(any_holds(file.notes, "1 face with fewer than 3 corners"));
}

TEST_CASE("a header that cannot be followed is an error that gives its line") {
  const auto place = [](const std::string& text) { return error_of_text(text).place(); };
  CHECK(place("") == "line 1");
  CHECK(place("plyx\n") == "line 1");
  CHECK(place("ply\n") == "line 1");
  CHECK(place("ply\nformat ascii 2.0\nend_header\n") == "line 2");
  CHECK(place("ply\nformat binary 1.0\nend_header\n") == "line 2");
  CHECK(place("ply\nelement vertex 3\n") == "line 2");
  CHECK(place("ply\nformat ascii 1.0\nproperty float x\nend_header\n") == "line 3");
  const auto place_of = [&](const std::string& elements) {
    return place(header(format::ascii, elements));
  };
  CHECK(place_of("element vertex three\n") == "line 4");
  CHECK(place_of("element vertex -3\n") == "line 4");
  CHECK(place_of("element vertex 3\nproperty flaot x\n") == "line 5");
  CHECK(place_of("element vertex 3\nproperty float\n") == "line 5");
  CHECK(place_of("element vertex 3\n" + xyz + "property float x\n") == "line 8");
  CHECK(place_of("element vertex 3\nelement vertex 3\n") == "line 5");
  CHECK(place_of("element face 3\nproperty list float int vertex_index\n") == "line 5");
  CHECK(place_of("element face 3\nproperty list uchar float vertex_index\n") == "line 5");
  CHECK(place_of("element face 3\nproperty int vertex_index\n") == "line 5");
  CHECK(place_of("elephant\n") == "line 4");
  CHECK(contains(error_of_text(header(format::ascii, "element face 1\n" + corners)).what(),
                 "x, y and z"));
  CHECK(contains(error_of_text(header(format::ascii, "element vertex 3\n" + xyz)).what(),
                 "points alone"));
  CHECK(
      contains(error_of_text(header(format::ascii, "element vertex 3\nproperty flaot x\n")).what(),
               "did you mean \"float\""));
}

TEST_CASE("a file without triangles, and a missing one, are errors with the path") {
  const scene_error e = error_of_text(
      header(format::ascii, "element vertex 0\n" + xyz + "element face 0\n" + corners));
  CHECK(contains(e.what(), "thing.ply: there is no triangle in it"));
  CHECK(contains(error_of([] { read_ply("/no/such/file.ply"); }).what(),
                 "/no/such/file.ply: there is no such file"));
}

TEST_CASE("no truncated or scrambled file crashes the reader or breaks a promise") {
  const scratch_folder scratch;
  const auto path = scratch.path() / "a.ply";
  const auto survives = [&](const std::string& variant) {
    scratch.write("a.ply", variant);
    try {
      return broken_promise(read_ply(path).mesh).empty();
    } catch (const scene_error&) {
      return true;
    }
  };
  std::uint32_t state = 1;
  const auto random = [&state](std::size_t n) {
    state = state * 1664525u + 1013904223u;
    return std::size_t(state >> 8) % n;
  };
  int broken = 0;
  for (format f : formats) {
    const std::string text = rich(f);
    for (std::size_t size = 0; size < text.size(); ++size)
      broken += !survives(text.substr(0, size));
    for (int i = 0; i < 300; ++i) {
      std::string variant = text;
      for (int k = 0; k < 2; ++k)
        variant[random(text.size())] = i % 2 ? char(random(256)) : "0123456789 -\n"[random(13)];
      broken += !survives(variant);
    }
    // All of the data but the last element's is needed.
    CHECK(error_of_text(text.substr(0, text.size() - 12)).place() != "");
  }
  CHECK(broken == 0);
}
