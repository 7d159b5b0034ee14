#include "study/variants.hpp"

#include "study/kernel_edits.hpp"

namespace facet::study {
namespace {

kernel_edits unordered() {
  return {
      {"query.h",
       "t >= q->t && (t > q->t || (q->slot != FACET_NONE && !is_before(s, place, slot, q->place, "
       "q->slot)))",
       "t >= q->t"},
      {"packet_hits.h", "mode == FACET_CLOSEST ? met & (hits.t", "false ? met & (hits.t"},
      {"stream.h", "t > ray->t || (best != FACET_NONE && !is_before(s, 0u, slot, 0u, best))",
       "true"}};
}

kernel_edits unheld() {
  return {{"triangle.h", "hits->is_doubtful = is_hit & is_doubtful;",
           "hits->is_doubtful = (Mask)(0);"}};
}

kernel_edits unchecked() {
  return {{"space.h", "largest >= 8.673617379884035e-19f &&", "true ||"},
          {"box.h", "is_known = fabs(c) < INFINITY;", "is_known = (int3)(-1);"},
          {"packet.h", "is_all(has_way & is_narrow)", "is_all(is_narrow)"},
          {"stream.h", "which & lanes_of(s.usable & (tmin <= tmax))", "which"},
          {"packet.h", "if (!is_all(fabs(offsets) < INFINITY)) return false;", ""},
          {"packet.h", "return beam_of(space->rays, part, centre, extent, &space->beam);",
           "beam_of(space->rays, part, centre, extent, &space->beam);\n  return true;"},
          {"beam.h", "return !is_none((Mask)(is_main, is_main));", "return true;"}};
}

}  // namespace

tracer::options with(const variant& v, tracer::options o) {
  o.edits.insert(o.edits.end(), v.edits.begin(), v.edits.end());
  o.compiler_flags += v.flags;
  return o;
}

std::vector<variant> inexact_variants() {
  std::vector<variant> all;
  const auto add = [&](const std::string& name, const std::string& about, kernel_edits e) {
    all.push_back({name, about, e, ""});
    e = joined({e, contracted()});
    all.push_back({name + ", contracted", about + "; a*b+c may become an fma", e, ""});
    all.push_back(
        {name + ", fast-math", about + "; -cl-fast-relaxed-math", e, " -cl-fast-relaxed-math"});
  };
  const kernel_edits unguarded = joined({unpadded_slabs(), unordered(), unchecked()});
  add("moller-trumbore", "Moeller and Trumbore's test, nothing padded or ordered",
      joined({unguarded, moller_trumbore_test()}));
  add("plain edges", "edge functions rounded, nothing padded, held or ordered",
      joined({unguarded, unheld(), rounded_edges()}));
  return all;
}

std::vector<variant> single_guards() {
  return {{"less the pad", "slabs as they come out", unpadded_slabs()},
          {"less the order", "the first of equal hits wins", unordered()},
          {"less the hold", "t is never held to the triangle's own interval", unheld()},
          {"always held", "t is held also where that is sure to change nothing", always_held()},
          {"less exact edges", "edge functions are rounded", rounded_edges()},
          {"less the checks", "no ray is refused", unchecked()}};
}

std::vector<variant> other_arithmetic() {
  return {{"contracted", "a*b+c may become an fma", contracted(), ""},
          {"fast-math", "-cl-fast-relaxed-math", contracted(), " -cl-fast-relaxed-math"}};
}

}  // namespace facet::study
