#include "study/cases/report.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace facet::study {
namespace {

template <class... Args>
std::string text(const char* format, Args... args) {
  char line[320];
  std::snprintf(line, sizeof line, format, args...);
  return line;
}

std::string line_of(const finding& f) {
  std::string line = text("       %-72s ", f.what.c_str());
  if (f.measured) {
    line += text("%10.4g %s", *f.measured, f.unit.c_str());
    if (f.limit) line += text(" (at most %g)", *f.limit);
  } else {
    line += text("%10llu of %llu", static_cast<unsigned long long>(f.failed),
                 static_cast<unsigned long long>(f.tried));
    for (std::size_t k = 0; k < std::min<std::uint64_t>(f.failed, f.first.size()); ++k)
      line += text("%s%llu", k == 0 ? ": ray " : ", ", static_cast<unsigned long long>(f.first[k]));
  }
  return line + (f.is_met() ? "\n" : "  NOT MET\n");
}

std::uint64_t tried(const case_report& r) {
  std::uint64_t sum = 0;
  for (const finding& f : r.findings)
    if (f.is_goal) sum += f.measured ? 1 : f.tried;
  return sum;
}

}  // namespace

std::string table_head(bool with_mistakes) {
  return text("%4s  %-42s %13s %11s %8s  %-8s", "case", "", "checks", "failures", "s", "goal") +
         (with_mistakes ? "  failures with a mistake" : "");
}

std::string table_row(const case_report& r, const case_report* caught, bool detailed) {
  std::string row =
      text("%4d  %-42s %13llu %11llu %8.1f  %-8s", r.number, r.name.c_str(),
           static_cast<unsigned long long>(tried(r)), static_cast<unsigned long long>(r.failures()),
           r.seconds, r.is_met() ? "met" : "NOT MET");
  if (caught)
    row += text("  %llu (%s)%s", static_cast<unsigned long long>(caught->failures()),
                caught->mistake.c_str(), caught->failures() > 0 ? "" : " NOT CAUGHT");
  row += "\n";
  for (const finding& f : r.findings)
    if (detailed || !f.is_met()) row += line_of(f);
  if (detailed && caught) {
    row += text("       with %s:\n", caught->mistake.c_str());
    for (const finding& f : caught->findings) row += line_of(f);
  }
  return row;
}

nlohmann::ordered_json to_json(const case_report& r) {
  nlohmann::ordered_json out{{"case", r.number}, {"name", r.name}};
  if (!r.mistake.empty()) out["mistake"] = r.mistake;
  out["met"] = r.is_met();
  out["seconds"] = r.seconds;
  for (const finding& f : r.findings) {
    nlohmann::ordered_json one{{"what", f.what}, {"goal", f.is_goal}, {"met", f.is_met()}};
    if (f.measured) {
      one["measured"] = *f.measured;
      if (f.limit) one["limit"] = *f.limit;
      if (!f.unit.empty()) one["unit"] = f.unit;
    } else {
      one["tried"] = f.tried;
      one["failed"] = f.failed;
      const std::size_t kept = std::min<std::uint64_t>(f.failed, f.first.size());
      if (kept > 0)
        one["first"] =
            std::vector<std::uint64_t>(f.first.begin(), f.first.begin() + std::ptrdiff_t(kept));
    }
    out["findings"].push_back(std::move(one));
  }
  return out;
}

}  // namespace facet::study
