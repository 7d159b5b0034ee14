// Work of the host spread over threads.
#pragma once

#include <cstdint>
#include <functional>

namespace facet::study {

/// Calls body(first, last) for parts of [0, count) on that many threads; waits for all. What a
/// part throws is thrown here.
void in_parallel(unsigned threads, std::uint64_t count,
                 const std::function<void(std::uint64_t, std::uint64_t)>& body);

}  // namespace facet::study
