// How a command group or the host uses memory (SYCL 2020, section 4.7.6.5).
#pragma once

namespace facet::runtime {

enum class access_mode { read, write, read_write };

constexpr bool reads(access_mode m) { return m != access_mode::write; }
constexpr bool writes(access_mode m) { return m != access_mode::read; }

template <access_mode M>
struct mode_tag {};

inline constexpr mode_tag<access_mode::read> read_only;
inline constexpr mode_tag<access_mode::write> write_only;
inline constexpr mode_tag<access_mode::read_write> read_write;

struct no_init_tag {};
/// What the memory held before need not be kept: all of it is written, or what is not is never
/// read. Saves the transfer of old contents.
inline constexpr no_init_tag no_init;

}  // namespace facet::runtime
