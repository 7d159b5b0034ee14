#include "cli/tune_table.hpp"

#include <cstdio>

#include "study/tunables.hpp"

namespace facet::cli {
namespace {

std::string text_of(const study::relative_time& t) {
  if (t.rounds.empty()) return "";
  char text[64];
  std::snprintf(text, sizeof text, "%.3f [%.3f, %.3f]", t.median, t.range.low, t.range.high);
  return text;
}

/// What a trial has to say beside its time.
std::string remark_on(const study::choice_result& c, std::uint32_t k) {
  const study::trial& t = c.trials[k];
  if (!t.refused.empty()) return "refused: " + t.refused.substr(0, t.refused.find('\n'));
  if (k == 0) return "kept so far";
  if (c.challenger != k) return "";
  return "again: " + text_of(c.confirmation) + (c.taken == k ? ", taken" : ", not confirmed");
}

}  // namespace

void print_choice(const study::choice_result& c) {
  std::printf("%s: %s\n", c.name.c_str(), c.trials[c.taken].value.c_str());
  for (std::uint32_t k = 0; k < c.trials.size(); ++k)
    std::printf("  %-16s %-22s %s\n", c.trials[k].value.c_str(),
                text_of(c.trials[k].relative).c_str(), remark_on(c, k).c_str());
  std::fflush(stdout);
}

void print_values(const tracer::choices& values, const tracer::choices& usual) {
  for (const study::tunable& t : study::tunables()) {
    const std::string now = t.text(values), before = t.text(usual);
    std::printf("   %-14s %-16s %s\n", t.name.c_str(), now.c_str(),
                now == before ? "" : ("built in: " + before).c_str());
  }
}

}  // namespace facet::cli
