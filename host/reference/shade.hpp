// The radiance along a ray: local terms, lights behind coloured glass, reflected and refracted
// rays, by recursion (Whitted 1980; the formula is in the README).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/geometry.hpp"
#include "reference/media.hpp"
#include "reference/surface.hpp"
#include "scene/scene.hpp"

namespace facet::reference {

/// What is left of a light's colour on the way to it.
template <class T>
struct passage {
  vec3<T> colour{1, 1, 1};
  std::uint64_t met = 0;  ///< a hash of the set of crossings; all ones if something opaque is met

  bool is_dark() const { return colour == vec3<T>(); }
};

template <class T>
class shader {
 public:
  shader(const scene& s, const geometry<T>& g);

  struct result {
    vec3<T> radiance;
    bool hit = false;             ///< of the eye ray
    std::uint64_t crowded = 0;    ///< objects entered beyond scene::nesting
    std::uint64_t signature = 0;  ///< of the whole tree of rays: which surfaces in which state
  };
  /// `around` are the materials of the media around the origin, innermost first.
  result trace(const vec3<T>& origin, const vec3<T>& direction,
               std::span<const std::uint32_t> around, std::uint32_t max_depth, road by) const;

  /// Light passing along r, whose origin lies in `around`; `r.tmax` is the distance of the light,
  /// or infinite. Each surface dims by Kt, each way inside by Beer-Lambert; opaque ones by all.
  passage<T> pass(const ray<T>& r, const media& around, road by) const;

  /// In one object of that material, or in none (miss).
  media within(std::uint32_t material) const;

 private:
  /// A material in the scalar, with the logarithms that ways through it are summed in.
  struct matter {
    vec3<T> Ke, Ka, Kd, Ks, Kr, Kt, sigma, minus_ln_Kt;
    T Ns, Ni;
    bool transparent, shiny;
  };
  struct lamp {
    bool is_point;
    vec3<T> position, towards, colour;
    T constant, linear, quadratic;
  };

  /// One eye ray under way: what its tree of rays adds to.
  struct path {
    std::uint32_t max_depth;
    road by;
    vec3<T> sum;
    std::uint64_t crowded = 0, signature = 0;

    void note(std::uint64_t value);
  };

  bool shade(path& p, const vec3<T>& o, const vec3<T>& d, vec3<T> throughput, std::uint32_t depth,
             const media& around) const;
  void light_up(path& p, const lamp& l, const surface<T>& s, std::uint32_t material,
                const vec3<T>& d, const media& around, vec3<T>& lit) const;
  std::uint32_t material_of(std::uint32_t instance, std::uint32_t triangle) const;

  const scene& scene_;
  const geometry<T>& geometry_;
  std::vector<matter> matter_;
  std::vector<lamp> lamps_;
  bool any_transparent_ = false;
};

extern template class shader<float>;
extern template class shader<double>;

}  // namespace facet::reference
