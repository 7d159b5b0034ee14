// What does not fit into memory: exit code 5, and nothing is left.
#include <doctest/doctest.h>

#include <cmath>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// A machine with 4 GiB, as far as the program can tell. Sanitizers reserve more than that.
surroundings small_machine() {
  surroundings s = without_devices();
  s.address_space = std::uint64_t(4) << 30;
  return s;
}

}  // namespace

TEST_CASE("a picture larger than the memory is refused with both figures" *
          doctest::skip(is_sanitized())) {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  const outcome o =
      run({"render", (folder / "s.json").string(), "-o", (folder / "out.npy").string(), "--device",
           "serial", "--width", "32768", "--height", "32768"},
          small_machine());
  CAPTURE(o.err);
  CHECK(o.code == 5);
  CHECK(contains(o.err, "a picture of 32768x32768 needs 20.0 GiB of memory"));
  CHECK(contains(o.err, " GiB; make it smaller"));
  CHECK(folder.names() == std::vector<std::string>{"s.json"});
}

TEST_CASE("an allocation that fails is out of memory, not a crash" *
          doctest::skip(is_sanitized())) {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", {0, 0, 5, 0, 0, 0, -1, INFINITY});
  // 130 million triangles have 4.7 GB of corners alone.
  const outcome o = run({"trace", "soup:130000000", "--rays", (folder / "rays.npy").string(),
                         "--hits", (folder / "hits.npy").string(), "--device", "serial"},
                        small_machine());
  CAPTURE(o.err);
  CHECK(o.code == 5);
  CHECK(contains(o.err, "out of memory"));
  CHECK(folder.names() == std::vector<std::string>{"rays.npy"});
}
