#include "scene/text_file.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/scratch_folder.hpp"

using namespace facet;
using namespace facet::test;

TEST_CASE("a word is a number only if all of it is one, rounded to the nearest double") {
  CHECK(number_of("0.1") == 0.1);
  CHECK(number_of("+1.5E2") == 150.0);
  CHECK(number_of("-.5") == -0.5);
  CHECK(number_of("5.") == 5.0);
  CHECK(number_of("1e999") == INFINITY);
  CHECK(number_of("-1e999") == -INFINITY);
  CHECK(number_of("1e-999") == 0.0);
  CHECK(std::isinf(number_of("inf").value()));
  CHECK(std::isnan(number_of("nan").value()));
  for (const char* word : {"", "+", "-", ".", "e5", "+-1", "--1", "++1", "1,5", "1.5x", "0x10",
                           "1 ", "one", "1e", "1.#INF"}) {
    CAPTURE(word);
    CHECK(!number_of(word));
  }
}

TEST_CASE("words and lines are taken off the front, whatever blanks and line ends there are") {
  std::string_view text = "  one\ttwo \r\n";
  CHECK(take_word(text) == "one");
  CHECK(take_word(text) == "two");
  CHECK(take_word(text) == "");
  CHECK(text.empty());
  std::string_view lines = "a\nb\r\n\rc d";
  for (const char* line : {"a", "b", "", "c d", ""}) CHECK(take_line(lines) == line);
  CHECK(trimmed(" \ta b\r\n") == "a b");
  CHECK(trimmed(" \t") == "");
}

TEST_CASE("a whole file is read byte by byte, and an empty one is empty") {
  const scratch_folder scratch;
  const std::string bytes("a\0\r\n\xff\x1a z", 8);
  CHECK(read_whole_file(scratch.write("a", bytes)) == bytes);
  CHECK(read_whole_file(scratch.write("b", "")).empty());
}
