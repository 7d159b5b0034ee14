#include "reference/tracer.hpp"

#include <algorithm>

#include "reference/geometry.hpp"
#include "reference/shade.hpp"
#include "reference/visit.hpp"
#include "scene/media.hpp"

namespace facet::reference {
namespace {

template <class T>
std::vector<crossing<T>> all_crossings(const geometry<T>& g, const ray<T>& r, road by) {
  const T tmin = r.tmin > 0 ? r.tmin : 0;
  std::vector<crossing<T>> found;
  g.visit(r, r.tmax, by, [&](const candidate<T>& c) {
    const triangle_test<T> test = c.test();
    if (const auto h = test.accept(c.outer(), tmin, r.tmax))
      if (const int side = test.side(); side != 0)
        found.push_back({h->t, c.instance, c.triangle, side > 0});
    return false;
  });
  std::sort(found.begin(), found.end(), [](const crossing<T>& a, const crossing<T>& b) {
    if (a.t != b.t) return a.t < b.t;
    return a.instance != b.instance ? a.instance < b.instance : a.triangle < b.triangle;
  });
  return found;
}

}  // namespace

template <class T>
struct tracer<T>::state {
  const scene& source;
  geometry<T> world;
  shader<T> light;

  std::vector<std::uint32_t> around_camera;  ///< innermost first

  explicit state(const scene& s)
      : source(s), world(s), light(s, world), around_camera(media_around_camera(s)) {}

  /// Along one eye ray of a film, which need not be that of the scene's camera.
  auto trace(const film<T>& f, T x, T y, std::uint32_t max_depth, road by) const {
    const vec3<T> direction = f.through(x, y).direction;
    if (f.origin == vec3<T>(source.view.position))
      return light.trace(f.origin, direction, around_camera, max_depth, by);
    return light.trace(f.origin, direction, media_at(source, vec3d(f.origin)), max_depth, by);
  }

  picture render(road by, std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                 const progress& on_progress, std::uint64_t* crowded) const {
    check_camera_media(source, around_camera);
    if (crowded) *crowded = 0;
    const film<T> f(frame_of(source.view, width, height));
    const std::uint32_t n = source.samples;
    picture out(width, height);
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        vec3<T> sum;
        T alpha = 0;
        for (std::uint32_t j = 0; j < n; ++j)
          for (std::uint32_t i = 0; i < n; ++i) {
            const T sx = T(x) + (T(i) + T(0.5)) / T(n), sy = T(y) + (T(j) + T(0.5)) / T(n);
            const auto r = trace(f, sx, sy, max_depth, by);
            sum = sum + r.radiance;
            alpha += r.hit ? T(1) : T(source.background_alpha);
            if (crowded) *crowded += r.crowded;
          }
        const T rays = T(n * n);
        const vec3<T> colour = sum / rays;
        float* p = out.at(x, y);
        p[0] = float(colour.x), p[1] = float(colour.y), p[2] = float(colour.z);
        p[3] = float(alpha / rays);
      }
      const auto row = std::uint64_t(width);
      if (on_progress && !on_progress(row * (y + 1), row * height)) break;
    }
    return out;
  }
};

template <class T>
tracer<T>::tracer(const scene& s) : state_(std::make_unique<state>(s)) {}
template <class T>
tracer<T>::~tracer() = default;
template <class T>
tracer<T>::tracer(tracer&&) noexcept = default;
template <class T>
tracer<T>& tracer<T>::operator=(tracer&&) noexcept = default;

template <class T>
hit<T> tracer<T>::closest(const ray<T>& r) const {
  return state_->world.closest(r, road::tree);
}
template <class T>
hit<T> tracer<T>::closest_brute(const ray<T>& r) const {
  return state_->world.closest(r, road::brute_force);
}
template <class T>
bool tracer<T>::occluded(const ray<T>& r) const {
  return state_->world.occluded(r, road::tree);
}
template <class T>
bool tracer<T>::occluded_brute(const ray<T>& r) const {
  return state_->world.occluded(r, road::brute_force);
}

template <class T>
std::vector<crossing<T>> tracer<T>::crossings(const ray<T>& r) const {
  return all_crossings(state_->world, r, road::tree);
}
template <class T>
std::vector<crossing<T>> tracer<T>::crossings_brute(const ray<T>& r) const {
  return all_crossings(state_->world, r, road::brute_force);
}

template <class T>
vec3<T> tracer<T>::transmittance(const ray<T>& r, std::uint32_t medium) const {
  return state_->light.pass(r, state_->light.within(medium), road::tree).colour;
}
template <class T>
vec3<T> tracer<T>::transmittance_brute(const ray<T>& r, std::uint32_t medium) const {
  return state_->light.pass(r, state_->light.within(medium), road::brute_force).colour;
}

template <class T>
std::array<T, 4> tracer<T>::pixel(const film<T>& f, T x, T y, std::uint32_t max_depth) const {
  const auto r = state_->trace(f, x, y, max_depth, road::tree);
  const vec3<T>& c = r.radiance;
  return {c.x, c.y, c.z, r.hit ? T(1) : T(state_->source.background_alpha)};
}

template <class T>
std::uint64_t tracer<T>::signature(const film<T>& f, T x, T y, std::uint32_t max_depth) const {
  return state_->trace(f, x, y, max_depth, road::tree).signature;
}

template <class T>
picture tracer<T>::render(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                          const progress& on_progress, std::uint64_t* crowded) const {
  return state_->render(road::tree, width, height, max_depth, on_progress, crowded);
}
template <class T>
picture tracer<T>::render_without_tree(std::uint32_t width, std::uint32_t height,
                                       std::uint32_t max_depth, const progress& on_progress) const {
  return state_->render(road::scan, width, height, max_depth, on_progress, nullptr);
}

template class tracer<float>;
template class tracer<double>;

}  // namespace facet::reference
