// What the cases are shown to catch: the mistakes that tracers make, each put into the kernels'
// text where ours does otherwise.
#pragma once

#include "study/cases/lab.hpp"

namespace facet::study {

mistake moller_trumbore();       ///< the usual test, each edge decided by itself
mistake determinant_epsilon();   ///< small determinants count as parallel
mistake world_plane();           ///< t from a plane equation about the world's origin
mistake contraction();           ///< plain edge functions, and a*b+c may become an fma
mistake unpadded();              ///< slabs as they come out
mistake far_padding();           ///< slabs padded at the far side alone
mistake unchecked_direction();   ///< any direction is used
mistake no_tie_break();          ///< of equal distances the first one met wins
mistake truncated_nodes();       ///< boxes of nodes in 8 bits of mantissa, cut off
mistake chained_ties();          ///< equal codes joined one after the other
mistake kept_bad_vertices();     ///< NaN and infinity reach the builder: the scene's doing
mistake short_leaves();          ///< a leaf's last triangle is left out
mistake open_points();           ///< a determinant of 0 is a hit
mistake constant_offset();       ///< secondary rays start 1e-4 away
mistake wrong_normals();         ///< normals travel like directions
mistake unchecked_refraction();  ///< the root of a negative number
mistake reversed_media();        ///< entering counts as leaving
mistake unchecked_normals();     ///< normals of length 0 are divided by their length
mistake wrapped_offsets();       ///< byte offsets wrap
mistake exclusive_edges();       ///< an edge belongs to neither of its triangles
mistake short_stack();           ///< more than 4 nodes that wait are not kept
mistake inclusive_edges();       ///< an edge is crossed in both of its triangles

}  // namespace facet::study
