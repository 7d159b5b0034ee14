// The texts that a program is made of, and how their includes are resolved.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace facet::runtime {

/// Texts by file name ("render.cl", "lib/vec.h"). Embedded by facet_embed (runtime/embed.cmake), or
/// read from a folder.
struct source_tree {
  std::map<std::string, std::string, std::less<>> files;
};

/// All files *.cl and *.h below `folder`, by their path in it with '/'. Throws errc::invalid if it
/// is no folder or a file cannot be read.
source_tree read_folder(const std::filesystem::path& folder);

/// The text of `main_file` with each `#include "x"` replaced by the file's text: x is looked for
/// beside the file that names it, then at the top of the tree. Each file is taken once; one named
/// inside #if ... #endif is guarded, so that it is there under either outcome. #line directives
/// keep names and lines in the compiler's messages. `#include <x>` is left alone. Throws
/// errc::invalid for an unknown name, with the file and line that name it.
std::string expand(const source_tree& sources, std::string_view main_file);

/// A compiler's log with "<kernel>:N", by which NVIDIA's names line N of the expanded text whatever
/// #line says, replaced by the file and the line in it.
std::string with_places(const std::string& log, std::string_view expanded);

}  // namespace facet::runtime
