#include "reference/shade.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "reference/optical_depth.hpp"
#include "reference/visit.hpp"

namespace facet::reference {
namespace {

/// The finaliser of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

template <class T>
vec3<T> exp(const vec3<T>& a) {
  return {std::exp(a.x), std::exp(a.y), std::exp(a.z)};
}

template <class T>
bool is_black(const vec3<T>& a) {
  return a == vec3<T>();
}

/// The unit direction behind the surface (Snell); nothing under total internal reflection.
template <class T>
std::optional<vec3<T>> refract(const vec3<T>& d, const vec3<T>& n, T eta) {
  const T cosi = -dot(n, d);
  const T k = 1 - (eta * eta) * (1 - cosi * cosi);
  if (k < 0) return {};
  return normalize(d * eta + n * (eta * cosi - std::sqrt(k)));
}

template <class T>
vec3<T> reflect(const vec3<T>& d, const vec3<T>& n) {
  return normalize(d - n * (2 * dot(n, d)));
}

}  // namespace

template <class T>
shader<T>::shader(const scene& s, const geometry<T>& g) : scene_(s), geometry_(g) {
  for (const material& m : s.materials) {
    vec3<T> depth;
    for (int i = 0; i < 3; ++i) depth[i] = T(-std::log(std::max(double(m.Kt[i]), 1e-30)));
    matter_.push_back({vec3<T>(m.Ke), vec3<T>(m.Ka), vec3<T>(m.Kd), vec3<T>(m.Ks), vec3<T>(m.Kr),
                       vec3<T>(m.Kt), vec3<T>(m.absorption()), depth, T(m.Ns), T(m.Ni),
                       m.is_transparent(), !is_black(m.Ks)});
    any_transparent_ = any_transparent_ || m.is_transparent();
  }
  for (const light& l : s.lights) {
    const bool is_point = l.type == light::kind::point;
    lamps_.push_back({is_point, vec3<T>(l.position),
                      is_point ? vec3<T>() : vec3<T>(-normalize(l.direction)), vec3<T>(l.colour),
                      T(l.constant), T(l.linear), T(l.quadratic)});
  }
}

template <class T>
std::uint32_t shader<T>::material_of(std::uint32_t instance, std::uint32_t triangle) const {
  const std::uint32_t whole = scene_.instances[instance].material;
  return whole != facet::instance::own_materials
             ? whole
             : geometry_.mesh_of(instance).material_of(triangle);
}

template <class T>
void shader<T>::path::note(std::uint64_t value) {
  signature = mix(signature + 0x9e3779b97f4a7c15u + value);
}

template <class T>
typename shader<T>::result shader<T>::trace(const vec3<T>& origin, const vec3<T>& direction,
                                            std::span<const std::uint32_t> around,
                                            std::uint32_t max_depth, road by) const {
  path p{max_depth, by, {}};
  media start(scene_.nesting);
  for (auto k = around.rbegin(); k != around.rend(); ++k) start.enter(*k);
  const bool hit = shade(p, origin, direction, {1, 1, 1}, 0, start);
  return {p.sum, hit, p.crowded, p.signature};
}

template <class T>
media shader<T>::within(std::uint32_t material) const {
  media m(scene_.nesting);
  if (material != miss) m.enter(material);
  return m;
}

template <class T>
passage<T> shader<T>::pass(const ray<T>& r, const media& around, road by) const {
  constexpr std::uint64_t opaque = ~std::uint64_t(0);
  if (!any_transparent_)
    return geometry_.occluded(r, by) ? passage<T>{{0, 0, 0}, opaque} : passage<T>{};

  const T tmin = r.tmin > 0 ? r.tmin : 0;
  const T end = r.tmax < infinity<T> ? r.tmax : 0;
  passage<T> p;
  optical_depth<T> depth;
  for (const std::uint32_t k : around.all()) depth.add(matter_[k].sigma * end);
  const bool dark = geometry_.visit(r, r.tmax, by, [&](const candidate<T>& c) {
    const triangle_test<T> test = c.test();
    const auto h = test.accept(c.outer(), tmin, r.tmax);
    if (!h) return false;
    const matter& m = matter_[material_of(c.instance, c.triangle)];
    if (!m.transparent) return true;
    const int side = test.side();
    if (side == 0) return false;
    const vec3<T> way = m.sigma * (end - h->t);
    depth.add(m.minus_ln_Kt);
    depth.add(side > 0 ? way : -way);
    p.met += mix((std::uint64_t(c.instance) << 32 | c.triangle) + std::uint64_t(side));
    return false;
  });
  if (dark) return {{0, 0, 0}, opaque};
  p.colour = depth.passing();
  return p;
}

template <class T>
void shader<T>::light_up(path& p, const lamp& l, const surface<T>& s, std::uint32_t material,
                         const vec3<T>& d, const media& around, vec3<T>& lit) const {
  const matter& m = matter_[material];

  vec3<T> towards = l.towards;
  T fade = 1;
  if (l.is_point) {
    const vec3<T> way = l.position - s.point;
    const T dist = length(way);
    towards = way / dist;
    const T g = (l.constant + l.linear * dist) + (l.quadratic * dist) * dist;
    fade = g > 1 ? 1 / g : 1;
  }
  const T ndl = dot(s.shading, towards);
  if (!(ndl > 0)) return p.note(0);

  const bool same_side = dot(s.geometric, towards) > 0;
  ray<T> shadow{same_side ? s.near_side() : s.far_side(), 0, towards, infinity<T>};
  media at_start = around;
  if (!same_side && m.transparent) {
    if (s.front)
      at_start.enter(material);
    else
      at_start.leave(material);
  }
  if (l.is_point) {
    const vec3<T> way = l.position - shadow.origin;
    shadow.tmax = length(way);
    shadow.direction = way / shadow.tmax;
  }
  const passage<T> way = pass(shadow, at_start, p.by);
  p.note(way.met + (same_side ? 1 : 2));
  if (way.is_dark()) return;

  T spec = 0;
  if (m.shiny) {
    const vec3<T> r = s.shading * (2 * ndl) - towards;
    const T rv = dot(r, -d);
    spec = rv > 0 ? std::pow(rv, m.Ns) : 0;
  }
  lit = lit + ((l.colour * fade) * way.colour) * (m.Kd * ndl + m.Ks * spec);
}

/// Adds what comes along the ray to the sum; true if the ray hits anything.
template <class T>
bool shader<T>::shade(path& p, const vec3<T>& o, const vec3<T>& d, vec3<T> throughput,
                      std::uint32_t depth, const media& around) const {
  const hit<T> h = geometry_.closest({o, 0, d, infinity<T>}, p.by);
  p.note(std::uint64_t(h.instance) << 32 | h.triangle);
  if (!h) {
    p.sum = p.sum + throughput * vec3<T>(scene_.background);
    return false;
  }
  if (!around.empty()) {
    vec3<T> sigma;
    for (const std::uint32_t k : around.all()) sigma = sigma + matter_[k].sigma;
    throughput = throughput * exp(-sigma * h.t);
  }

  const std::uint32_t material = material_of(h.instance, h.triangle);
  const matter& m = matter_[material];
  const surface<T> s = surface_at(geometry_, h, d);
  p.note(std::uint64_t(depth) << 33 |
         std::uint64_t(around.empty() ? miss : around.innermost()) << 1 | (s.front ? 1 : 0));
  vec3<T> lit = m.Ke + m.Ka * vec3<T>(scene_.ambient);
  for (const lamp& l : lamps_) light_up(p, l, s, material, d, around, lit);
  p.sum = p.sum + throughput * lit;
  if (depth == p.max_depth) return true;

  vec3<T> kr = m.Kr;
  std::optional<vec3<T>> inward;
  media behind = around;
  if (m.transparent) {
    const auto index = [&](const media& in) {
      return in.empty() ? T(1) : matter_[in.innermost()].Ni;
    };
    // Leaving an object that another one displaces bends nothing.
    const bool is_displaced = around.holds(material) && around.innermost() != material;
    T eta;
    if (s.front) {
      eta = index(around) / m.Ni;
      p.crowded += !behind.enter(material);
    } else {
      behind.leave(material);
      eta = (is_displaced ? index(around) : m.Ni) / index(behind);
    }
    inward = refract(d, s.shading, eta);
    // A shading normal can bend the ray to the wrong side; the geometric one cannot.
    if (inward && !(dot(*inward, s.geometric) < 0)) inward = refract(d, s.geometric, eta);
    // Nor can it at the critical angle, where the root is 0 but for rounding: that is reflection.
    if (inward && !(dot(*inward, s.geometric) < 0)) inward.reset();
    if (!inward) kr = kr + m.Kt;
    p.note(inward ? 3 : 4);
  }
  if (const vec3<T> left = throughput * kr; !is_black(left)) {
    vec3<T> r = reflect(d, s.shading);
    if (!(dot(r, s.geometric) > 0)) r = reflect(d, s.geometric);
    shade(p, s.near_side(), r, left, depth + 1, around);
  }
  if (const vec3<T> left = throughput * m.Kt; inward && !is_black(left))
    shade(p, s.far_side(), *inward, left, depth + 1, behind);
  return true;
}

template class shader<float>;
template class shader<double>;

}  // namespace facet::reference
