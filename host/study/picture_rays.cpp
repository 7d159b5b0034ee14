#include "study/picture_rays.hpp"

namespace facet::study {

tracer::options counting_rays(tracer::options o) {
  o.packets = tracer::packet_kind::off;
  // The counters of faults, which a picture has few of or none, count nearest hits and shadows,
  // too.
  o.edits.push_back({"traverse.h", "  Query q;\n  Space space;",
                     "  atomic_inc(mode == FACET_CLOSEST ? &s->faults->refused : "
                     "&s->faults->crowded);\n  Query q;\n  Space space;"});
  return o;
}

picture_rays rays_of(const tracer::statistics& counting, const tracer::statistics& plain) {
  return {plain.rays, counting.refused - plain.refused - plain.rays,
          counting.crowded - plain.crowded};
}

}  // namespace facet::study
