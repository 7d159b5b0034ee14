// A closed mesh never leaks.
#include "study/case_helper.hpp"

TEST_CASE("case 1: closed mesh, random rays") { facet::test::check_case(1); }
TEST_CASE("case 2: closed mesh, rays at vertices") { facet::test::check_case(2); }
TEST_CASE("case 3: closed mesh, rays along edges") { facet::test::check_case(3); }
TEST_CASE("case 4: closed meshes, moved and scaled") { facet::test::check_case(4); }
