// Row `sort`: the device's radix sort of keys with 32-bit values, beside TBB and std::sort on the
// CPU, the same keys, alternated in one run. CUB's figures come from peers/cub_sort.cu.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/sort_run.hpp"
#include "bench/tbb_peer.hpp"
#include "image/output.hpp"
#include "study/statistics.hpp"
#include "tracer/radix_sort.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;
using tracer::look_back_use;
using tracer::sort_face;
using tracer::sort_ranking;

struct arguments {
  std::vector<double> counts{1e3, 1e4, 1e5, 1e6, 1e7, 1 << 24};
  std::vector<unsigned> keys{32, 64};
  std::string device = "0", json, face = "auto", ranking = "auto", look_back = "auto",
              beside = "auto", launches = "auto", flags;
  unsigned bits = 0;
  std::uint32_t group = 0, items = 0, window = 0, registers = 0, copies = 0, histogram_groups = 0,
                tiles = 0, few = 0, bucket_mean = 0, bucket_room = 0, bucket_most = 0;
  int repeat = 11;
  double std_most = 1e6;
  bool is_order = false, no_peers = false, shows_steps = false;
};

const std::map<std::string, sort_face> faces{{"group", sort_face::group},
                                             {"serial", sort_face::serial}};
const std::map<std::string, sort_ranking> rankings{{"portable", sort_ranking::portable},
                                                   {"ballot", sort_ranking::ballot},
                                                   {"match", sort_ranking::match}};
const std::map<std::string, look_back_use> look_backs{{"auto", look_back_use::if_proven},
                                                      {"on", look_back_use::always},
                                                      {"off", look_back_use::never}};

template <class T>
std::string word_of(const std::map<std::string, T>& words, T value) {
  for (const auto& [word, v] : words)
    if (v == value) return word;
  return {};
}

tracer::tuning tuned(const runtime::device& d, const arguments& o) {
  tracer::tuning t = tracer::tuning_for(d);
  t.more_flags = o.flags;
  tracer::sort_tuning& s = t.sort;
  if (o.face != "auto") s.face = faces.at(o.face);
  if (o.ranking != "auto") s.ranking = rankings.at(o.ranking);
  s.look_back = look_backs.at(o.look_back);
  if (o.beside != "auto") s.values_beside = o.beside == "on";
  if (o.launches != "auto")
    s.whole_most_32 = s.whole_most_64 = o.launches == "one" ? tracer::sort_tuning::any_count : 0;
  const auto set = [](std::uint32_t& to, std::uint32_t value) {
    if (value != 0) to = value;
  };
  set(s.group_32, o.group);
  set(s.group_64, o.group);
  set(s.items_32, o.items);
  set(s.items_64, o.items);
  set(s.window, o.window);
  set(s.registers, o.registers);
  set(s.histogram_copies, o.copies);
  set(s.histogram_groups, o.histogram_groups);
  set(s.tiles, o.tiles);
  set(s.few, o.few);
  set(s.bucket_mean, o.bucket_mean);
  set(s.bucket_room, o.bucket_room);
  set(s.bucket_most, o.bucket_most);
  return t;
}

json settings_of(const tracer::sort_tuning& s, const arguments& o) {
  json j{{"repeats", o.repeat}, {"face", word_of(faces, s.face)}, {"first_order", o.is_order}};
  if (s.face == sort_face::group)
    j.update({{"ranking", word_of(rankings, s.ranking)},
              {"look_back", word_of(look_backs, s.look_back)},
              {"whole_most_32", s.whole_most_32},
              {"whole_most_64", s.whole_most_64},
              {"group_32", s.group_32},
              {"group_64", s.group_64},
              {"items_32", s.items_32},
              {"items_64", s.items_64},
              {"window", s.window},
              {"values_beside", s.values_beside},
              {"registers", s.registers},
              {"histogram_copies", s.histogram_copies},
              {"histogram_groups", s.histogram_groups}});
  else
    j.update({{"tiles", s.tiles},
              {"tile_least", s.tile_least},
              {"few", s.few},
              {"bucket_mean", s.bucket_mean},
              {"bucket_room", s.bucket_room},
              {"bucket_most", s.bucket_most}});
  return j;
}

json rates(const std::vector<double>& seconds, std::uint32_t count) {
  std::vector<double> rate;
  for (double s : seconds) rate.push_back(double(count) / s * 1e-6);
  const study::summary r = study::summarize(rate);
  return {{"mkeys_per_s", r.median},
          {"mkeys_per_s_least", r.least},
          {"mkeys_per_s_most", r.most},
          {"seconds", seconds}};
}

void print_rate(const json& r) {
  std::printf("  %9.2f (%.2f-%.2f)", double(r["mkeys_per_s"]), double(r["mkeys_per_s_least"]),
              double(r["mkeys_per_s_most"]));
}

/// Prints a line, and gives the same and more.
json row_of(const sort_times& t, const sort_plan& plan, unsigned key_bits, bool shows_steps) {
  json row{{"count", plan.count}, {"key_bits", key_bits}, {"bits", plan.bits}};
  row["device"] = rates(t.device, plan.count);
  row["wall"] = rates(t.wall, plan.count);
  std::printf("%9u u%u", plan.count, key_bits);
  print_rate(row["device"]);
  print_rate(row["wall"]);
  const auto add_peer = [&](const char* name, const std::vector<double>& seconds) {
    if (seconds.empty()) return;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < seconds.size(); ++i) ratios.push_back(seconds[i] / t.wall[i]);
    const study::summary ratio = study::summarize(ratios);
    row[name] = rates(seconds, plan.count);
    row[name]["ratio"] = {{"median", ratio.median}, {"least", ratio.least}, {"most", ratio.most}};
    std::printf("  %s %.2f: %.2f (%.2f-%.2f)", name, double(row[name]["mkeys_per_s"]), ratio.median,
                ratio.least, ratio.most);
  };
  add_peer("tbb", t.tbb);
  add_peer("std", t.standard);
  row["compile_ms"] = t.compile_ms;
  row["step_ms"] = t.steps;
  std::printf("\n");
  if (shows_steps)
    for (const auto& [kernel, ms] : t.steps) std::printf("%26s %9.4f ms\n", kernel.c_str(), ms);
  std::fflush(stdout);
  return row;
}

