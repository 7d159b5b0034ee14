// Rays that are led through a tree in lists (search_stream.h), and the lists: memory that a work-item has to itself.
#ifndef FACET_STREAM_LAYOUT_H
#define FACET_STREAM_LAYOUT_H

#include "structure.h"

#ifndef __OPENCL_C_VERSION__
namespace facet::tracer {
#endif

// Rays of a stream at most, and rays in all lists that wait at once: more go alone.
#define FACET_STREAM 16384u
#define FACET_LISTS (8u * FACET_STREAM)

// What nodes ask of a ray, and its best hit so far.
struct FACET_ALIGNED StreamRay {
  float inverse[3], near_offset[3], far_offset[3];  // box.h: Slabs
  float tmin;
  float t;          // tmax, or the best hit's; -INFINITY: nothing more is looked for
  uint slot;        // of the best hit; FACET_NONE
  float origin[3];  // space.h: Rays, o
  unsigned char order[4];  // geometry.h: Order, and 0
};

// What triangles ask, too.
struct FACET_ALIGNED StreamRest {
  float shear[2], unit, t_of_unit;  // space.h: Space
  float v, w, det;                  // of the best hit (triangle.h: TriangleHits); det 0: not known
  uint from;                        // where the ray stands among those that were given
};

struct FACET_ALIGNED Stream {
  struct StreamRay ray[FACET_STREAM];
  struct StreamRest rest[FACET_STREAM];
  uint kind[FACET_STREAM];   // the signs of its direction, three bits
  uint order[FACET_STREAM];  // rays, kind by kind
  // The lists that wait, one after the other. After them is room for what is written and not wanted.
  uint list[FACET_LISTS + 4u];
  // Of the list that is being parted, by its places: the rays, and which children they meet.
  uint parted[FACET_STREAM], meets[FACET_STREAM];
};

#ifdef __OPENCL_C_VERSION__
typedef struct StreamRay StreamRay;
typedef struct StreamRest StreamRest;
typedef struct Stream Stream;
#endif

FACET_SIZE(StreamRay, 64)
FACET_SIZE(StreamRest, 32)
FACET_SIZE(Stream, FACET_STREAM * (64u + 32u + 8u + 32u + 8u) + 16u)

#ifndef __OPENCL_C_VERSION__
}  // namespace facet::tracer
#endif
#endif
