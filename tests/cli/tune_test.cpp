// Tuning as a user runs it, and what later runs make of the table.
#include <doctest/doctest.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"
#include "scene/schema_helper.hpp"

using namespace facet::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

surroundings with_table(const fs::path& table) { return {{"FACET_TUNING=" + table.string()}}; }

outcome tune(const fs::path& table, std::vector<std::string> more) {
  std::vector<std::string> words{"tune"};
  words.insert(words.end(), more.begin(), more.end());
  return run(words, with_table(table));
}

/// Some seconds at most: one choice, on a few rays. With every device one of the two is made.
const std::vector<std::string> little{"--quick",  "--only",   "group,packet_group",
                                      "--rounds", "3",        "--width",
                                      "64",       "--scenes", "torus_knot:p=3,q=4"};

/// The table that a little tuning has left: this device's, made once.
const json& tuned_table() {
  static const json table = [] {
    const temporary_folder folder;
    const outcome o = tune(folder / "new" / "t.json", little);  // the folder is made
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    CHECK(contains(o.err, "wrote " + (folder / "new" / "t.json").string()));
    CHECK(contains(o.out, "group: "));
    CHECK(contains(o.out, "kept so far"));
    return json::parse(content_of(folder / "new" / "t.json"));
  }();
  return table;
}

/// The table with other values than any device's defaults have.
json changed_table(const std::function<void(json& entry)>& change) {
  json file = tuned_table();
  json& v = file["devices"][0]["values"];
  v["layout"] = "narrow", v["geometry"] = "buffer", v["packets"] = false;
  v["render_group"] = {2, 3};
  change(file["devices"][0]);
  return file;
}

struct rendered {
  outcome said;
  json stats;
  std::string picture;
};

/// Renders the small scene with that table.
rendered render_with(const std::string& table, std::vector<std::string> more = {}) {
  const temporary_folder folder;
  put(folder / "t.json", table);
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{"render",  (folder / "s.json").string(),
                                 "-o",      (folder / "out.npy").string(),
                                 "--stats", (folder / "stats.json").string()};
  words.insert(words.end(), more.begin(), more.end());
  rendered r{run(words, with_table(folder / "t.json")), {}, ""};
  CAPTURE(r.said.err);
  if (r.said.code == 0) {
    r.stats = json::parse(content_of(folder / "stats.json"));
    r.picture = content_of(folder / "out.npy");
  } else {
    CHECK(folder.names() == std::vector<std::string>{"s.json", "t.json"});
  }
  CHECK(content_of(folder / "t.json") == table);
  return r;
}

}  // namespace

TEST_CASE("tuning writes a table as the published schema has it") {
  if (!has_device()) return;
  const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-tuning.schema.json"));
  CHECK(schema_fault(tuned_table(), schema) == "");
  REQUIRE(tuned_table()["devices"].size() == 1);
  const json& e = tuned_table()["devices"][0];
  CHECK(e["settings"]["quick"] == true);
  CHECK(e["settings"]["rounds"] == 3);
  CHECK(!e["choices"].empty());
  for (const json& c : e["choices"]) CHECK(c["trials"].size() > 2);
}

TEST_CASE("a later render takes the table's values, and gives the same bits") {
  if (!has_device()) return;
  const std::string table = changed_table([](json&) {}).dump();
  const rendered usual = render_with(table, {"--no-tuning"}), tuned = render_with(table, {"-v"});
  REQUIRE(usual.said.code == 0);
  REQUIRE(tuned.said.code == 0);
  CHECK(usual.stats["tuned"] == false);
  CHECK(tuned.stats["tuned"] == true);
  CHECK(tuned.stats["layout"] == "narrow");
  CHECK(tuned.stats["work_group"] == json({2, 3}));
  CHECK(contains(tuned.said.err, "tuned: 2"));
  CHECK(!usual.picture.empty());
  CHECK(tuned.picture == usual.picture);
}

TEST_CASE("options go before the table") {
  if (!has_device()) return;
  const std::string table =
      changed_table([](json& e) { e["values"]["geometry"] = "image"; }).dump();
  CHECK(render_with(table).stats["geometry"] == "image");
  CHECK(render_with(table, {"--layout", "wide"}).stats["layout"] == "wide");
  CHECK(render_with(table, {"--packets", "on"}).stats["rays_a_work_item"] == 32);
  const json of_group = render_with(table, {"--geometry", "buffer", "--work-group", "4x2"}).stats;
  CHECK(of_group["geometry"] == "buffer");
  CHECK(of_group["work_group"] == json({4, 2}));
  CHECK(of_group["tuned"] == true);
}

