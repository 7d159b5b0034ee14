// The watertight ray-triangle test of Woop, Benthin and Wald (JCGT 2013) with accurate edge
// functions, the distance held to the triangle's own slab interval, and a variant that gives each
// edge to exactly one of its triangles.
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "reference/space.hpp"

namespace facet::reference {

template <class T>
using corners = std::array<vec3<T>, 3>;

template <class T>
box3<T> bounds_of(const corners<T>& p) {
  return {min(min(p[0], p[1]), p[2]), max(max(p[0], p[1]), p[2])};
}

/// A corner seen along the ray, which runs along z from the origin on, in units of 2^e.
template <class T>
struct sheared {
  T x, y, z;

  sheared(const space<T>& s, const vec3<T>& corner) {
    const axes<T> a({std::fma(s.unit, corner.x, -s.start.x), std::fma(s.unit, corner.y, -s.start.y),
                     std::fma(s.unit, corner.z, -s.start.z)});
    x = std::fma(-s.Sx, a[s.kz], a[s.kx]);
    y = std::fma(-s.Sy, a[s.kz], a[s.ky]);
    z = a[s.kz];
  }
};

/// Twice the signed area of (ray, p, q), to within 2u of itself: Kahan's difference of products
/// (Jeannerod, Louvet, Muller 2013). Its sign is exact.
template <class T>
T edge(const sheared<T>& p, const sheared<T>& q) {
  const T second = p.y * q.x;
  return std::fma(p.x, q.y, -second) + std::fma(-p.y, q.x, second);
}

/// Sign of edge(p, q) for the ray moved by (e, e^2), e -> 0: 0 only if p and q coincide. A shared
/// edge has opposite signs in its two triangles, so exactly one of them owns a ray through it.
template <class T>
int shifted_sign(T e, const sheared<T>& p, const sheared<T>& q) {
  const auto sign = [](T x) { return (x > 0) - (x < 0); };
  if (e != 0) return sign(e);
  return p.y != q.y ? sign(p.y - q.y) : sign(q.x - p.x);
}

template <class T>
struct triangle_hit {
  T t, u, v;
};

/// A triangle seen along a ray: edge functions and the canonical hit.
template <class T>
class triangle_test {
 public:
  triangle_test(const space<T>& s, const corners<T>& p)
      : space_(s), p_(p), a_(s, p[0]), b_(s, p[1]), c_(s, p[2]) {
    u_ = edge(c_, b_), v_ = edge(a_, c_), w_ = edge(b_, a_);
  }

  /// The hit if it is accepted: edges and corners count as inside for every triangle they touch.
  /// `outer` limits t further (the world slab interval of the instance).
  std::optional<triangle_hit<T>> accept(const interval<T>& outer, T tmin, T tmax) const {
    if ((u_ < 0 || v_ < 0 || w_ < 0) && (u_ > 0 || v_ > 0 || w_ > 0)) return {};
    const T det = (u_ + v_) + w_;
    // Corners that coincide have no area, whatever underflow has made of it.
    if (det == 0 || p_[0] == p_[1]) return {};
    T t = std::fma(w_, c_.z, std::fma(v_, b_.z, u_ * a_.z)) / det * space_.t_of_unit;
    const interval<T> slab = space_.slab(bounds_of(p_)).meet(outer);
    if (!(slab.near <= slab.far)) return {};
    t = t < slab.near ? slab.near : t;
    // One zero: that of a face may have either sign, and devices keep either.
    t = (t > slab.far ? slab.far : t) + T(0);
    if (!(t >= tmin && t <= tmax)) return {};
    return triangle_hit<T>{t, v_ / det, w_ / det};
  }

  /// +1 if the ray enters through this triangle, -1 if it leaves, 0 if it passes beside it, an edge
  /// counting for one of its two triangles. Seen from the side where it is counter-clockwise, a
  /// triangle has positive edge functions.
  int side() const {
    const int u = shifted_sign(u_, c_, b_);
    if (u != shifted_sign(v_, a_, c_) || u != shifted_sign(w_, b_, a_)) return 0;
    return space_.turned ? -u : u;
  }

 private:
  const space<T>& space_;
  const corners<T>& p_;
  sheared<T> a_, b_, c_;
  T u_, v_, w_;
};

}  // namespace facet::reference
