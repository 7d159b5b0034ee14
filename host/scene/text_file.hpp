// Text of mesh files: whole files, words and numbers, independent of the locale.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace facet {

/// The bytes of a regular file; throws scene_error with the path if it cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// Takes the next word, up to blanks (space, tab, CR, LF), off the front of `text`; empty at the
/// end.
std::string_view take_word(std::string_view& text);

/// Takes the next line off the front of `text`, without its end (LF, CR LF or CR).
std::string_view take_line(std::string_view& text);

/// `text` without blanks at either end.
std::string_view trimmed(std::string_view text);

/// The number that the whole word spells, with an optional sign; rounded correctly, infinite if it
/// is too large, and NaN or infinity if that is what it spells. Nothing if it is no number.
std::optional<double> number_of(std::string_view word);

/// Up to 10 significant digits, as in messages.
std::string text_of(double value);

}  // namespace facet
