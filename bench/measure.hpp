// What every row needs of the machine: the clock.
#pragma once

#include <functional>

namespace facet::bench {

/// Seconds that one call takes, by the steady clock.
double seconds(const std::function<void()>& work);

}  // namespace facet::bench
