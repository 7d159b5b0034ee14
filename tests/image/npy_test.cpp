#include "image/npy.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>

#include "image/output.hpp"
#include "image/temporary_folder.hpp"
#include "scene/error.hpp"

using namespace facet;
using test::content_of;
using test::put;
using test::temporary_folder;

namespace {

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes(values.size() * 4, '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A file as numpy.save writes it: the header padded with spaces to a multiple of 64.
std::string npy(int version, const std::string& dictionary, const std::vector<float>& values) {
  std::string header = dictionary;
  while ((header.size() + 1 + (version == 1 ? 10 : 12)) % 64 != 0) header += ' ';
  header += '\n';
  std::string file = "\x93NUMPY";
  file += {char(version), '\0', char(header.size() & 255), char(header.size() >> 8)};
  if (version > 1) file += std::string(2, '\0');
  return file + header + bytes_of(values);
}

std::string dictionary(const std::string& type, const std::string& order,
                       const std::string& shape) {
  return "{'descr': " + type + ", 'fortran_order': " + order + ", 'shape': " + shape + ", }";
}

/// What read_npy_rows says of a file with this content; "" if it reads it.
std::string complaint(const std::string& content) {
  const temporary_folder folder;
  put(folder / "rays.npy", content);
  try {
    image::read_npy_rows(folder / "rays.npy", 8);
  } catch (const scene_error& e) {
    CHECK(e.file() == (folder / "rays.npy").string());
    return e.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::vector<float> two_rows{0, 1, 2,  3,  4,  5,  6,  std::numeric_limits<float>::infinity(),
                                  8, 9, 10, 11, 12, 13, 14, -0.0f};

}  // namespace

TEST_CASE("versions 1, 2 and 3 are read") {
  const temporary_folder folder;
  for (const int version : {1, 2, 3}) {
    put(folder / "a.npy", npy(version, dictionary("'<f4'", "False", "(2, 8)"), two_rows));
    CHECK(image::read_npy_rows(folder / "a.npy", 8) == two_rows);
  }
}

TEST_CASE("the header may be spelled otherwise: order of keys, double quotes, no spaces") {
  CHECK(complaint(
            npy(1, "{\"shape\":(2,8),\"fortran_order\":False,\"descr\":\"<f4\"}", two_rows)) == "");
}

TEST_CASE("no rows at all are an array, too") {
  CHECK(complaint(npy(1, dictionary("'<f4'", "False", "(0, 8)"), {})) == "");
}

TEST_CASE("what is not a float32 array of rows is refused with what was found") {
  const auto with = [](const std::string& type, const std::string& order,
                       const std::string& shape) {
    return complaint(npy(1, dictionary(type, order, shape), two_rows));
  };
  CHECK(contains(with("'<f8'", "False", "(2, 8)"), "values of type \"<f8\"; float32"));
  CHECK(contains(with("'>f4'", "False", "(2, 8)"), "\">f4\""));
  CHECK(contains(with("[('a', '<f4')]", "False", "(16,)"), "structured"));
  CHECK(contains(with("'<f4'", "True", "(2, 8)"), "Fortran order"));
  CHECK(contains(with("'<f4'", "False", "(16,)"), "shape (16,); (N, 8) is allowed"));
  CHECK(contains(with("'<f4'", "False", "(4, 4)"), "shape (4, 4)"));
  CHECK(contains(with("'<f4'", "False", "(1, 2, 8)"), "shape (1, 2, 8)"));
  CHECK(contains(with("'<f4'", "False", "(3, 8)"), "needs 96 bytes of values, found 64"));
  CHECK(contains(with("'<f4'", "False", "(1, 8)"), "needs 32 bytes of values, found 64"));
  CHECK(contains(with("'<f4'", "Perhaps", "(2, 8)"), "header is damaged"));
  CHECK(contains(with("'<f4'", "False", "(-2, 8)"), "header is damaged"));
  CHECK(contains(with("'<f4'", "False", "(99999999999999999999999, 8)"), "header is damaged"));
  CHECK(contains(with("'<f4'", "False", "(1152921504606846976, 8)"), "too large"));
  CHECK(contains(complaint(npy(1, "{'descr': '<f4', 'colour': 3}", {})), "unknown key \"colour\""));
  CHECK(contains(complaint(npy(1, "{'descr': '<f4'}", {})), "header is damaged"));
  CHECK(contains(complaint(npy(7, dictionary("'<f4'", "False", "(2, 8)"), two_rows)),
                 "version 7; 1 to 3 are allowed"));
}

TEST_CASE("other files, folders and missing files are told apart") {
  CHECK(contains(complaint("v 1 2 3\nv 4 5 6\n"), "is not a .npy file"));
  CHECK(contains(complaint(""), "is not a .npy file"));
  const temporary_folder folder;
  CHECK_THROWS_WITH_AS(image::read_npy(folder / "no.npy"),
                       ((folder / "no.npy").string() + ": there is no such file").c_str(),
                       scene_error);
  CHECK_THROWS_AS(image::read_npy(folder.path()), scene_error);
}

TEST_CASE("a file cut at any byte is an error") {
  const std::string whole = npy(1, dictionary("'<f4'", "False", "(2, 8)"), two_rows);
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK(complaint(whole.substr(0, size)) != "");
}

TEST_CASE("a header whose bytes are damaged never crashes the reader") {
  const std::string whole = npy(2, dictionary("'<f4'", "False", "(2, 8)"), two_rows);
  int refused = 0;
  for (std::size_t at = 0; at < 80; ++at)
    for (const char c : {'\0', '\xff', '(', '\'', '9'}) {
      std::string damaged = whole;
      damaged[at] = c;
      refused += complaint(damaged) != "";
    }
  CHECK(refused > 250);  // of 400; the rest change padding or write what was there
}

TEST_CASE("a picture comes back bit for bit, and its values begin at a multiple of 64 bytes") {
  const temporary_folder folder;
  picture p(3, 2);
  for (std::size_t i = 0; i < p.rgba.size(); ++i) p.rgba[i] = float(i) * 1e6f - 3;
  image::write_npy(folder / "p.npy", p);
  const picture q = image::read_npy_picture(folder / "p.npy");
  CHECK(q.width == 3);
  CHECK(q.height == 2);
  CHECK(q.rgba == p.rgba);
  const std::string file = content_of(folder / "p.npy");
  CHECK((file.size() - p.rgba.size() * 4) % 64 == 0);
  CHECK(contains(file, "'shape': (2, 3, 4)"));
  CHECK_THROWS_AS(image::read_npy_rows(folder / "p.npy", 8), scene_error);
}

TEST_CASE("an array of rows is not a picture") {
  const temporary_folder folder;
  put(folder / "rays.npy", npy(1, dictionary("'<f4'", "False", "(2, 8)"), two_rows));
  CHECK_THROWS_AS(image::read_npy_picture(folder / "rays.npy"), scene_error);
}

TEST_CASE("structures are written with the names and types of their fields") {
  const temporary_folder folder;
  struct record {
    float t;
    std::uint32_t id;
  };
  const std::vector<record> records{{1.5f, 7}, {2.5f, 0xffffffffu}};
  image::write_npy(folder / "r.npy", {{"t", "<f4"}, {"id", "<u4"}}, 2,
                   std::as_bytes(std::span(records)));
  const std::string file = content_of(folder / "r.npy");
  CHECK(contains(file,
                 "{'descr': [('t', '<f4'), ('id', '<u4')], 'fortran_order': False, "
                 "'shape': (2,), }"));
  CHECK(file.size() % 64 == 16);
  CHECK(std::memcmp(file.data() + file.size() - 16, records.data(), 16) == 0);
}

TEST_CASE("a file that cannot be made is an output error") {
  CHECK_THROWS_AS(image::write_npy("/dev/full", picture(2, 2)), image::output_error);
}
