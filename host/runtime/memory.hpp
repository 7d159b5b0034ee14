// What buffers and images share: memory that lives on the host until a command first needs it on
// a device. Callers use buffer and image2d.
#pragma once

#include <cstddef>
#include <memory>

#include "runtime/access.hpp"
#include "runtime/native.hpp"

namespace facet::runtime::detail {

class memory;

/// `count` elements; throws errc::memory_allocation if their bytes are no size_t.
std::shared_ptr<memory> make_buffer(std::size_t count, std::size_t element_bytes);
/// width x height pixels of 4 floats; throws errc::invalid if a side is 0.
std::shared_ptr<memory> make_image2d(std::size_t width, std::size_t height);

/// Copies initial contents from `data`, all bytes of the memory.
void copy_in(memory& m, const void* data);
/// Uses the caller's memory for initial contents, and writes back to it.
void bind(memory& m, void* data);
/// Where the contents go when the last owner dies; null: nowhere.
void set_final_data(memory& m, void* data);
/// Whether they go there; stays off without final data.
void set_write_back(memory& m, bool on);
std::size_t byte_size(const memory& m) noexcept;
/// Null before the first use on a device.
native::memory native_handle(const memory& m);

/// Waits for the commands that conflict, then makes the contents readable or writable at the
/// pointer returned, until close_host. Throws errc::accessor if a host accessor in the way lives.
void* open_host(memory& m, access_mode mode, bool discard);
void close_host(memory& m, void* data, access_mode mode) noexcept;

}  // namespace facet::runtime::detail
