#include "study/tuning_table.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "scene/error.hpp"
#include "scene/json_reader.hpp"

namespace facet::study {
namespace {

constexpr std::uint32_t most = 1u << 20;  // of any number in it; what a device allows is less

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw tuning_error(file + ": " + what +
                     "; delete the file, have `facet tune` measure anew, or leave it out by "
                     "--no-tuning");
}

bool is_word(const json_node& at, const std::string& yes, const std::string& no) {
  const std::string allowed = "\"" + yes + "\" or \"" + no + "\"", word = at.text(allowed);
  if (word != yes && word != no) at.expected(allowed);
  return word == yes;
}

tracer::choices values_in(const json_node& v) {
  v.check_keys("the values", {"layout", "geometry", "packets", "packet_group", "group",
                              "render_group", "trace_registers", "leaf_sure", "leaf_size"});
  const auto whole = [&](const char* key, std::uint32_t least) {
    return v.at(key, "a whole number").whole(least, most);
  };
  tracer::choices c;
  c.wide_layout = is_word(v.at("layout", "a layout"), "wide", "narrow");
  c.image_geometry = is_word(v.at("geometry", "a geometry"), "image", "buffer");
  c.packets = v.at("packets", "true or false").boolean();
  c.packet_group = whole("packet_group", 1);
  c.group = whole("group", 1);
  const json_node sides = v.at("render_group", "a width and a height");
  if (sides.size("a width and a height") != 2) sides.expected("a width and a height");
  c.render_group_width = sides.element(0).whole(1, most);
  c.render_group_height = sides.element(1).whole(1, most);
  c.trace_registers = whole("trace_registers", 0);
  c.leaf_sure = whole("leaf_sure", 1);
  c.leaf_size = whole("leaf_size", 1);
  return c;
}

tuned_entry entry_in(const json_node& e) {
  e.check_keys("an entry",
               {"device", "date", "facet", "cpu", "values", "settings", "workloads", "choices"});
  const json_node d = e.at("device", "a device");
  d.check_keys("a device", {"name", "platform", "driver"});
  return {{d.at("name", "a name").text(), d.at("platform", "a name").text(),
           d.at("driver", "a version").text()},
          e.at("date", "a date").text(),
          values_in(e.at("values", "the values"))};
}

std::vector<tuned_entry> entries_in(const json_node& root) {
  if (root.at("format", tuning_format).text() != tuning_format)
    root.at("format", "").expected(std::string("\"") + tuning_format + "\"");
  root.at("version", "a version").whole(tuning_version, tuning_version);
  root.check_keys("a table", {"format", "version", "devices"});
  const json_node devices = root.at("devices", "a list");
  std::vector<tuned_entry> all;
  const std::size_t count = devices.size("a list of devices");
  for (std::size_t k = 0; k < count; ++k) {
    const json_node at = devices.element(k);
    all.push_back(entry_in(at));
    for (std::size_t other = 0; other < k; ++other)
      if (all[other].of == all[k].of) at.fail("is of the same device and driver as another");
  }
  return all;
}

std::string as_in_json(const std::string& text) {
  const auto replaced =
      nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(replaced);
}

}  // namespace

tuned_device tuned_device_of(const device_facts& d) {
  return {as_in_json(d.name), as_in_json(d.platform), as_in_json(d.driver)};
}

const tuned_entry* tuning_table::find(const runtime::device& d) const {
  const tuned_device of = tuned_device_of(facts_of(d));
  const auto at = std::find_if(entries.begin(), entries.end(),
                               [&](const tuned_entry& e) { return e.of == of; });
  return at == entries.end() ? nullptr : &*at;
}

const tuned_entry* tuning_table::find_other_driver(const runtime::device& d) const {
  const tuned_device of = tuned_device_of(facts_of(d));
  const auto at = std::find_if(entries.begin(), entries.end(), [&](const tuned_entry& e) {
    return e.of.is_same_but_for_driver(of) && e.of.driver != of.driver;
  });
  return at == entries.end() ? nullptr : &*at;
}

std::optional<tracer::choices> tuning_table::values_for(const runtime::device& d) const {
  const tuned_entry* const e = find(d);
  if (!e) return std::nullopt;
  if (const std::string fault = tracer::fault_of(e->values, d); !fault.empty())
    fail(file, "the values for " + e->of.name + " are not ones that it can have: " + fault);
  return e->values;
}

tuning_table read_tuning_table(const std::filesystem::path& path) {
  tuning_table t{path.string(), {}};
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (status.type() == std::filesystem::file_type::not_found) return t;
  if (!std::filesystem::is_regular_file(status)) fail(t.file, "is not a file that can be read");
  try {
    const json_document document = read_json_document(path);
    t.entries = entries_in(json_node(document));
  } catch (const scene_error& e) {
    fail(t.file, (e.place().empty() ? "" : e.place() + ": ") + e.message());
  }
  return t;
}

tracer::choices tuned_values(const std::filesystem::path& path, const runtime::device& d) {
  const auto values = read_tuning_table(path).values_for(d);
  if (!values)
    throw tuning_error(path.string() + ": has nothing for " + d.name() + " under driver " +
                       d.driver_version() + "; `facet tune --out` writes it");
  return *values;
}

}  // namespace facet::study
