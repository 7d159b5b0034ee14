// The list of media around a ray.
#include <doctest/doctest.h>

#include "reference/media.hpp"

using facet::reference::media;

TEST_CASE("the one entered last is innermost; any may be left") {
  media m(3);
  CHECK(m.empty());
  CHECK(m.enter(7));
  CHECK(m.enter(8));
  CHECK(m.innermost() == 8);
  m.leave(7);
  CHECK(m.innermost() == 8);
  CHECK_FALSE(m.holds(7));
  m.leave(8);
  CHECK(m.empty());
  m.leave(8);
  CHECK(m.empty());
}

TEST_CASE("of two alike the one entered last is left") {
  media m(4);
  m.enter(1), m.enter(2), m.enter(1), m.enter(3);
  m.leave(1);
  CHECK(m.all().size() == 3);
  CHECK(m.all()[0] == 1);
  CHECK(m.all()[1] == 2);
  CHECK(m.innermost() == 3);
}

TEST_CASE("a list that is full forgets the outermost, and says so") {
  media m(2);
  m.enter(1), m.enter(2);
  CHECK_FALSE(m.enter(3));
  CHECK(m.innermost() == 3);
  CHECK_FALSE(m.holds(1));
  CHECK(m.holds(2));
}
