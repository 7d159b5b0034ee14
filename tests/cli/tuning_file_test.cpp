// Where a user's table of tuned defaults is looked for.
#include <doctest/doctest.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

TEST_CASE("where the table lies: FACET_TUNING, XDG_CONFIG_HOME, or the home") {
  if (!has_device()) return;
  const temporary_folder folder;
  const auto shown = [&](std::vector<std::string> environment) {
    return run({"tune", "--show"}, {environment}).out;
  };
  const std::string named = "FACET_TUNING=" + (folder / "a.json").string(),
                    config = "XDG_CONFIG_HOME=" + (folder / "b").string(),
                    home = "HOME=" + (folder / "c").string();
  CHECK(contains(shown({named, config, home}), "not in " + (folder / "a.json").string() + "\n"));
  CHECK(contains(shown({config, home}),
                 "not in " + (folder / "b" / "facet" / "tuning.json").string() + "\n"));
  CHECK(contains(shown({"XDG_CONFIG_HOME=relative", home}),
                 "not in " + (folder / "c" / ".config" / "facet" / "tuning.json").string() + "\n"));
  CHECK(contains(shown({"FACET_TUNING=", config, home}), "   built-in defaults\n"));
}

TEST_CASE("devices are listed with a table that cannot be read, and a note") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "t.json", "{");
  const outcome o = run({"devices"}, {{"FACET_TUNING=" + (folder / "t.json").string()}});
  CHECK(o.code == 0);
  CHECK(contains(o.err, "note: " + (folder / "t.json").string()));
  CHECK(contains(o.out, "compute units"));
}
