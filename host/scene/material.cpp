#include "scene/material.hpp"

#include <algorithm>
#include <cmath>

namespace facet {

vec3d material::absorption() const {
  if (!is_transparent()) return {0, 0, 0};
  const vec3f a = attenuation_colour();
  vec3d sigma;
  for (int i = 0; i < 3; ++i)
    sigma[i] = -std::log(std::max(double(a[i]), 1e-30)) / double(attenuation_distance);
  return sigma;
}

}  // namespace facet
