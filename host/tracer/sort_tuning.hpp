// How the radix sort is cut and by which means it works: what its speed, and nothing else, depends
// on.
#pragma once

#include <cstdint>

#include "runtime/device.hpp"

namespace facet::tracer {

/// Who sorts a tile: a work-group together (cl/radix_sort.cl), or a work-item alone, which is what
/// a CPU does best (cl/radix_serial.cl).
enum class sort_face { group, serial };

/// How a work-group ranks its keys (cl/tile_rank.h): anywhere, or by PTX with votes on each bit or
/// with match.any.
enum class sort_ranking { portable, ballot, match };

/// Whether groups tell each other their counts while they run (cl/look_back.h).
enum class look_back_use { if_proven, always, never };

struct sort_tuning {
  sort_face face = sort_face::serial;

  // Of work-groups.
  sort_ranking ranking = sort_ranking::portable;
  look_back_use look_back = look_back_use::if_proven;
  static constexpr std::uint32_t any_count = ~0u;
  std::uint32_t whole_most_32 = 0,
                whole_most_64 = 0;  ///< keys that are sorted in one launch, at most
  std::uint32_t group_32 = 256,
                group_64 = 256;  ///< work-items, at least 256, for keys of 32 and 64 bits
  std::uint32_t items_32 = 8, items_64 = 6;  ///< keys a work-item
  std::uint32_t window = 16;                 ///< words that look-back asks for at once
  bool values_beside = false;                ///< in local memory, beside the keys
  std::uint32_t registers = 0;  ///< a work-item has at most; 0: as NVIDIA's compiler likes
  std::uint32_t histogram_groups = 64;
  std::uint32_t histogram_copies = 1;  ///< of each counter

  // Of single work-items.
  std::uint32_t tiles = 64;         ///< tiles a pass is cut into, at most
  std::uint32_t tile_least = 4096;  ///< keys a tile holds at least
  std::uint32_t few = 16384;        ///< keys that one work-item sorts, at most
  std::uint32_t bucket_mean = 8192, bucket_room = 16384;  ///< keys; a core's cache holds 3 rooms
  std::uint32_t bucket_most = 65536;                      ///< keys that buckets are worth it with
};

/// Measured defaults by kind of device (`facet_bench sort`).
sort_tuning sort_tuning_for(const runtime::device& d);

}  // namespace facet::tracer
