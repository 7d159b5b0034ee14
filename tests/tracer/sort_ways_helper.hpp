// Every way that a radix sort can work on the test device, with tiles small enough to have many.
#pragma once

#include <string>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/tuning.hpp"

namespace facet::test {

struct sort_way {
  std::string name;
  tracer::tuning tuned;
  std::uint32_t tile_32, tile_64;  ///< keys a tile, for as many as there are few tiles
};

inline std::vector<sort_way> sort_ways() {
  using namespace tracer;
  std::vector<sort_way> ways;
  tuning serial = tuning_for(device());
  serial.sort.face = sort_face::serial;
  serial.sort.tiles = 7;
  serial.sort.tile_least = 1000;
  const auto add_serial = [&](const std::string& name, std::uint32_t few,
                              std::uint32_t bucket_most) {
    serial.sort.few = few;
    serial.sort.bucket_mean = 300;
    serial.sort.bucket_room = 500;
    serial.sort.bucket_most = bucket_most;
    ways.push_back({name, serial, 1000, 1000});
  };
  // A work-item alone keeps whole lines for each digit: more than a GPU's work-item may have.
  if (!device().is_gpu()) {
    add_serial("serial", 0, 0);
    add_serial("one work-item", 1u << 30, 0);
    add_serial("buckets", 0, 1u << 30);
    add_serial("buckets if keys spread", 0, 700);
  }

  tuning group = tuning_for(device());
  group.sort.face = sort_face::group;
  const auto add = [&](const std::string& name, look_back_use use, sort_ranking ranking,
                       std::uint32_t size, std::uint32_t items_32, std::uint32_t items_64,
                       bool beside, std::uint32_t whole_most = 0) {
    sort_tuning& s = group.sort;
    s.look_back = use;
    s.ranking = ranking;
    s.group_32 = s.group_64 = size;
    s.items_32 = items_32;
    s.items_64 = items_64;
    s.values_beside = beside;
    s.histogram_copies = beside ? 2 : 1;
    s.histogram_groups = 5;
    s.whole_most_32 = s.whole_most_64 = whole_most;
    ways.push_back({name, group, size * items_32, size * items_64});
  };
  const auto portable = sort_ranking::portable;
  add("looking back", look_back_use::always, portable, 256, 4, 3, false);
  add("looking back, values beside", look_back_use::always, portable, 512, 1, 2, true);
  constexpr std::uint32_t any = sort_tuning::any_count;
  add("one launch", look_back_use::always, portable, 256, 4, 3, false, any);
  add("one launch, values beside", look_back_use::always, portable, 256, 1, 2, true, any);
  add("one launch of few keys", look_back_use::always, portable, 256, 4, 3, false, 5000);
  add("counting", look_back_use::never, portable, 256, 4, 3, false);
  if (device().nvidia_compute_capability() >= 70)
    for (const sort_ranking by : {sort_ranking::ballot, sort_ranking::match}) {
      const std::string name = by == sort_ranking::ballot ? "ballot" : "match";
      add(name, look_back_use::always, by, 384, 20, 12, false);
      add(name + ", one launch", look_back_use::always, by, 512, 15, 11, false, any);
      add(name + ", one launch, values beside", look_back_use::always, by, 256, 5, 4, true, any);
      add(name + ", values beside", look_back_use::always, by, 256, 5, 4, true);
      add(name + ", counting", look_back_use::never, by, 256, 4, 3, false);
    }
  return ways;
}

}  // namespace facet::test
