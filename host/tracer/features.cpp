#include "tracer/features.hpp"

#include <array>
#include <utility>

namespace facet::tracer {
namespace {

struct named {
  bool features::*on;
  const char* name;
  const char* flag;
};

constexpr std::array<named, 5> names_and_flags{{
    {&features::instances, "instances", " -DFACET_NO_INSTANCES"},
    {&features::transparency, "transparency", " -DFACET_NO_TRANSPARENCY"},
    {&features::reflection, "reflection", " -DFACET_NO_REFLECTION"},
    {&features::smooth, "smooth", " -DFACET_NO_SMOOTH"},
    {&features::specular, "specular", " -DFACET_NO_SPECULAR"},
}};

std::vector<bool> shown_materials(const scene& s) {
  std::vector<bool> shown(s.materials.size(), false);
  std::vector<bool> seen(s.meshes.size(), false);
  for (const instance& i : s.instances) {
    if (i.material != instance::own_materials) {
      shown[i.material] = true;
    } else if (!seen[i.mesh]) {
      seen[i.mesh] = true;
      const mesh& m = s.meshes[i.mesh];
      if (m.materials.empty()) shown[0] = true;
      for (std::uint32_t k : m.materials) shown[k] = true;
    }
  }
  return shown;
}

}  // namespace

features features::of(const scene& s) {
  features f{false, false, false, false, false};
  f.instances = s.instances.size() != 1 || !s.instances[0].world_from_object.is_identity();
  for (const instance& i : s.instances) f.smooth = f.smooth || s.meshes[i.mesh].is_smooth();
  const std::vector<bool> shown = shown_materials(s);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (!shown[k]) continue;
    const material& m = s.materials[k];
    f.transparency = f.transparency || m.is_transparent();
    f.reflection = f.reflection || m.is_mirror();
    f.specular = f.specular || m.Ks.x > 0 || m.Ks.y > 0 || m.Ks.z > 0;
  }
  return f;
}

std::string features::flags() const {
  std::string text;
  for (const named& n : names_and_flags)
    if (!(this->*n.on)) text += n.flag;
  return text;
}

std::string features::names() const {
  std::string text;
  for (const named& n : names_and_flags)
    if (this->*n.on) text.append(text.empty() ? "" : ",").append(n.name);
  return text.empty() ? "none" : text;
}

}  // namespace facet::tracer
