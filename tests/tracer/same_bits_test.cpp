// The same picture on every device, bit for bit: each scene of scenes/ against a hash of its float
// pixels. PoCL and an NVIDIA H200 gave the same; FACET_TEST_DEVICE asks another device.
#include <doctest/doctest.h>

#include <bit>
#include <filesystem>
#include <map>
#include <set>

#include "scene/load.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/tracer.hpp"

using namespace facet;

namespace {

/// FNV-1a over the bits of all pixels (Fowler, Noll, Vo 1991), 64 bits.
std::uint64_t hash_of(const picture& p) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const float x : p.rgba)
    for (int k = 0; k < 4; ++k)
      hash = (hash ^ ((std::bit_cast<std::uint32_t>(x) >> (8 * k)) & 0xff)) * 0x100000001b3u;
  return hash;
}

/// By scene, at a third of its size; an H100 has confirmed all. A change of the
/// picture is a change here, and is to be meant.
const std::map<std::string, std::uint64_t> expected{
    {"glass_shadow", 0x99904e136afc39c6u}, {"knot", 0x2d62a7cc5ad7d6afu},
    {"nested_glass", 0x60b5f393fc312d8eu}, {"room", 0x5e1c8519cb73ac31u},
    {"showcase", 0xa581d90fac1e85e3u},     {"sphereflake", 0x8c210232a4a4b343u},
    {"terrain", 0xb21752be79805e8du},
};

}  // namespace

TEST_CASE("every scene's picture has the bits that it has on every device") {
  std::set<std::string> seen;
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(FACET_SOURCE_DIR) / "scenes")) {
    if (file.path().extension() != ".json" || file.path().stem().extension() == ".schema") continue;
    const std::string name = file.path().stem().string();
    const scene s = load_scene(file.path());
    const picture p =
        tracer::device_scene(test::queue(), s).render(s.width / 3, s.height / 3, s.max_depth);
    CAPTURE(name);
    const std::uint64_t found = hash_of(p);
    CAPTURE(found);
    CHECK(expected.count(name) == 1);
    if (!expected.count(name)) continue;
    CHECK(found == expected.at(name));
    seen.insert(name);
  }
  CHECK(seen.size() == expected.size());
}

TEST_CASE("one bit of one pixel changes the hash") {
  picture p(4, 4);
  const std::uint64_t before = hash_of(p);
  p.rgba[37] = std::bit_cast<float>(1u);
  CHECK(hash_of(p) != before);
}
