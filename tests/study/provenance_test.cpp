#include "study/provenance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>

#include "tracer/device_helper.hpp"

using namespace facet;

TEST_CASE("a commit is 40 hexadecimal digits, perhaps modified, or unknown") {
  std::string commit = study::commit();
  if (commit == "unknown") return;
  if (commit.ends_with("-modified")) commit.resize(commit.size() - 9);
  CHECK(commit.size() == 40);
  CHECK(
      std::all_of(commit.begin(), commit.end(), [](unsigned char c) { return std::isxdigit(c); }));
}

TEST_CASE("a date is of this age, in UTC, and sorts as text") {
  const std::string now = study::date();
  REQUIRE(now.size() == 20);
  CHECK(now >= "2026-01-01T00:00:00Z");
  CHECK(now < "2126");
  CHECK(now[10] == 'T');
  CHECK(now[19] == 'Z');
}

TEST_CASE("a device's facts are those that its driver reports") {
  const runtime::device d = test::device();
  const study::device_facts f = study::facts_of(d);
  CHECK(f.name == d.name());
  CHECK(f.platform == d.platform_name());
  CHECK(f.driver == d.driver_version());
  CHECK(f.compute_units >= 1);
  CHECK((f.type == "gpu") == d.is_gpu());
  CHECK(!study::cpu_name().empty());
}
