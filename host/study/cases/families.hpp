// The cases by family; each function makes its scenes, traces, and reports to the lab.
#pragma once

#include "study/cases/lab.hpp"

namespace facet::study {

// closed.cpp: a closed mesh never leaks.
void closed_random(lab& l);
void closed_vertices(lab& l);
void closed_edges(lab& l);
void closed_moved(lab& l);

// precision.cpp: t against the exact one.
void slivers(lab& l);
void grazing(lab& l);
void extreme_directions(lab& l);

// boxes.cpp: slabs and nodes.
void zero_directions(lab& l);
void flat_boxes(lab& l);
void extreme_nodes(lab& l);

// order.cpp: the same hit whatever the way.
void duplicates(lab& l);
void every_way(lab& l);
void few_triangles(lab& l);

// depth.cpp: trees of any shape and size.
void equal_codes(lab& l);
void geometric_series(lab& l);
void many(lab& l);

// bad.cpp: numbers and triangles that should not be.
void bad_vertices(lab& l);
void zero_areas(lab& l);

// leaving.cpp: where the next ray starts.
void leaving(lab& l);
void sheets(lab& l);
void bad_normals(lab& l);

// placed.cpp: instances.
void placed(lab& l);
void seams(lab& l);

// glass.cpp: media and crossings.
void critical_angle(lab& l);
void inside_glass(lab& l);
void glass_crossings(lab& l);

}  // namespace facet::study