std::vector<std::uint32_t> whole(const std::vector<double>& from) {
  constexpr double most = tracer::radix_sort<std::uint32_t>::most_keys;
  std::vector<std::uint32_t> counts;
  for (const double n : from) {
    if (n != std::floor(n) || n < 1 || n > most) {
      char text[100];
      std::snprintf(text, sizeof text, "found %g; allowed are whole numbers from 1 to %.0f", n,
                    most);
      throw CLI::ValidationError("--count", text);
    }
    counts.push_back(std::uint32_t(n));
  }
  return counts;
}

void run(const arguments& o) {
  const std::vector<std::uint32_t> counts = whole(o.counts);
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = runtime::select_device(o.device);
  runtime::queue queue(device);
  sort_plan plan;
  plan.tuned = tuned(device, o);
  plan.is_order = o.is_order;
  plan.repeats = o.repeat;
  const std::string peer = tbb_version();
  plan.has_tbb = !peer.empty() && !o.no_peers;
  json report = head_of("facet-bench-sort", study::origin_now(device));
  report["settings"] = settings_of(plan.tuned.sort, o);
  report["peer"] = peer_of(o.no_peers ? "" : peer, std::thread::hardware_concurrency());
  report["results"] = json::array();
  std::printf("%s\nMkeys/s: median (least-most) by the device's events, by the host's clock%s\n",
              report["settings"].dump().c_str(),
              o.no_peers ? ""
              : peer.empty()
                  ? "; built without TBB: its figures are left out"
                  : "; a peer's, and how many times as fast the device is by the host's clock");
  for (const unsigned key_bits : o.keys)
    for (const std::uint32_t count : counts) {
      plan.count = count;
      plan.bits = o.bits == 0 ? key_bits : std::min(o.bits, key_bits);
      plan.has_std = !o.no_peers && count <= o.std_most;
      const sort_times times = key_bits == 32 ? measure_sort<std::uint32_t>(queue, plan)
                                              : measure_sort<std::uint64_t>(queue, plan);
      report["results"].push_back(row_of(times, plan, key_bits, o.shows_steps));
    }
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_sort_row(CLI::App& app) {
  auto o = std::make_shared<arguments>();
  CLI::App* row = app.add_subcommand("sort", "The device's radix sort against TBB and std::sort");
  row->add_option("--count", o->counts, "keys, such as 1e3 1e6")->capture_default_str();
  row->add_option("--keys", o->keys, "bits of a key: 32, 64")
      ->check(CLI::IsMember({32, 64}))
      ->capture_default_str();
  row->add_option("--bits", o->bits, "lowest bits to sort by; 0: all")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  row->add_flag("--order", o->is_order, "values start as 0, 1, 2, ... and are not read");
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--repeat", o->repeat, "timed sorts, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--std-most", o->std_most, "keys that std::sort is measured with, at most")
      ->capture_default_str();
  row->add_flag("--no-peers", o->no_peers, "the device alone");
  row->add_flag("--steps", o->shows_steps, "print each kernel's time");
  row->add_option("--flags", o->flags, "added to the compiler's options");
  row->add_option("--json", o->json, "write the figures to this file");

  const char* how = "How to sort (0 and auto: as the device is tuned)";
  row->add_option("--face", o->face)->check(CLI::IsMember({"auto", "group", "serial"}))->group(how);
  row->add_option("--ranking", o->ranking)
      ->check(CLI::IsMember({"auto", "portable", "ballot", "match"}))
      ->group(how);
  row->add_option("--look-back", o->look_back, "auto: where it is proven")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->group(how);
  row->add_option("--group", o->group, "work-items of a group, from 256 up")
      ->check(CLI::IsMember({0}) | CLI::Range(256, 1024))
      ->group(how);
  row->add_option("--items", o->items, "keys a work-item, at most 255")
      ->check(CLI::Range(0, 255))
      ->group(how);
  row->add_option("--window", o->window, "words that look-back asks for at once")
      ->check(CLI::Range(0, 64))
      ->group(how);
  row->add_option("--beside", o->beside, "values beside keys in local memory")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->group(how);
  row->add_option("--launches", o->launches, "of a sort that looks back")
      ->check(CLI::IsMember({"auto", "one", "many"}))
      ->group(how);
  row->add_option("--registers", o->registers, "of a work-item, at most (NVIDIA)")
      ->check(CLI::Range(0, 255))
      ->group(how);
  row->add_option("--copies", o->copies, "of a histogram's counters")
      ->check(CLI::Range(0, 8))
      ->group(how);
  row->add_option("--histogram-groups", o->histogram_groups)->group(how);
  row->add_option("--tiles", o->tiles, "of single work-items")->group(how);
  row->add_option("--few", o->few, "keys that one work-item sorts, at most")->group(how);
  row->add_option("--bucket-mean", o->bucket_mean, "keys, of buckets")->group(how);
  row->add_option("--bucket-room", o->bucket_room, "keys, of a core's cache")->group(how);
  row->add_option("--bucket-most", o->bucket_most, "keys that buckets are worth it with")
      ->group(how);
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
