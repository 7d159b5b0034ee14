// What a scene uses, and the compiler flags that leave out the rest (cl/features.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace facet::tracer {

struct features {
  bool instances = true;     ///< more than one instance, or one that is not the identity
  bool transparency = true;  ///< a material with Kt
  bool reflection = true;    ///< a material with Kr
  bool smooth = true;        ///< a mesh with normals
  bool specular = true;      ///< a material with Ks

  static features all() { return {}; }
  /// Only materials that some triangle of some instance shows count.
  static features of(const scene& s);

  /// Options for the compiler, each with a space before it: one -DFACET_NO_... for what is left
  /// out.
  std::string flags() const;
  /// The names of what is on, separated by commas; "none" if nothing is.
  std::string names() const;

  friend bool operator==(const features&, const features&) = default;
};

}  // namespace facet::tracer
