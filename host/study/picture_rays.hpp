// How many rays a picture takes, by kind: counted by kernels that are the same but for that.
#pragma once

#include <cstdint>

#include "tracer/tracer.hpp"

namespace facet::study {

struct picture_rays {
  std::uint64_t eye = 0;
  std::uint64_t bounced = 0;  ///< reflected and refracted
  std::uint64_t shadow = 0;   ///< one to each light that a surface faces
  std::uint64_t total() const { return eye + bounced + shadow; }
};

/// `o` with kernels that count, one pixel a work-item: where each ray begins a search of its own.
tracer::options counting_rays(tracer::options o);

/// From the statistics of a picture by kernels that count, and of the same picture by others.
picture_rays rays_of(const tracer::statistics& counting, const tracer::statistics& plain);

}  // namespace facet::study
