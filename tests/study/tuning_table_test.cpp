// The table of tuned defaults as later runs read it: by device and driver, whole or not at all.
#include "study/tuning_table.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "image/temporary_folder.hpp"
#include "study/tuning_json.hpp"
#include "tracer/device_helper.hpp"

using namespace facet;
using nlohmann::json;
using study::read_tuning_table;
using study::tuning_error;
using study::tuning_table;
using tracer::choices;

namespace {

/// A result for this device, as if all choices had been made.
study::tuning_result result_with(const choices& c) {
  study::tuning_result r;
  r.complete = true;
  r.from = study::origin_now(test::device());
  r.values = c;
  r.workloads.push_back({"knot: eye rays", "knot", "fnv1a64:0000000000000000", 1, 1, 0, 0, 0});
  return r;
}

choices unusual() {
  choices c;
  c.wide_layout = c.packets = true;
  c.packet_group = 3, c.group = 48;
  c.render_group_width = 5, c.render_group_height = 6;
  c.leaf_sure = 3, c.leaf_size = 7;
  return c;
}

/// A table with this device's entry, after `change`.
tuning_table changed(const std::function<void(json&)>& change) {
  const test::temporary_folder folder;
  json file = json::parse(study::table_of(result_with(unusual())));
  change(file);
  test::put(folder / "t.json", file.dump());
  return read_tuning_table(folder / "t.json");
}

/// What is said of a table with that content.
std::string complaint(const std::string& content) {
  const test::temporary_folder folder;
  const std::filesystem::path path = folder / "t.json";
  test::put(path, content);
  try {
    read_tuning_table(path);
  } catch (const tuning_error& e) {
    const std::string said = e.what();
    CHECK(said.starts_with(path.string() + ": "));
    CHECK(said.find("delete the file, have `facet tune` measure anew") != std::string::npos);
    return said.substr(path.string().size() + 2);
  }
  return "";
}

std::string complaint_after(const std::function<void(json&)>& change) {
  json file = json::parse(study::table_of(result_with(unusual())));
  change(file);
  return complaint(file.dump());
}

}  // namespace

TEST_CASE("what was written is read, every value of it") {
  const tuning_table t = changed([](json&) {});
  REQUIRE(t.entries.size() == 1);
  CHECK(t.values_for(test::device()) == unusual());
  choices images;
  images.image_geometry = true;
  const tuning_table narrow =
      changed([&](json& f) { f = json::parse(study::table_of(result_with(images))); });
  CHECK(narrow.entries[0].values == images);
}

TEST_CASE("no file is an empty table") {
  const test::temporary_folder folder;
  CHECK(read_tuning_table(folder / "none.json").entries.empty());
  CHECK(!read_tuning_table(folder / "none.json").values_for(test::device()));
  CHECK_THROWS_AS(study::tuned_values(folder / "none.json", test::device()), tuning_error);
}

TEST_CASE("another device's values are not taken, nor those under another driver") {
  const tuning_table other =
      changed([](json& f) { f["devices"][0]["device"]["name"] = "another"; });
  CHECK(!other.values_for(test::device()));
  CHECK(!other.find_other_driver(test::device()));

  const tuning_table older = changed([](json& f) { f["devices"][0]["device"]["driver"] = "0.1"; });
  CHECK(!older.values_for(test::device()));
  REQUIRE(older.find_other_driver(test::device()));
  CHECK(older.find_other_driver(test::device())->of.driver == "0.1");

  const tuning_table both = changed([](json& f) {
    f["devices"].push_back(f["devices"][0]);
    f["devices"][1]["device"]["driver"] = "0.1";
    f["devices"][1]["values"]["group"] = 1;
  });
  CHECK(both.values_for(test::device()) == unusual());
}

TEST_CASE("what is no table, or no table of this version, is refused by name") {
  CHECK(complaint("").find("is not JSON") != std::string::npos);
  CHECK(complaint("{\"format\": \"facet-tuning\", \"ver").find("is not JSON") != std::string::npos);
  CHECK(complaint("[]").find("/format") == std::string::npos);
  CHECK(complaint("[]") != "");
  CHECK(complaint_after([](json& f) {
          f["format"] = "facet-sweep";
        }).starts_with("/format: expected \"facet-tuning\""));
  for (const int other : {1, 3})
    CHECK(complaint_after([&](json& f) { f["version"] = other; }).starts_with("/version: "));
  CHECK(complaint_after([](json& f) { f.erase("version"); }).find("version") != std::string::npos);
  const test::temporary_folder folder;
  CHECK_THROWS_AS(read_tuning_table(folder.path()), tuning_error);
}

TEST_CASE("one entry that is not whole spoils the table, whichever device it is of") {
  const auto spoil = [](const std::string& key, const json& value) {
    return complaint_after([&](json& f) {
      f["devices"].push_back(f["devices"][0]);
      f["devices"][1]["device"]["name"] = "another";
      f["devices"][1]["values"][key] = value;
    });
  };
  CHECK(spoil("group", 64) == "");
  const std::vector<std::pair<std::string, json>> wrong{{"group", 0},
                                                        {"group", -1},
                                                        {"group", 64.5},
                                                        {"group", "64"},
                                                        {"group", 1u << 30},
                                                        {"packet_group", 0},
                                                        {"layout", "tall"},
                                                        {"geometry", true},
                                                        {"packets", 1},
                                                        {"packets", nullptr},
                                                        {"render_group", 8},
                                                        {"render_group", json::array({8})},
                                                        {"render_group", {8, 8, 8}},
                                                        {"render_group", {8, 0}},
                                                        {"trace_registers", -64},
                                                        {"leaf_sure", 0},
                                                        {"leaf_size", "4"}};
  for (const auto& pair : wrong) {
    const auto& key = pair.first;
    const json& value = pair.second;
    CAPTURE(key);
    CAPTURE(value);
    CHECK(spoil(key, value).starts_with("/devices/1/values/" + key));
  }
  CHECK(spoil("colour", 1).find("colour") != std::string::npos);
  CHECK(complaint_after([](json& f) { f["devices"][0]["values"].erase("group"); }).find("group") !=
        std::string::npos);
  CHECK(complaint_after([](json& f) {
          f["devices"][0]["device"].erase("driver");
        }).find("driver") != std::string::npos);
  CHECK(complaint_after([](json& f) {
          f["devices"].push_back(f["devices"][0]);
        }).find("same device and driver") != std::string::npos);
}

TEST_CASE("values that this device cannot have are refused as they are asked for") {
  const auto values = [](const std::string& key, const json& value) {
    return [=] {
      return changed([&](json& f) { f["devices"][0]["values"][key] = value; })
          .values_for(test::device());
    };
  };
  CHECK_THROWS_WITH_AS(values("group", 1u << 20)(), doctest::Contains("group: found 1048576"),
                       tuning_error);
  CHECK_THROWS_WITH_AS(values("leaf_size", 17)(), doctest::Contains("leaf_size: found 17"),
                       tuning_error);
  CHECK_THROWS_WITH_AS(values("geometry", "image")(), doctest::Contains("wide with image"),
                       tuning_error);
}
