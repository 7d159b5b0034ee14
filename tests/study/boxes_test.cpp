// Slabs and nodes.
#include "study/case_helper.hpp"

TEST_CASE("case 7: zeros in the direction") { facet::test::check_case(7); }
TEST_CASE("case 8: flat boxes") { facet::test::check_case(8); }
TEST_CASE("case 12: extreme nodes") { facet::test::check_case(12); }
