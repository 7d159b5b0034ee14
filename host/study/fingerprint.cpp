#include "study/fingerprint.hpp"

#include <bit>
#include <cstdint>
#include <cstdio>

namespace facet::study {
namespace {

class fnv1a {
 public:
  void add(std::uint8_t byte) { state_ = (state_ ^ byte) * 0x100000001b3u; }
  /// Numbers go in from their lowest byte, whatever the machine's order.
  void add(std::uint32_t v) {
    for (int i = 0; i < 4; ++i) add(std::uint8_t(v >> (8 * i)));
  }
  void add(std::uint64_t v) {
    add(std::uint32_t(v));
    add(std::uint32_t(v >> 32));
  }
  void add(bool v) { add(std::uint8_t(v)); }
  void add(float v) { add(std::bit_cast<std::uint32_t>(v)); }
  void add(double v) { add(std::bit_cast<std::uint64_t>(v)); }
  void add(const std::string& text) {
    add(std::uint64_t(text.size()));
    for (char c : text) add(std::uint8_t(c));
  }
  template <class T>
  void add(const vec3<T>& v) {
    add(v.x), add(v.y), add(v.z);
  }
  /// The size goes first: no two lists of lists have the same bytes.
  template <class T>
  void add(const std::vector<T>& list) {
    add(std::uint64_t(list.size()));
    for (const T& item : list) add(item);
  }
  void add(const material& m) {
    add(m.Ke), add(m.Ka), add(m.Kd), add(m.Ks), add(m.Kr), add(m.Kt);
    add(m.Ns), add(m.Ni);
    add(m.has_attenuation), add(m.attenuation), add(m.attenuation_distance);
  }
  void add(const mesh& m) {
    add(m.positions), add(m.indices), add(m.normals), add(m.normal_indices), add(m.materials);
  }
  void add(const instance& i) {
    add(i.mesh), add(i.material);
    for (const auto& row : i.world_from_object.row)
      for (double v : row) add(v);
  }
  void add(const light& l) {
    add(l.type == light::kind::point);
    add(l.position), add(l.direction), add(l.colour);
    add(l.constant), add(l.linear), add(l.quadratic);
  }
  void add(const camera& c) { add(c.position), add(c.look_at), add(c.up), add(c.vertical_fov); }

  std::string text() const {
    char digits[32];
    std::snprintf(digits, sizeof digits, "fnv1a64:%016llx",
                  static_cast<unsigned long long>(state_));
    return digits;
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace

std::string fingerprint_of(const scene& s) {
  fnv1a h;
  h.add(s.view), h.add(s.samples), h.add(s.nesting);
  h.add(s.ambient), h.add(s.background), h.add(s.background_alpha);
  h.add(s.materials), h.add(s.meshes), h.add(s.instances), h.add(s.lights);
  return h.text();
}

std::string fingerprint_of(const std::string& text) {
  fnv1a h;
  for (char c : text) h.add(std::uint8_t(c));
  return h.text();
}

std::string fingerprint_of(const tracer::kernel_description& kernel) {
  fnv1a h;
  h.add(kernel.text), h.add(kernel.options);
  return h.text();
}

}  // namespace facet::study
