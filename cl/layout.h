// What traversal and shading read, what they write, and camera, lights and materials. Structures that cross
// between host and device: structure.h says how they are declared.
#ifndef FACET_LAYOUT_H
#define FACET_LAYOUT_H

#include "build_layout.h"

#ifndef __OPENCL_C_VERSION__
namespace facet::tracer {
#endif

// A node as traversal reads it: its two children's bounds, then what they are: a node's index, or a
// leaf (FACET_LEAF). It is also what other layouts are made from.
struct FACET_ALIGNED Node {
  float x[2][2];  // lo, hi
  float y[2][2];
  float z[2][2];
  uint child[2];
  uint spare[2];
};

// The wide layout, for CPUs: eight children to a node, triangles in blocks of eight.
#define FACET_BLOCK 8u

// Rays that a work-item traces together, where it does (packet.h): of a picture those of a tile, so many
// pixels wide.
#define FACET_PACKET 32u
#define FACET_PACKET_COLUMNS 8u
#define FACET_PACKET_ROWS (FACET_PACKET / FACET_PACKET_COLUMNS)

// As Node. A leaf is one block of triangles, or one instance. An absent child has bounds that no ray
// meets: lo = INFINITY, hi = -INFINITY.
struct FACET_ALIGNED WideNode {
  float x[2][8];  // lo, hi
  float y[2][8];
  float z[2][8];
  uint child[8];
  uint spare[8];
};

// The triangles of a leaf, a lane each: corner[k][axis][lane]. The triangle in lane i of block b is in
// slot FACET_BLOCK * b + i. A lane without a triangle holds one that no ray meets, a segment
// (cl/blocks.cl).
struct FACET_ALIGNED TriangleBlock {
  float corner[3][3][8];
};

// Where a triangle in leaf order comes from.
struct FACET_PAIR TriangleInfo {
  uint triangle;  // its index in the mesh
  uint material;
};

// A placed mesh. Matrices are three rows of four, row i at [4 * i].
struct FACET_ALIGNED Instance {
  float object_from_world[12];
  float world_from_object[12];
  float lo[3];  // bounds in the world (host/scene/world_bounds.hpp)
  uint id;      // its index in the scene
  float hi[3];
  uint root;    // of its mesh's tree
  float reach[3];  // largest |coordinate| of its mesh, by axis
  uint material;   // FACET_NONE: the mesh's own
  uint first_triangle, triangle_count;  // its slots; in the wide layout those of whole blocks
  uint spare[2];
};

// host/scene/material.hpp; sigma and minus_ln_Kt are what coloured shadows add up.
struct FACET_ALIGNED Material {
  float Ke[3];
  float Ns;
  float Ka[3];
  float Ni;
  float Kd[3];
  uint transparent;  // any Kt > 0
  float Ks[3];
  uint specular;  // any Ks > 0
  float Kr[3];
  uint spare0;
  float Kt[3];
  uint spare1;
  float minus_ln_Kt[3];
  uint spare2;
  float sigma[3];  // -ln(A) / D, per scene unit
  uint spare3;
};

#define FACET_POINT_LIGHT 0u
#define FACET_DIRECTIONAL_LIGHT 1u

struct FACET_ALIGNED Light {
  float position[3];  // of a point light; for a directional one the unit direction towards it
  uint kind;
  float colour[3];
  uint spare0;
  float falloff[3];  // constant, linear, quadratic
  uint spare1;
};

// Transparent objects that may lie within one another, at most.
#define FACET_MOST_NESTING 8

// All that a picture needs beside its geometry: camera (host/scene/scene.hpp: camera_frame),
// surroundings, limits.
struct FACET_ALIGNED View {
  float origin[3];
  uint width;
  float corner[3];
  uint height;
  float dx[3];
  uint max_depth;
  float dy[3];
  uint samples;  // a side of the grid in a pixel
  float background[3];
  float background_alpha;
  float ambient[3];
  uint light_count;
  uint media[FACET_MOST_NESTING];  // around the camera, innermost first, then FACET_NONE
};

// What traversal needs of the whole scene.
struct FACET_ALIGNED World {
  float reach[3];  // largest |coordinate| of the world's bounds, by axis
  uint root;       // of the tree over instances, or of the only mesh's tree
  uint instance_count;
  uint triangle_count;  // slots, as an instance's
  uint spare[2];
};

// A ray of the file format of `facet trace`; t counts in units of the direction's length.
struct FACET_ALIGNED Ray {
  float origin[3];
  float tmin;
  float direction[3];
  float tmax;
};

// A hit, or a miss: triangle FACET_NONE.
struct FACET_ALIGNED Hit {
  float t, u, v;
  uint triangle;
};

// What a kernel could not do, counted, so that the host can say it.
struct FACET_ALIGNED Faults {
  uint refused;  // rays, or their ways through an instance, that triangle.h's space_of refused
  uint crowded;  // transparent objects entered while the list of media was full (media.h)
  uint spare[2];
};

// What probe.cl tells of the surface that a ray meets: all that shading and the next rays start
// from. A miss has triangle FACET_NONE and is 0 otherwise.
struct FACET_ALIGNED SurfacePoint {
  float t, u, v;
  uint triangle;
  float p[3];
  uint instance;
  float geometric[3];  // against the ray
  float delta;
  float shading[3];
  uint is_front;
  float near_side[3];  // where rays start that leave to the ray's side
  uint material;
  float far_side[3];
  uint children;  // 1: a reflected ray follows; 2: a refracted one
  float reflected[3];
  uint spare0;
  float reflected_weight[3];
  uint spare1;
  float refracted[3];
  uint spare2;
  float refracted_weight[3];
  uint spare3;
};

// What probe.cl tells of the way to a light.
struct FACET_ALIGNED Passage {
  float transmittance[3];
  uint is_dark;  // something opaque stands in the way
  uint entries, exits;
  uint spare[2];
};

#define FACET_NONE 0xffffffffu

// A leaf as a child: count triangles (1 to 16) in leaf order from first (below 2^27). In the wide
// layout first is a block, or an instance, and count 1.
#define FACET_LEAF_BIT 0x80000000u
#define FACET_LEAF(first, count) (FACET_LEAF_BIT | (((count) - 1u) << 27) | (first))
#define FACET_LEAF_FIRST(child) ((child) & 0x07ffffffu)
#define FACET_LEAF_COUNT(child) ((((child) >> 27) & 15u) + 1u)

#ifdef __OPENCL_C_VERSION__
typedef struct Node Node;
typedef struct WideNode WideNode;
typedef struct TriangleBlock TriangleBlock;
typedef struct TriangleInfo TriangleInfo;
typedef struct Instance Instance;
typedef struct Material Material;
typedef struct Light Light;
typedef struct View View;
typedef struct World World;
typedef struct Ray Ray;
typedef struct Hit Hit;
typedef struct Faults Faults;
typedef struct SurfacePoint SurfacePoint;
typedef struct Passage Passage;
#endif

FACET_SIZE(Node, 64)
FACET_SIZE(WideNode, 256)
FACET_SIZE(TriangleBlock, 288)
FACET_SIZE(TriangleInfo, 8)
FACET_SIZE(Instance, 160)
FACET_SIZE(Material, 128)
FACET_SIZE(Light, 48)
FACET_SIZE(View, 128)
FACET_SIZE(World, 32)
FACET_SIZE(Ray, 32)
FACET_SIZE(Hit, 16)
FACET_SIZE(Faults, 16)
FACET_SIZE(SurfacePoint, 160)
FACET_SIZE(Passage, 32)

#ifndef __OPENCL_C_VERSION__
}  // namespace facet::tracer
#endif
#endif
