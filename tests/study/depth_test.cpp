// Trees of any shape and size.
#include "study/case_helper.hpp"

TEST_CASE("case 13: equal Morton codes") { facet::test::check_case(13); }
TEST_CASE("case 14: geometric series") { facet::test::check_case(14); }
TEST_CASE("case 25: many triangles, many instances") { facet::test::check_case(25); }
