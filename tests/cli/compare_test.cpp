#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// A float32 array of shape (height, width, 4).
void put_picture(const std::filesystem::path& path, int width, int height,
                 const std::vector<float>& values) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(height) + ", " + std::to_string(width) + ", 4), }";
  header.resize(117, ' ');
  header += '\n';
  std::string file("\x93NUMPY\x01\x00\x76\x00", 10);
  file += header;
  const std::size_t start = file.size();
  file.resize(start + values.size() * 4);
  std::memcpy(file.data() + start, values.data(), values.size() * 4);
  put(path, file);
}

}  // namespace

TEST_CASE("compare prints the errors and where the worst is, and writes them as JSON") {
  const temporary_folder folder;
  put_picture(folder / "a.npy", 2, 1, {0, 0, 0, 1, 0.25f, 0.25f, 0.25f, 1});
  put_picture(folder / "b.npy", 2, 1, {0, 0, 0, 1, 0.25f, 0.75f, 0.25f, 1});
  const outcome o = run({"compare", (folder / "a.npy").string(), (folder / "b.npy").string(),
                         "--json", (folder / "d.json").string()});
  CHECK(o.code == 0);
  CHECK(contains(o.out, "max error            0.5 at (1, 0)"));
  CHECK(contains(o.out, "linear             1 pixels (50.0000%)"));
  const auto json = nlohmann::json::parse(content_of(folder / "d.json"));
  CHECK(json["max"] == 0.5);
  CHECK(json["worst"] == nlohmann::json({1, 0}));
  CHECK(json["pixels_off"] == 1);
  CHECK(json["share_off"] == 0.5);
}

TEST_CASE("equal pictures have no finite PSNR: null in JSON") {
  const temporary_folder folder;
  put_picture(folder / "a.npy", 1, 1, {0.5f, 0.5f, 0.5f, 1});
  const outcome o = run({"compare", (folder / "a.npy").string(), (folder / "a.npy").string(),
                         "--json", (folder / "d.json").string()});
  CHECK(o.code == 0);
  CHECK(contains(o.out, "inf dB"));
  CHECK(nlohmann::json::parse(content_of(folder / "d.json"))["psnr_db"].is_null());
}

TEST_CASE("pictures of different sizes are exit code 3 with both sizes") {
  const temporary_folder folder;
  put_picture(folder / "a.npy", 2, 1, std::vector<float>(8, 0.5f));
  put_picture(folder / "b.npy", 1, 2, std::vector<float>(8, 0.5f));
  const outcome o = run({"compare", (folder / "a.npy").string(), (folder / "b.npy").string()});
  CHECK(o.code == 3);
  CHECK(contains(o.err, "1x2"));
  CHECK(contains(o.err, "2x1"));
}

TEST_CASE("NaN in a picture is exit code 7, after the table") {
  const temporary_folder folder;
  put_picture(folder / "a.npy", 1, 1, {0.5f, 0.5f, 0.5f, 1});
  put_picture(folder / "b.npy", 1, 1, {0.5f, NAN, 0.5f, 1});
  const outcome o = run({"compare", (folder / "a.npy").string(), (folder / "b.npy").string()});
  CHECK(o.code == 7);
  CHECK(contains(o.out, "NaN                  1 pixels"));
}

TEST_CASE("a file that is missing or no picture is exit code 3") {
  const temporary_folder folder;
  put(folder / "text.npy", "no picture");
  CHECK(run({"compare", (folder / "text.npy").string(), (folder / "none.npy").string()}).code == 3);
}
