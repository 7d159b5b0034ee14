// Instances.
#include "study/case_helper.hpp"

TEST_CASE("case 20: instances") { facet::test::check_case(20); }
TEST_CASE("case 21: a seam between instances") { facet::test::check_case(21); }
