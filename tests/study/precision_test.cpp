// The distance of a hit against the exact one.
#include "study/case_helper.hpp"

TEST_CASE("case 5: slivers") { facet::test::check_case(5); }
TEST_CASE("case 6: grazing rays") { facet::test::check_case(6); }
TEST_CASE("case 9: tiny and huge directions") { facet::test::check_case(9); }
