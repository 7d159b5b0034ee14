// facet accuracy: which cases, how many rays, what is written.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

TEST_CASE("a case is run, met, told of and written, with the mistake that it catches") {
  if (!has_device()) return;
  const temporary_folder folder;
  const auto path = folder / "cases.json";
  const outcome o = run({"accuracy", "--cases", "7,2", "--rays", "1e3", "--device", "0",
                         "--mistakes", "--json", path.string()});
  INFO(o.err);
  CHECK(o.code == 0);
  CHECK(contains(o.out, "closed mesh, rays at vertices"));
  CHECK(contains(o.out, "moller-trumbore"));
  CHECK(contains(o.err, "every case meets its goal"));
  const auto content = nlohmann::json::parse(content_of(path));
  CHECK(content.at("format") == "facet-accuracy");
  CHECK(content.at("version") == 1);
  CHECK(content.at("rays") == 1000);
  CHECK(content.at("complete") == true);
  const auto& cases = content.at("cases");
  REQUIRE(cases.size() == 4);
  CHECK(cases[0].at("case") == 7);
  CHECK(cases[0].at("met") == true);
  CHECK(cases[0].at("findings")[0].at("tried") == 1000);
  CHECK(cases[0].at("findings")[0].at("failed") == 0);
  CHECK(cases[3].at("case") == 2);
  CHECK(cases[3].at("mistake") == "moller-trumbore");
  CHECK(cases[3].at("met") == false);
  CHECK(cases[3].at("findings")[0].at("failed").get<int>() > 0);
}

TEST_CASE("the same seed finds the same, another one something else") {
  if (!has_device()) return;
  const temporary_folder folder;
  const auto failed = [&](const char* seed) {
    const auto path = folder / "cases.json";
    run({"accuracy", "--cases", "2", "--rays", "2000", "--device", "0", "--mistakes", "--seed",
         seed, "--json", path.string()});
    return nlohmann::json::parse(content_of(path))
        .at("cases")[1]
        .at("findings")[0]
        .at("first")
        .dump();
  };
  const std::string first = failed("1");
  CHECK(failed("1") == first);
  CHECK(failed("2") != first);
}

TEST_CASE("unknown cases, ray counts and devices are refused with what is allowed") {
  const auto refused = [](std::vector<std::string> more, const char* part) {
    std::vector<std::string> words{"accuracy"};
    words.insert(words.end(), more.begin(), more.end());
    const outcome o = run(words);
    CHECK(o.code == 2);
    CAPTURE(o.err);
    CHECK(contains(o.err, part));
  };
  refused({"--cases", "2,27"}, "numbers from 1 to 26");
  refused({"--cases", "vertices"}, "found \"vertices\"");
  refused({"--rays", "many"}, "1000 to 1e10");
  refused({"--rays", "10"}, "1000 to 1e10");
  refused({"--rays", "1e3.5"}, "1000 to 1e10");
  refused({"--device", "serial"}, "serial has no meaning here");
}