TEST_CASE("rays and hard cases are traced by the table, too") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "t.json", changed_table([](json& e) { e["values"]["group"] = 7; }).dump());
  put_rays(folder / "rays.npy", {0, 0, 5, 0, 0, 0, -1, INFINITY});
  const outcome o = run({"trace", "icosphere:2", "--rays", (folder / "rays.npy").string(), "--hits",
                         (folder / "hits.npy").string(), "--stats", (folder / "s.json").string()},
                        with_table(folder / "t.json"));
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json stats = json::parse(content_of(folder / "s.json"));
  CHECK(stats["tuned"] == true);
  CHECK(stats["work_group"] == json({7, 1}));

  const outcome cases = run({"accuracy", "--cases", "5", "--json", (folder / "a.json").string()},
                            with_table(folder / "t.json"));
  CHECK(cases.code == 0);
  CHECK(json::parse(content_of(folder / "a.json"))["tuned"] == true);
}

TEST_CASE("another device's entry is not taken; one under another driver is not, and is told of") {
  if (!has_device()) return;
  const rendered other =
      render_with(changed_table([](json& e) { e["device"]["name"] = "another"; }).dump());
  CHECK(other.stats["tuned"] == false);
  CHECK(!contains(other.said.err, "note: "));
  const rendered older =
      render_with(changed_table([](json& e) { e["device"]["driver"] = "0.1"; }).dump());
  CHECK(older.stats["tuned"] == false);
  CHECK(contains(older.said.err, "under driver 0.1"));
  CHECK(contains(older.said.err, "`facet tune` measures anew"));
}

TEST_CASE("a table that cannot be used is an error that says which and what to do: exit code 3") {
  if (!has_device()) return;
  json later = tuned_table();
  later["version"] = 3;
  const std::string whole = changed_table([](json&) {}).dump();
  for (const std::string& table :
       {std::string("not JSON"), whole.substr(0, whole.size() / 2), later.dump(),
        changed_table([](json& e) { e["values"]["group"] = 0; }).dump(),
        changed_table([](json& e) { e["values"]["group"] = 1 << 20; }).dump(),
        changed_table([](json& e) { e["values"].erase("layout"); }).dump()}) {
    CAPTURE(table);
    const rendered r = render_with(table);
    CHECK(r.said.code == 3);
    CHECK(contains(r.said.err, "t.json: "));
    CHECK(contains(r.said.err, "delete the file, have `facet tune` measure anew, or leave it out"));
    CHECK(render_with(table, {"--no-tuning"}).said.code == 0);
  }
}

TEST_CASE("tuning replaces a table that cannot be read, and says so") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "t.json", "not JSON");
  const outcome o = tune(folder / "t.json", little);
  CHECK(o.code == 0);
  CHECK(contains(o.err, "the table is replaced by a new one"));
  CHECK(json::parse(content_of(folder / "t.json"))["devices"].size() == 1);
}

TEST_CASE("interrupted, it leaves the old table as it was: exit code 130") {
  if (!has_device() || !has_terminal()) return;
  const temporary_folder folder;
  const std::string table = changed_table([](json&) {}).dump();
  put(folder / "t.json", table);
  surroundings s = with_table(folder / "t.json");
  s.terminal = true;
  program p({"tune", "--quick", "--rounds", "1000", "--width", "64"}, s);
  REQUIRE(p.wait_for("tuning layout"));
  p.send(SIGINT);
  const outcome o = p.wait();
  CAPTURE(o.err);
  CHECK(o.code == 130);
  CHECK(contains(o.err, "interrupted while tuning layout; nothing was saved"));
  CHECK(content_of(folder / "t.json") == table);
  CHECK(folder.names() == std::vector<std::string>{"t.json"});
}

