// Where the next ray starts.
#include "study/case_helper.hpp"

TEST_CASE("case 18: leaving a surface") { facet::test::check_case(18); }
TEST_CASE("case 19: parallel sheets") { facet::test::check_case(19); }
TEST_CASE("case 24: bad shading normals") { facet::test::check_case(24); }
