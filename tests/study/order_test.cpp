// The same hit whatever the way.
#include "study/case_helper.hpp"

TEST_CASE("case 10: coplanar duplicates") { facet::test::check_case(10); }
TEST_CASE("case 11: one scene, every way to trace it") { facet::test::check_case(11); }
TEST_CASE("case 16: few triangles") { facet::test::check_case(16); }
