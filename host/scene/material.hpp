// What a surface does with light; the names are those of Wavefront MTL.
//
// A ray that meets a surface with the unit normal N, which faces the ray, brings
//
//   I = Ke + Ka Ia
//     + sum over the lights: L f(d) T (Kd max(0, N.l) + Ks max(0, R.v)^Ns)
//     + Kr I(reflected ray) + Kt I(refracted ray)        under total internal reflection Kt joins
//     Kr
//
// and is dimmed by A^(s/D) for a way s inside a medium. l leads to the light and counts only if
// N.l > 0, R is l mirrored at N, v leads back along the ray, f is the light's fall-off (scene.hpp)
// and T what passes from the light: the product of Kt over the surfaces on the straight way and
// of A^(s/D) inside, 0 behind anything opaque.
#pragma once

#include <string>

#include "scene/vec.hpp"

namespace facet {

/// All colours are linear, per channel, finite and at least 0.
struct material {
  std::string name;
  vec3f Ke{0, 0, 0};           ///< emission
  vec3f Ka{0, 0, 0};           ///< ambient reflection
  vec3f Kd{0.8f, 0.8f, 0.8f};  ///< diffuse reflection
  vec3f Ks{0, 0, 0};           ///< specular reflection of lights
  float Ns = 32;               ///< specular exponent, at least 0
  vec3f Kr{0, 0, 0};           ///< mirror reflection, at most 1
  vec3f Kt{0, 0, 0};           ///< transmission at each surface crossed, at most 1; 0 is opaque
  float Ni = 1;                ///< index of refraction, greater than 0
  /// Colour left of white after `attenuation_distance` inside; absent means Kt.
  bool has_attenuation = false;
  vec3f attenuation{1, 1, 1};
  float attenuation_distance = 1;  ///< scene units, greater than 0

  vec3f attenuation_colour() const { return has_attenuation ? attenuation : Kt; }
  bool is_transparent() const { return Kt.x > 0 || Kt.y > 0 || Kt.z > 0; }
  bool is_mirror() const { return Kr.x > 0 || Kr.y > 0 || Kr.z > 0; }
  /// sigma = -ln(A)/D per channel and scene unit (Beer-Lambert); 0 for opaque materials.
  /// A channel with A = 0 takes A = 1e-30: e^-69 a unit, black in any picture and finite in any
  /// sum.
  vec3d absorption() const;

  friend bool operator==(const material&, const material&) = default;
};

}  // namespace facet
