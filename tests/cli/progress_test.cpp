// Progress on a terminal, elsewhere, and not at all.
#include <doctest/doctest.h>

#include <csignal>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// A render that takes long enough for a bar; what it wrote to stderr until `sign` came, or all.
std::string said(bool terminal, std::vector<std::string> more, const std::string& sign) {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{"render",   (folder / "s.json").string(),
                                 "-o",       (folder / "out.npy").string(),
                                 "--device", "serial",
                                 "--width",  sign.empty() ? "64" : "4000"};
  words.insert(words.end(), more.begin(), more.end());
  surroundings s = without_devices();
  s.terminal = terminal;
  program p(words, s);
  if (!sign.empty()) {
    CHECK(p.wait_for(sign));
    p.send(SIGINT);
  }
  return p.wait().err;
}

}  // namespace

TEST_CASE("on a terminal a bar with an estimate is redrawn in place and wiped before the end") {
  if (!has_terminal()) return;
  const std::string text = said(true, {}, "left");
  CHECK(contains(text, "\rrendering ["));
  CHECK(contains(text, "%, about "));
  CHECK(contains(text, "\r\033[Kfacet: interrupted"));
}

TEST_CASE("elsewhere there are plain lines without control characters") {
  const std::string text = said(false, {}, "left");
  CHECK(contains(text, "facet: rendering "));
  CHECK(contains(text, "%, about "));
  CHECK(!contains(text, "\r"));
  CHECK(!contains(text, "\033"));
}

TEST_CASE("--quiet says nothing, on a terminal or elsewhere") {
  if (has_terminal()) CHECK(said(true, {"--quiet"}, "") == "");
  CHECK(said(false, {"-q"}, "") == "");
}

TEST_CASE("without --quiet the last line says what was written, where, and how long it took") {
  const std::string text = said(false, {}, "");
  CHECK(contains(text, "facet: wrote "));
  CHECK(contains(text, "out.npy, 64x43, in "));
  CHECK(contains(text, "on serial"));
}

TEST_CASE("-v says what was chosen") { CHECK(contains(said(false, {"-v"}, ""), "traced in ")); }
