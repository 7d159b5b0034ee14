#include "study/variant_result.hpp"

#include <algorithm>

namespace facet::study {

double variant_result::per_million(std::uint64_t hit_errors::*count) const {
  const double traced = double(hits[0].errors.rays + hits[1].errors.rays);
  return traced > 0 ? 1e6 * double(hits[0].errors.*count + hits[1].errors.*count) / traced : 0;
}

double variant_result::wrong_per_million() const {
  return per_million(&hit_errors::ties) + per_million(&hit_errors::silhouettes) +
         per_million(&hit_errors::errors);
}

bool variants_result::has_findings() const {
  return std::any_of(variants.begin(), variants.end(),
                     [](const variant_result& v) { return v.is_judged; });
}

std::vector<std::string> variants_result::broken_promises() const {
  std::vector<std::string> lines;
  for (const variant_result& v : variants) {
    const std::uint64_t hits = v.hits[0].errors.other_bits + v.hits[1].errors.other_bits,
                        pixels = v.picture_error.other_bits;
    if (v.is_judged && v.of.is_exact && (hits > 0 || pixels > 0))
      lines.push_back(v.of.name + ": " + std::to_string(hits) + " hits and " +
                      std::to_string(pixels) + " pixels differ from strict's");
    if (v.of.is_exact && !v.is_repeatable)
      lines.push_back(v.of.name + ": not all its pictures have the same bits");
  }
  return lines;
}

void conclude(variants_result& r) {
  const resampling with{r.settings.resamples, r.settings.level, r.settings.seed};
  for (variant_result& v : r.variants) {
    v.picture.conclude(with);
    for (traced_rays& t : v.hits) t.kernel.conclude(with);
  }
}

}  // namespace facet::study
