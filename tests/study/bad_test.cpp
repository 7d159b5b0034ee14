// Numbers and triangles that should not be.
#include "study/case_helper.hpp"

TEST_CASE("case 15: bad vertices") { facet::test::check_case(15); }
TEST_CASE("case 17: zero-area triangles") { facet::test::check_case(17); }
