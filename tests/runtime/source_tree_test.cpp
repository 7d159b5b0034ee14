#include "runtime/source_tree.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/error.hpp"

using namespace facet::runtime;

namespace {

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

bool has(const std::string& text, const std::string& part) { return times(text, part) > 0; }

}  // namespace

TEST_CASE("each file is taken once, where it is first named") {
  const source_tree t{{{"main.cl", "#include \"a.h\"\n#include \"b.h\"\nmain_text\n"},
                       {"a.h", "#include \"b.h\"\na_text\n"},
                       {"b.h", "b_text\n"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(times(text, "a_text") == 1);
  CHECK(times(text, "b_text") == 1);
  CHECK(text.find("b_text") < text.find("a_text"));
  CHECK(text.find("a_text") < text.find("main_text"));
  CHECK_FALSE(has(text, "#include"));
}

TEST_CASE("#line directives name the file and line of what follows") {
  const source_tree t{
      {{"main.cl", "one\n#include \"a \\\"b\\\".h\"\nthree\n"}, {"a \\", "text\n"}}};
  CHECK(has(expand(t, "main.cl"), "#line 1 \"main.cl\"\none\n"));
  CHECK(has(expand(t, "main.cl"), "#line 1 \"a \\\\\"\ntext\n"));
  CHECK(has(expand(t, "main.cl"), "#line 3 \"main.cl\"\nthree\n"));
}

TEST_CASE("an unknown file is refused with the file and line that name it") {
  const source_tree t{{{"main.cl", "#include \"a.h\"\n"}, {"a.h", "\n  #  include \"gone.h\"\n"}}};
  CHECK_THROWS_WITH_AS(expand(t, "main.cl"), doctest::Contains("a.h:2: includes \"gone.h\""),
                       exception);
  CHECK_THROWS_WITH_AS(expand(t, "other.cl"), doctest::Contains("a.h, main.cl"), exception);
}

TEST_CASE("a name is looked for beside its file, then at the top") {
  const source_tree t{{{"main.cl", "#include \"lib/a.h\"\n"},
                       {"lib/a.h", "#include \"b.h\"\n#include \"c.h\"\n#include \"../d.h\"\n"},
                       {"b.h", "top_b\n"},
                       {"lib/b.h", "lib_b\n"},
                       {"c.h", "top_c\n"},
                       {"d.h", "top_d\n"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(has(text, "lib_b"));
  CHECK_FALSE(has(text, "top_b"));
  CHECK(has(text, "top_c"));
  CHECK(has(text, "top_d"));
}

TEST_CASE("comments, literals and <> are left alone") {
  const source_tree t{{{"main.cl",
                        "// #include \"x.h\"\n"
                        "/* text\n#include \"x.h\"\n*/ after\n"
                        "a = \"/*\"; b = '\\''; c = '\"';\n"
                        "#include <system.h>\n"
                        "#include \"y.h\"\n"
                        "/* one line */\n"
                        "#include \"z.h\"\n"},
                       {"y.h", "y_text"},
                       {"z.h", "z_text"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(times(text, "#include \"x.h\"") == 2);
  CHECK(has(text, "#include <system.h>"));
  CHECK(has(text, "y_text\n"));
  CHECK(has(text, "z_text\n"));
}

TEST_CASE("files that include each other, or themselves, end") {
  const source_tree t{
      {{"main.cl", "#include \"a.h\"\n"},
       {"a.h", "#include \"b.h\"\na_text\n"},
       {"b.h", "#include \"a.h\"\n#include \"b.h\"\n#include \"main.cl\"\nb_text\n"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(times(text, "a_text") == 1);
  CHECK(times(text, "b_text") == 1);
}

TEST_CASE("a file named under a condition is also there when the condition does not hold") {
  const source_tree t{{{"main.cl", "#ifdef NO\n#include \"a.h\"\n#endif\n#include \"a.h\"\nend\n"},
                       {"a.h", "a_text\n"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(times(text, "a_text") == 2);
  // Both under the same guard: the compiler sees one.
  const std::size_t guard = text.find("#ifndef FACET_INCLUDED_");
  REQUIRE(guard != text.npos);
  const std::string line = text.substr(guard, text.find('\n', guard) - guard);
  CHECK(times(text, line) == 2);
}

TEST_CASE("a guard around a whole file is no condition on what it includes") {
  const source_tree t{{{"main.cl", "#include \"a.h\"\n#include \"b.h\"\n"},
                       {"a.h", "// about\n#ifndef A_H\n#define A_H\n#include \"b.h\"\n#endif\n"},
                       {"b.h", "#pragma once\nb_text\n"}}};
  const std::string text = expand(t, "main.cl");
  CHECK(times(text, "b_text") == 1);
  CHECK_FALSE(has(text, "pragma"));
}

TEST_CASE("a folder is read with its subfolders, and only sources of it") {
  namespace fs = std::filesystem;
  std::string name = (fs::temp_directory_path() / "facet_source_XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  const fs::path folder = name;
  fs::create_directories(folder / "lib");
  std::ofstream(folder / "a.cl") << "a_text\n";
  std::ofstream(folder / "lib" / "b.h") << "b_text";
  std::ofstream(folder / "notes.txt") << "no source";
  const source_tree t = read_folder(folder);
  fs::remove_all(folder);
  CHECK(t.files == source_tree{{{"a.cl", "a_text\n"}, {"lib/b.h", "b_text"}}}.files);
  CHECK_THROWS_WITH_AS(read_folder(folder), doctest::Contains(name.c_str()), exception);
}

TEST_CASE("a log that counts lines of the whole text is told by file and line") {
  const source_tree t{{{"main.cl", "one\n#include \"a.h\"\nthree\n"}, {"a.h", "first\nsecond\n"}}};
  const std::string text = expand(t, "main.cl");
  // Find each word's line in the whole, as a compiler would count it.
  const auto line_of = [&](const std::string& word) {
    const std::size_t at = text.find("\n" + word + "\n");
    REQUIRE(at != text.npos);
    return std::to_string(times(text.substr(0, at + 1), "\n") + 1);
  };
  CHECK(with_places("<kernel>:" + line_of("second") + ":5: error", text) == "a.h:2:5: error");
  CHECK(with_places("x <kernel>:" + line_of("three") + " y <kernel>:" + line_of("one"), text) ==
        "x main.cl:3 y main.cl:1");
  CHECK(with_places("<kernel>:99999:1", text) == "<kernel>:99999:1");
  CHECK(with_places("main.cl:3: error", text) == "main.cl:3: error");
}
