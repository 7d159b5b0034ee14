#include "study/visits.hpp"

#include <bit>

#include "tracer/layout.hpp"

namespace facet::study {

tracer::options counting_visits(tracer::options o) {
  o.packets = tracer::packet_kind::off;
  o.refill = tracer::refill_kind::off;
  const std::vector<tracer::kernel_edit> edits{
      {"query.h", "  float3 reach;\n  uint root,",
       "  float3 reach;\n  uint* visits;\n  uint root,"},
      {"query.h", "  TriangleHits hits;\n", "  TriangleHits hits;\n  ++s->visits[1];\n"},
      {"search_narrow.h", "  __global const Node* n = s->nodes + w->node;\n",
       "  __global const Node* n = s->nodes + w->node;\n  ++s->visits[0];\n"},
      {"search_wide.h", "      __global const WideNode* n = s->nodes + node;\n",
       "      __global const WideNode* n = s->nodes + node;\n      ++s->visits[0];\n"},
      {"trace.h", "  Query q = traverse(s,",
       "  uint visits[2] = {0u, 0u};\n  Scene counting = *s;\n  counting.visits = visits;\n"
       "  Query q = traverse(&counting,"},
      // A hit's shares are of no use here, and as wide as a count.
      {"trace.h", "  return q;\n",
       "  q.u = as_float(visits[0]);\n  q.v = as_float(visits[1]);\n  return q;\n"}};
  o.edits.insert(o.edits.end(), edits.begin(), edits.end());
  return o;
}

std::vector<visits> count_visits(tracer::device_scene& counting, std::span<const tracer::ray> rays,
                                 bool any) {
  std::vector<visits> counted;
  counted.reserve(rays.size());
  for (const tracer::hit& h : counting.trace(rays, any))
    counted.push_back({std::bit_cast<std::uint32_t>(h.u), std::bit_cast<std::uint32_t>(h.v)});
  return counted;
}

visit_bytes visit_bytes_of(const std::string& layout) {
  if (layout == "wide") return {sizeof(tracer::WideNode), sizeof(tracer::TriangleBlock)};
  return {sizeof(tracer::Node), 3 * 4 * sizeof(float)};
}

}  // namespace facet::study
