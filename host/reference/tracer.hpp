// The serial ray tracer: float is the program that speed-ups are measured against, double the
// oracle that errors are measured against. One thread, no OpenCL, the scene as it is.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "reference/ray.hpp"
#include "scene/picture.hpp"
#include "scene/scene.hpp"

namespace facet::reference {

/// Called after each row with done and total pixels; false stops the work.
using progress = std::function<bool(std::uint64_t done, std::uint64_t total)>;

/// The eye rays of a picture in the scalar; see camera_frame.
template <class T>
struct film {
  vec3<T> origin, corner, dx, dy;

  explicit film(const camera_frame& f) : origin(f.origin), corner(f.corner), dx(f.dx), dy(f.dy) {}

  /// Through the point (x, y) in pixels, y down; the direction has length 1.
  ray<T> through(T x, T y) const {
    return {origin, 0, normalize((corner + dx * x) + dy * y), infinity<T>};
  }
};

/// T is float or double. Queries may come from several threads at once.
template <class T>
class tracer {
 public:
  /// Keeps a reference to the scene, which must be valid (validate.hpp) and not change; builds
  /// trees.
  explicit tracer(const scene& s);
  ~tracer();
  tracer(tracer&&) noexcept;
  tracer& operator=(tracer&&) noexcept;

  /// The smallest (t, instance, triangle) with tmin <= t <= tmax. The _brute twins try every
  /// triangle and give the same bits.
  hit<T> closest(const ray<T>& r) const;
  hit<T> closest_brute(const ray<T>& r) const;
  bool occluded(const ray<T>& r) const;
  bool occluded_brute(const ray<T>& r) const;

  /// Every surface crossed between tmin and tmax, in the order of (t, instance, triangle).
  std::vector<crossing<T>> crossings(const ray<T>& r) const;
  std::vector<crossing<T>> crossings_brute(const ray<T>& r) const;

  /// What passes of a light along r, per channel: 0 if anything opaque is in the way. `medium` is
  /// the material that the origin lies in, if any; tmax is the light's distance in units of
  /// |direction|, which must be 1 for attenuation in scene units, or infinite.
  vec3<T> transmittance(const ray<T>& r, std::uint32_t medium = miss) const;
  vec3<T> transmittance_brute(const ray<T>& r, std::uint32_t medium = miss) const;

  /// Linear RGBA along one eye ray through a point of the film.
  std::array<T, 4> pixel(const film<T>& f, T x, T y, std::uint32_t max_depth) const;

  /// A hash of (instance, triangle, side, medium, depth, what each light passes through) over the
  /// whole tree of that eye ray: equal for two scalars where both met the same surfaces.
  std::uint64_t signature(const film<T>& f, T x, T y, std::uint32_t max_depth) const;

  /// The scene's camera, samples * samples rays a pixel. A pixel not reached before `on_progress`
  /// returned false is 0 in all channels.
  /// `crowded`, if given, becomes how often a ray entered a transparent object while it was in
  /// scene::nesting of them. Throws scene_error if the camera is in more.
  picture render(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                 const progress& on_progress = {}, std::uint64_t* crowded = nullptr) const;
  /// The same bits by a program that has no trees: each ray is tested against all triangles of the
  /// instances whose boxes it meets, as fast as that goes.
  picture render_without_tree(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                              const progress& on_progress = {}) const;

 private:
  struct state;
  std::unique_ptr<state> state_;
};

extern template class tracer<float>;
extern template class tracer<double>;

}  // namespace facet::reference
