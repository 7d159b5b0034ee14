// Suggestions for misspelt names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace facet {

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`
/// (optimal string alignment), without regard to ASCII case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to `found`, the first of equals; empty if none is near enough to be
/// meant: within a third of the longer name's length, and at least within 1.
std::string nearest(std::string_view found, const std::vector<std::string>& known);

/// The text in double quotes, control characters escaped, shortened if it is long.
std::string in_quotes(std::string_view text);

/// "there is no KIND "glas"; did you mean "glass"? There are: "floor", "glass""; long lists are
/// cut.
std::string unknown_name(std::string_view kind, std::string_view found,
                         const std::vector<std::string>& known);

}  // namespace facet