// One wrong bit of one ray, in groups of one of the sizes that are tried.
TEST_CASE("a tampered kernel is caught: exit code 4, with the value; nothing is written") {
  if (!has_device()) return;
  const temporary_folder folder;
  const fs::path kernels = folder / "cl";
  fs::copy(FACET_SOURCE_DIR "/cl", kernels);
  for (const auto& [file, size] : {std::pair{"trace.cl", "128"}, {"trace_packets.cl", "2"}}) {
    std::string text = content_of(kernels / file);
    const std::size_t start = text.find("__kernel void trace_closest("),
                      end = text.find("\n}", start);
    REQUIRE(end != std::string::npos);
    text.insert(end, std::string("\n  if (get_local_size(0) == ") + size +
                         " && get_global_id(0) == 0u) hits[0].u += 1.0f;");
    put(kernels / file, text);
  }
  std::vector<std::string> words = little;
  words.insert(words.end(), {"--kernels", kernels.string(), "--out", (folder / "t.json").string()});
  const outcome o = tune(folder / "not-this.json", words);
  CAPTURE(o.err);
  CHECK(o.code == 4);
  CHECK((contains(o.err, "packet_group 2: 1 of ") || contains(o.err, "group 128: 1 of ")));
  CHECK(contains(o.err, "the first number 0"));
  CHECK(folder.names() == std::vector<std::string>{"cl"});
}

TEST_CASE("what holds is shown for each device, with where it comes from; and forgotten") {
  if (!has_device()) return;
  const temporary_folder folder;
  const fs::path path = folder / "t.json";
  json file = changed_table([](json&) {});
  file["devices"].push_back(file["devices"][0]);
  file["devices"][1]["device"]["name"] = "another";
  file["devices"].push_back(file["devices"][0]);
  file["devices"][2]["device"]["driver"] = "0.1";
  put(path, file.dump());
  const outcome shown = tune(path, {"--show"});
  CHECK(shown.code == 0);
  CHECK(contains(shown.out, "   tuned 2"));
  CHECK(contains(shown.out, path.string()));
  CHECK(contains(shown.out, "narrow, buffer"));
  CHECK(contains(shown.out, "built in: 8x8"));
  CHECK(contains(run({"devices"}, with_table(path)).out, "   tuned 2"));

  CHECK(tune(path, {"--forget"}).code == 0);
  const json left = json::parse(content_of(path));
  REQUIRE(left["devices"].size() == 1);
  CHECK(left["devices"][0] == file["devices"][1]);
  const outcome after = tune(path, {"--show"});
  CHECK(contains(after.out, "   built-in defaults: not in " + path.string()));
  CHECK(!contains(after.out, "   tuned"));
  CHECK(contains(run({"devices"}, with_table(path)).out, "built-in defaults"));
  CHECK(contains(tune(path, {"--forget"}).err, "has nothing for"));
}

TEST_CASE("what cannot be asked for is refused as usage, before anything is measured") {
  const auto refused = [](std::vector<std::string> words, const std::string& part) {
    words.insert(words.begin(), "tune");
    const outcome o = run(words);  // FACET_TUNING is empty
    CAPTURE(o.err);
    CHECK(o.code == 2);
    CHECK(contains(o.err, part));
  };
  refused({}, "FACET_TUNING is set and empty");
  refused({"--forget"}, "--out");
  refused({"--device", "serial", "--out", "/tmp/t.json"}, "--device serial");
  refused({"--only", "leafs"}, "leaves");
  refused({"--rounds", "2"}, "from 3 to 1000 rounds");
  refused({"--show", "--forget"}, "--show");
  refused({"--show", "--quick"}, "--show");
}

TEST_CASE("it measures on the scenes that are named") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  const outcome o =
      tune(folder / "t.json", {"--quick", "--only", "group,packet_group", "--width", "64",
                               "--scenes", (folder / "s.json").string(), "torus_knot:p=3,q=4"});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(content_of(folder / "t.json"));
  std::vector<std::string> names;
  for (const json& w : file["devices"][0]["workloads"]) names.push_back(w["name"]);
  const std::string of_file = (folder / "s.json").string();
  CHECK(names == std::vector<std::string>{
                     of_file + ": picture", of_file + ": eye rays", of_file + ": shadow rays",
                     of_file + ": bounce rays", "torus_knot:p=3,q=4: picture",
                     "torus_knot:p=3,q=4: eye rays", "torus_knot:p=3,q=4: shadow rays",
                     "torus_knot:p=3,q=4: bounce rays"});
  CHECK(tune(folder / "t.json", {"--scenes", "dodecahedron"}).code == 3);
}

TEST_CASE("kernels of one's own need a table of their own") {
  const temporary_folder folder;
  const outcome o = tune(folder / "t.json", {"--kernels", FACET_SOURCE_DIR "/cl"});
  CHECK(o.code == 2);
  CHECK(contains(o.err, "--out"));
}
