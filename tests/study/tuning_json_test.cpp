// The text of a table: one entry for a device and driver, and what is said of others left alone.
#include "study/tuning_json.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "image/temporary_folder.hpp"
#include "scene/schema_helper.hpp"
#include "study/tunables.hpp"
#include "tracer/device_helper.hpp"

using namespace facet;
using nlohmann::json;

namespace {

study::choice_result choice() {
  study::choice_result c;
  c.name = "group";
  c.workloads = {0, 1};
  c.trials.resize(3);
  c.trials[0].value = "64";
  c.trials[0].ms = {{1, 2, 3}, {10, 20, 30}};
  c.trials[1].value = "128";
  c.trials[1].as.group = 128;
  c.trials[1].ms = {{0.5, 0.5, 0.5}, {5, 5, 5}};
  c.trials[1].warm_up_ms = 1234.5678;
  c.trials[1].relative = {{0.5, 0.5, 0.5}, 0.5, {0.25, 0.512345}};
  c.trials[2].value = "256";
  c.trials[2].refused = "too large";
  c.challenger = 1;
  c.confirmation = {{0.5}, 0.5, {0.5, 0.5}};
  c.taken = 1;
  return c;
}

study::tuning_result result(const std::string& device, const std::string& driver,
                            std::uint32_t group) {
  study::tuning_result r;
  r.complete = true;
  r.from = study::origin_now(test::device());
  r.from.device->name = device;
  r.from.device->driver = driver;
  r.values.group = group;
  r.workloads.push_back({"a: eye rays", "a", "fnv1a64:0123456789abcdef", 7, 9, 0, 0, 0});
  r.workloads.push_back({"a: picture", "a", "fnv1a64:0123456789abcdef", 7, 0, 16, 8, 3});
  r.choices.push_back(choice());
  return r;
}

/// The groups in a table, in order.
std::vector<std::uint32_t> groups_in(const json& file) {
  std::vector<std::uint32_t> all;
  for (const json& e : file["devices"]) all.push_back(e["values"]["group"]);
  return all;
}

std::string schema_fault_of(const std::string& text) {
  const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-tuning.schema.json"));
  return test::schema_fault(json::parse(text), schema);
}

}  // namespace

TEST_CASE("a table is as the published schema has it, and says why a value was taken") {
  const std::string text = study::table_of(result("d", "1", 128));
  CHECK(schema_fault_of(text) == "");
  const json e = json::parse(text)["devices"][0];
  CHECK(e["facet"]["commit"] == study::commit());
  CHECK(e["workloads"][0]["rays"] == 9);
  CHECK(e["workloads"][1]["picture"]["max_depth"] == 3);
  const json& c = e["choices"][0];
  CHECK(c["taken"] == "128");
  CHECK(c["workloads"] == json({"a: eye rays", "a: picture"}));
  CHECK(c["trials"][0]["standing"] == "kept so far");
  CHECK(c["trials"][0]["median_ms"] == json({2, 20}));
  CHECK(c["trials"][0]["relative_time"] == nullptr);
  CHECK(c["trials"][1]["relative_time"]["interval"] == json({0.25, 0.5123}));
  CHECK(c["trials"][1]["warm_up_ms"] == 1235);
  CHECK(c["trials"][2]["standing"] == "refused");
  CHECK(c["trials"][2]["reason"] == "too large");
  CHECK(c["confirmation"]["value"] == "128");
}

TEST_CASE("every tunable has a place in the schema") {
  study::tuning_result r = result("d", "1", 128);
  for (const study::tunable& t : study::tunables()) {
    r.choices[0].name = t.name;
    CHECK(schema_fault_of(study::table_of(r)) == "");
  }
  r.choices[0].name = "layout";
  std::string text = study::table_of(r);
  text.replace(text.find("\"layout\",\n          \"taken\""), 8, "\"colour\"");
  CHECK(schema_fault_of(text) != "");
}

TEST_CASE("an entry takes the place of the one for the same device and driver, and of no other") {
  const test::temporary_folder folder;
  const std::filesystem::path path = folder / "t.json";
  for (const auto& [device, driver, group] :
       std::vector<std::tuple<std::string, std::string, std::uint32_t>>{
           {"a", "1", 1}, {"b", "1", 2}, {"a", "2", 3}, {"a", "1", 4}})
    test::put(path, study::table_with(path, result(device, driver, group)));
  const json file = json::parse(test::content_of(path));
  CHECK(groups_in(file) == std::vector<std::uint32_t>{2, 3, 4});
  CHECK(schema_fault_of(test::content_of(path)) == "");
  // What stands of the others is as it was, figures and all.
  const json alone = json::parse(study::table_of(result("b", "1", 2)));
  CHECK(file["devices"][0]["choices"] == alone["devices"][0]["choices"]);

  const study::tuned_device of{"a", test::device().platform_name(), ""};
  const std::string without = study::table_without(path, of);
  CHECK(groups_in(json::parse(without)) == std::vector<std::uint32_t>{2});
  CHECK(schema_fault_of(without) == "");
}

TEST_CASE("a table that cannot be read is not written over unseen") {
  const test::temporary_folder folder;
  test::put(folder / "t.json", "{");
  CHECK_THROWS_AS(study::table_with(folder / "t.json", result("a", "1", 1)), study::tuning_error);
  CHECK_THROWS_AS(study::table_without(folder / "t.json", {"a", "b", "c"}), study::tuning_error);
}

TEST_CASE("a device whose name is not UTF-8 is found again") {
  const test::temporary_folder folder;
  const std::filesystem::path path = folder / "t.json";
  const study::tuning_result r = result("\xff", "1", 5);
  test::put(path, study::table_with(path, r));
  test::put(path, study::table_with(path, r));
  const study::tuning_table t = study::read_tuning_table(path);
  REQUIRE(t.entries.size() == 1);
  CHECK(t.entries[0].of == study::tuned_device_of(*r.from.device));
}
