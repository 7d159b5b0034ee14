// What a kernel is compiled with. Everything is on by default; a flag removes a feature that a
// scene does not use (host/tracer/features.hpp derives them), and with it its code and branches.
//   FACET_NO_INSTANCES     one mesh, placed by the identity: no top tree, no ray transforms
//   FACET_NO_TRANSPARENCY  no material with Kt: no refraction, no coloured shadows, no media
//   FACET_NO_REFLECTION    no material with Kr
//   FACET_NO_SMOOTH        no mesh with normals
//   FACET_NO_SPECULAR      no material with Ks
// and, chosen rather than derived:
//   FACET_GEOMETRY_IMAGE   positions and normals are read from image2d, not from buffers
//   FACET_WIDE             nodes of eight children, triangles in blocks of eight (layout.h); from buffers
//   FACET_TREE_NONE        brute force: every triangle is tested
//   FACET_STACK=n          entries of the traversal stack: one for each level, or seven (search_narrow.h, search_wide.h)
//   FACET_RAY_STACK=n      entries of the stack of pending rays: at least max_depth
//   FACET_NESTING=n        transparent objects that may lie within one another (media.h)
//   FACET_PACKET_WIDTH=x   how far apart rays may start that go together, as a share of the scene (packet.h)
//   FACET_HARDWARE_MINMAX, FACET_PORTABLE  see device.h
//   FACET_PTX              NVIDIA: work-items of a warp ask each other (warp.h)
#ifndef FACET_FEATURES_H
#define FACET_FEATURES_H

#include "layout.h"

#ifndef FACET_STACK
#define FACET_STACK 192
#endif
#ifndef FACET_RAY_STACK
#define FACET_RAY_STACK 64
#endif

#ifndef FACET_NESTING
#define FACET_NESTING FACET_MOST_NESTING
#endif

// A node as a kernel's traversal reads it.
#ifdef FACET_WIDE
typedef WideNode SceneNode;
#else
typedef Node SceneNode;
#endif

#if !defined(FACET_NO_TRANSPARENCY) || !defined(FACET_NO_REFLECTION)
#define FACET_SECONDARY
#endif

#endif
