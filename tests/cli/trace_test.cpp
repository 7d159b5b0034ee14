// Rays in, hits out.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

constexpr std::uint32_t miss = 0xffffffffu;

/// A triangle whose file has another before it, which is dropped, and a square after it.
const char* mesh =
    "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n"
    "f 1 2 3\nf 2 3 4\nf 5 6 7 8\n";

const std::vector<float> rays{
    0.25f, 0.5f,  2, 0,    0, 0, -1, INFINITY,  // onto the triangle, u = 0.25, v = 0.5
    5,     5,     2, 0,    0, 0, -1, INFINITY,  // past everything
    3.25f, 0.75f, 2, 0,    0, 0, -4, INFINITY,  // the square's second half; t in units of 4
    0.25f, 0.5f,  2, 0,    0, 0, -1, 1.5f,      // ends before the triangle
    0.25f, 0.5f,  2, 2.5f, 0, 0, -1, INFINITY,  // begins behind it
};

outcome trace(const temporary_folder& folder, std::vector<std::string> more,
              const surroundings& s = without_devices(), const std::string& word = "m.obj") {
  put(folder / "m.obj", mesh);
  std::vector<std::string> words{"trace",  word == "m.obj" ? (folder / word).string() : word,
                                 "--rays", (folder / "rays.npy").string(),
                                 "--hits", (folder / "hits.npy").string()};
  words.insert(words.end(), more.begin(), more.end());
  return run(words, s);
}

void check_hits(const temporary_folder& folder) {
  const std::vector<hit> hits = read_hits(folder / "hits.npy");
  REQUIRE(hits.size() == 5);
  CHECK(hits[0].t == 2);
  CHECK(hits[0].u == 0.25f);
  CHECK(hits[0].v == 0.5f);
  CHECK(hits[0].instance == 0);
  CHECK(hits[0].triangle == 1);  // as the file counts, the dropped one included
  CHECK(hits[1].instance == miss);
  CHECK(hits[1].triangle == miss);
  CHECK(std::isinf(hits[1].t));
  CHECK(hits[2].t == 0.5f);
  CHECK(hits[2].triangle == 3);
  CHECK(hits[3].triangle == miss);
  CHECK(hits[3].t == 1.5f);
  CHECK(hits[4].triangle == miss);
}

}  // namespace

TEST_CASE("the serial tracer finds the hits, in either precision, with a tree and without") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", rays);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--device", "serial"},
        std::vector<std::string>{"--device", "serial-double"},
        std::vector<std::string>{"--device", "serial", "--tree", "none"}}) {
    const outcome o = trace(folder, more);
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(contains(o.err, "5 rays, 2 hits"));
    check_hits(folder);
  }
}

TEST_CASE("a device finds the same hits, from buffers and images, with a tree and without") {
  if (!has_device()) return;
  const temporary_folder folder;
  put_rays(folder / "rays.npy", rays);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--geometry", "buffer"},
        std::vector<std::string>{"--geometry", "image", "--tree", "none"}}) {
    const outcome o = trace(folder, more, {});
    CAPTURE(o.err);
    CHECK(o.code == 0);
    check_hits(folder);
  }
}

TEST_CASE("--any tells hits from misses") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", rays);
  REQUIRE(trace(folder, {"--any", "--device", "serial"}).code == 0);
  std::vector<bool> found;
  for (const hit& h : read_hits(folder / "hits.npy")) {
    found.push_back(h.triangle != miss);
    CHECK((h.triangle == 0 || h.triangle == miss));
    CHECK(h.instance == h.triangle);
  }
  CHECK(found == std::vector<bool>{true, false, true, false, false});
}

TEST_CASE("the statistics hold the rate, its median and every repeat") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", rays);
  REQUIRE(trace(folder,
                {"--repeat", "4", "--stats", (folder / "s.json").string(), "--device", "serial"})
              .code == 0);
  const auto s = nlohmann::json::parse(content_of(folder / "s.json"));
  CHECK(s["device"] == "serial");
  CHECK(s["rays"] == 5);
  CHECK(s["hits"] == 2);
  CHECK(s["triangles"] == 3);
  REQUIRE(s["kernel_ms_all"].size() == 4);
  std::vector<double> times = s["kernel_ms_all"];
  std::sort(times.begin(), times.end());
  CHECK(s["kernel_ms"].get<double>() == (times[1] + times[2]) / 2);
  // rays / ms / 1000, both printed so that they read back as the same double.
  CHECK(s["mrays_per_s"].get<double>() == 5 / s["kernel_ms"].get<double>() / 1000);
  for (const char* key : {"build_ms", "compile_ms"}) CHECK(s[key].is_number());
}

TEST_CASE("no rays, no hits, no error") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", {});
  CHECK(trace(folder, {"--device", "serial"}).code == 0);
  CHECK(read_hits(folder / "hits.npy").empty());
}

TEST_CASE("a file of rays of another shape is refused before anything is written") {
  const temporary_folder folder;
  put(folder / "rays.npy", "no rays");
  const outcome o = trace(folder, {"--device", "serial"});
  CHECK(o.code == 3);
  CHECK(contains(o.err, "rays.npy: is not a .npy file"));
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "rays.npy"});
}

TEST_CASE("the hits do not overwrite the rays") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", rays);
  const std::string before = content_of(folder / "rays.npy");
  put(folder / "m.obj", mesh);
  const outcome o =
      run({"trace", (folder / "m.obj").string(), "--rays", (folder / "rays.npy").string(), "--hits",
           (folder.path() / "." / "rays.npy").string(), "--device", "serial"},
          without_devices());
  CHECK(o.code == 2);
  CHECK(content_of(folder / "rays.npy") == before);
}
