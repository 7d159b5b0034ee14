#include "scene/nearest.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "scene/place.hpp"

using facet::edit_distance;
using facet::in_quotes;
using facet::nearest;
using facet::unknown_name;

TEST_CASE("insertions, deletions, substitutions and swaps cost 1") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("glass", "glas") == 1);
  CHECK(edit_distance("glass", "glaass") == 1);
  CHECK(edit_distance("glass", "gloss") == 1);
  CHECK(edit_distance("glass", "lgass") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("the distance is symmetric, and blind to case") {
  CHECK(edit_distance("vertical", "verbal") == edit_distance("verbal", "vertical"));
  CHECK(edit_distance("NI", "Ni") == 0);
}

TEST_CASE("the nearest name wins, the first of equals, and none that is too far") {
  const std::vector<std::string> known{"position", "look_at", "up", "vertical_fov"};
  CHECK(nearest("fov", known) == "");
  CHECK(nearest("lookat", known) == "look_at");
  CHECK(nearest("Position", known) == "position");
  CHECK(nearest("vertical_fow", known) == "vertical_fov");
  CHECK(nearest("zzzz", known) == "");
  CHECK(nearest("bat", {"cat", "rat"}) == "cat");
  CHECK(nearest("x", {}) == "");
}

TEST_CASE("a name of any length is answered") {
  const std::string monster(1 << 20, 'a');
  CHECK(nearest(monster, {monster}) == "");
  CHECK(in_quotes(monster).size() < 80);
}

TEST_CASE("control characters do not reach the terminal") {
  CHECK(in_quotes("a\x1b[2Jb\n") == "\"a\\u001b[2Jb\\u000a\"");
}

TEST_CASE("the message suggests, lists, and cuts long lists") {
  CHECK(unknown_name("material", "glas", {"floor", "glass"}) ==
        "there is no material \"glas\"; did you mean \"glass\"? There are: \"floor\", \"glass\"");
  CHECK(unknown_name("mesh", "a", {}) == "there is no mesh \"a\"; there is none at all");
  const std::string cut = unknown_name("key", "q", std::vector<std::string>(1000, "name"));
  CHECK(cut.size() < 250);
  CHECK(cut.find("and 984 more") != std::string::npos);
}

TEST_CASE("places escape the two characters that JSON pointers escape") {
  CHECK(facet::place_in("/meshes", "a/b~c") == "/meshes/a~1b~0c");
  CHECK(facet::place_in("/instances", std::size_t(12)) == "/instances/12");
  CHECK(facet::place_in("", "") == "/");
}
