// Media and crossings.
#include "study/case_helper.hpp"

TEST_CASE("case 22: the critical angle") { facet::test::check_case(22); }
TEST_CASE("case 23: glass within glass, eye and light inside") { facet::test::check_case(23); }
TEST_CASE("case 26: crossings of closed glass") { facet::test::check_case(26); }
