// The radix sort beside its peers, as a user measures it.
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

bool is_without_devices() {
  return contains(run({"sort", "--count", "2", "--repeat", "1"}, {}).err, "no OpenCL device");
}

}  // namespace

TEST_CASE("each count and size of keys has its figures, and the file says how it was sorted") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const std::string path = (folder / "out.json").string();
  const outcome o = run({"sort", "--count", "1", "1e3", "3001", "--repeat", "3", "--std-most",
                         "1e3", "--face", "serial", "--bits", "40", "--json", path},
                        {});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(std::ifstream(path));
  CHECK(file["format"] == "facet-bench-sort");
  CHECK(file["settings"]["face"] == "serial");
  REQUIRE(file["results"].size() == 6);
  for (const json& r : file["results"]) {
    CHECK(r["bits"] == (r["key_bits"] == 32 ? 32 : 40));
    CHECK(r["device"]["seconds"].size() == 3);
    CHECK(r["wall"]["mkeys_per_s"] > 0);
    CHECK(r.contains("std") == (r["count"] <= 1000));
    CHECK(r.contains("tbb") == !file["peer"].is_null());
    // The host waits for the device.
    for (std::size_t i = 0; i < 3; ++i) CHECK(r["wall"]["seconds"][i] >= r["device"]["seconds"][i]);
  }
  CHECK(file["results"][2]["count"] == 3001);
}

TEST_CASE("what cannot be measured is refused") {
  for (const char* count : {"0", "1.5", "2e9"}) {
    const outcome o = run({"sort", "--count", count}, {});
    CHECK(o.code != 0);
    CHECK(contains(o.err, "allowed are whole numbers from 1 to 1073741823"));
  }
  CHECK(contains(run({"sort", "--group", "64"}, {}).err, "--group"));
}
