#include "scene/json_reader.hpp"

#include <doctest/doctest.h>

#include <string>

#include "scene/scene.hpp"
#include "scene/scratch_folder.hpp"

using facet::json_document;
using facet::json_node;
using facet::test::contains;
using facet::test::error_of;
using facet::test::scratch_folder;

namespace {

json_document document_of(const std::string& text) {
  const scratch_folder folder;
  return facet::read_json_document(folder.write("x.json", text));
}

facet::scene_error syntax_error(const std::string& text) {
  return error_of([&] { document_of(text); });
}

}  // namespace

TEST_CASE("text that is not JSON is told with its line and column") {
  const auto truncated = syntax_error("{\n  \"a\": [1, 2");
  CHECK(contains(truncated.place(), "line 2, column 1"));
  CHECK(contains(truncated.what(), "end of input"));
  CHECK(contains(truncated.what(), "x.json: line 2"));
  CHECK(contains(syntax_error("").place(), "line 1, column 1"));
  CHECK(contains(syntax_error("{\"a\": nan}").place(), "line 1"));
  CHECK(contains(syntax_error("{} {}").place(), "line 1, column 4"));
  CHECK(contains(syntax_error("// hello\n{}").what(), "JSON has no comments"));
  CHECK(contains(syntax_error("{\"a\": \"\xff\"}").what(), "UTF-8"));
}

TEST_CASE("every truncation of a document is an error, not a crash") {
  const std::string whole = R"({"a": [1, -2.5e3, {"b": "c\u00e9"}], "d": null, "e": true})";
  CHECK(document_of(whole).root.size() == 3);
  for (std::size_t n = 0; n < whole.size(); ++n)
    CHECK(contains(syntax_error(whole.substr(0, n)).place(), "line 1"));
}

TEST_CASE("a key given twice is refused at its place") {
  const auto e = syntax_error(R"({"a": [{}, {"b/c": 1, "b/c": 1}]})");
  CHECK(e.place() == "/a/1/b~1c");
  CHECK(contains(e.what(), "given twice"));
  CHECK(document_of(R"({"a": {"b": 1}, "b": {"b": 2}, "c": [{"b": 1}, {"b": 1}]})").root.size() ==
        3);
}

TEST_CASE("a number that no double holds is refused at its place") {
  const auto e = syntax_error(R"({"a": [0, [1], {}, 1e999]})");
  CHECK(e.place() == "/a/3");
  CHECK(contains(e.what(), "too large"));
}

TEST_CASE("nesting is bounded") {
  CHECK(document_of(std::string(64, '[') + std::string(64, ']')).root.is_array());
  CHECK(contains(syntax_error(std::string(100000, '[')).what(), "64"));
}

TEST_CASE("a file that is missing, a folder or too large is told as such") {
  const scratch_folder folder;
  const auto missing = error_of([&] { facet::read_json_document(folder.path() / "no.json"); });
  CHECK(contains(missing.what(), "no.json: there is no such file"));
  CHECK(contains(error_of([&] { facet::read_json_document(folder.path()); }).what(), "folder"));
  const auto large = folder.write("large.json", "{}");
  std::filesystem::resize_file(large, facet::limits::scene_file + 1);
  CHECK(contains(error_of([&] { facet::read_json_document(large); }).what(), "256 MiB"));
}

TEST_CASE("a wrong type says what was found, where, and what is allowed") {
  const json_document d = document_of(
      R"({"t": "red", "n": 1.5, "a": [1, "x", 3], "b": true, "o": {}, "z": null, "short": [1, 2]})");
  const json_node root(d);
  const auto at = [&](const char* key) { return root.at(key, "something"); };
  CHECK(contains(error_of([&] { at("t").number(); }).what(),
                 "/t: expected a number, found the text \"red\""));
  CHECK(contains(error_of([&] { at("b").number(); }).what(), "found true"));
  CHECK(contains(error_of([&] { at("z").text(); }).what(), "expected a text, found null"));
  CHECK(contains(error_of([&] { at("o").size("an array"); }).what(), "found an object"));
  CHECK(contains(error_of([&] { at("n").boolean(); }).what(), "true or false, found 1.5"));
  CHECK(error_of([&] { at("a").vector(); }).place() == "/a/1");
  CHECK(contains(error_of([&] { at("short").vector(); }).what(),
                 "expected 3 numbers, [x, y, z], found an array of 2"));
  CHECK(contains(error_of([&] { at("t").colour(); }).what(), "or one for all three"));
  CHECK(contains(error_of([&] { at("missing"); }).what(), "\"missing\" is missing"));
}

TEST_CASE("whole numbers are whole and within their range, ends included") {
  const json_document d = document_of(R"([2.5, -1, 0, 9, 10, 1e300, 7.0, "7"])");
  const json_node root(d);
  const auto whole = [&](std::size_t i) { return root.element(i).whole(0, 9); };
  CHECK(whole(2) == 0);
  CHECK(whole(3) == 9);
  CHECK(whole(6) == 7);
  for (std::size_t i : {0, 1, 4, 5, 7})
    CHECK(contains(error_of([&] { whole(i); }).what(), "a whole number from 0 to 9"));
  CHECK(root.element(3).whole(9, 9) == 9);
  CHECK(contains(error_of([&] { root.element(2).whole(9, 9); }).what(), "expected 9, found 0"));
}

TEST_CASE("a number that is finite as double and not as float is refused") {
  const json_document d = document_of(R"([1e39, -1e39, 3.4028234e38, [0, 1e300, 0]])");
  const json_node root(d);
  CHECK(contains(error_of([&] { root.element(0).single(); }).what(), "3.4e38"));
  CHECK(error_of([&] { root.element(1).single(); }).place() == "/1");
  CHECK(root.element(2).single() > 3e38f);
  CHECK(error_of([&] { root.element(3).colour(); }).place() == "/3");
}

TEST_CASE("an unknown key is told with the nearest known one") {
  const json_document d = document_of(R"({"positon": 1})");
  const auto e = error_of([&] { json_node(d).check_keys("a camera", {"position", "up"}); });
  CHECK(e.place() == "/positon");
  CHECK(contains(e.what(), "in a camera there is no key \"positon\"; did you mean \"position\"?"));
  CHECK(contains(e.what(), "\"up\""));
}
