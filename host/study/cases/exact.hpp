// What is so in the reals: a ray against a triangle, without rounding.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "scene/vec.hpp"

namespace facet::study {

/// A ray and triangles on an integer grid, coordinates below 2^24 in size: edge functions fit 80
/// bits and are exact in __int128.
struct grid_point {
  std::int64_t x, y, z;
};

/// The grid's point at v, whose coordinates must be whole.
grid_point on_grid(vec3f v);

/// Whether o + t d, t >= 0, meets the triangle, edges and corners included. A ray in the triangle's
/// plane does not meet it.
bool grid_ray_meets(const grid_point& o, const grid_point& d, const std::array<grid_point, 3>& p);

/// An exact intersection, rounded at the very end.
struct exact_hit {
  double t, u, v;      ///< rounded from the rationals to the nearest double, or one beside it
  bool is_inside;      ///< strictly: no edge function is 0
  double least_share;  ///< the smallest of 1-u-v, u and v: how far from the edges
};

/// Of any floats, in GMP's rationals; nothing if the ray misses or lies in the triangle's plane. t
/// may be negative.
std::optional<exact_hit> meet_exactly(vec3d o, vec3d d, const std::array<vec3d, 3>& p);

/// t where the ray meets the triangle's plane, inside or beside it; NaN if it never does.
double plane_distance(vec3d o, vec3d d, const std::array<vec3d, 3>& p);

/// Only whether it meets the triangle with t >= 0: decided by double where its error bound allows,
/// by rationals elsewhere.
bool meets_exactly(vec3f o, vec3f d, const std::array<vec3f, 3>& p);

}  // namespace facet::study
