#include "image/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "image/transfer.hpp"
#include "scene/vec.hpp"

namespace facet::image {
namespace {

using std::numbers::pi;
using plane = std::vector<double>;  ///< height * width values, row by row

struct matrix {
  std::array<vec3d, 3> row;

  vec3d operator*(const vec3d& v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
};

vec3d divide(const vec3d& a, const vec3d& b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }

matrix inverse(const matrix& m) {
  const vec3d &a = m.row[0], &b = m.row[1], &c = m.row[2];
  const vec3d x = cross(b, c), y = cross(c, a), z = cross(a, b);
  const double det = dot(a, x);
  return {{vec3d{x.x, y.x, z.x} / det, vec3d{x.y, y.y, z.y} / det, vec3d{x.z, y.z, z.z} / det}};
}

/// Linear sRGB and CIE XYZ. The primaries are those of IEC 61966-2-1, the white is D65 with the
/// five digits of ASTM E308, as the paper's evaluator has it.
struct colour_space {
  matrix xyz_from_rgb, rgb_from_xyz;
  vec3d white;

  colour_space() {
    const auto of = [](double x, double y) { return vec3d{x / y, 1, (1 - x - y) / y}; };
    const vec3d r = of(0.64, 0.33), g = of(0.30, 0.60), b = of(0.15, 0.06);
    white = of(0.31271, 0.32902);
    const matrix primaries{{vec3d{r.x, g.x, b.x}, vec3d{r.y, g.y, b.y}, vec3d{r.z, g.z, b.z}}};
    const vec3d amount = inverse(primaries) * white;
    xyz_from_rgb = {
        {primaries.row[0] * amount, primaries.row[1] * amount, primaries.row[2] * amount}};
    rgb_from_xyz = inverse(xyz_from_rgb);
  }
};

const colour_space& space() {
  static const colour_space s;
  return s;
}

/// XYZ by the white's, in YCxCz: the linear form of CIELAB in which contrast is filtered.
vec3d opponent(const vec3d& v) { return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)}; }
vec3d from_opponent(const vec3d& c) {
  const double y = (c.x + 16) / 116;
  return {c.y / 500 + y, y, y - c.z / 200};
}

/// CIELAB of a linear colour, its a and b scaled by 0.01 L: dark colours seem less colourful
/// (the Hunt effect).
vec3d hunt_lab(const vec3d& rgb) {
  constexpr double delta = 6.0 / 29;
  const auto f = [](double t) {
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const vec3d v = divide(space().xyz_from_rgb * rgb, space().white);
  const double x = f(v.x), y = f(v.y), z = f(v.z), lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

/// City blocks in lightness, Euclid in colour: HyAB of Abasi, Amani Tehran and Fairchild (2020).
double hyab(const vec3d& p, const vec3d& q) {
  const vec3d d = p - q;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// Weights of places -r to r; outside the picture its nearest pixel stands.
using kernel = std::vector<double>;

std::size_t clamped(std::ptrdiff_t at, std::size_t size) {
  return std::size_t(std::clamp(at, std::ptrdiff_t(0), std::ptrdiff_t(size) - 1));
}

plane along_rows(const plane& in, std::size_t width, std::size_t height, const kernel& k) {
  const auto r = std::ptrdiff_t(k.size() / 2);
  plane out(in.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x)
      for (std::ptrdiff_t i = -r; i <= r; ++i)
        out[y * width + x] +=
            k[std::size_t(i + r)] * in[y * width + clamped(std::ptrdiff_t(x) + i, width)];
  return out;
}

plane along_columns(const plane& in, std::size_t width, std::size_t height, const kernel& k) {
  const auto r = std::ptrdiff_t(k.size() / 2);
  plane out(in.size());
  for (std::size_t y = 0; y < height; ++y)
    for (std::ptrdiff_t i = -r; i <= r; ++i) {
      const double weight = k[std::size_t(i + r)];
      const double* row = &in[clamped(std::ptrdiff_t(y) + i, height) * width];
      for (std::size_t x = 0; x < width; ++x) out[y * width + x] += weight * row[x];
    }
  return out;
}

/// What the eye's sensitivity to contrast leaves of a channel: a sum of Gaussians over degrees,
/// a * sqrt(pi / b) * exp(-pi^2 x^2 / b) each (the paper's table 1).
struct sensitivity {
  double a, b;
};
constexpr sensitivity achromatic[] = {{1, 0.0047}}, red_green[] = {{1, 0.0053}},
                      blue_yellow[] = {{34.1, 0.04}, {13.5, 0.025}};

/// Three standard deviations of the widest of all these.
std::ptrdiff_t sensitivity_radius(double pixels_per_degree) {
  return std::ptrdiff_t(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
}

plane seen(const plane& in, std::size_t width, std::size_t height,
           std::span<const sensitivity> terms, double pixels_per_degree) {
  const std::ptrdiff_t r = sensitivity_radius(pixels_per_degree);
  plane out(in.size());
  double total = 0;
  for (const sensitivity& s : terms) {
    kernel k;
    double sum = 0;
    for (std::ptrdiff_t i = -r; i <= r; ++i) {
      const double x = double(i) / pixels_per_degree;
      k.push_back(std::exp(-pi * pi * x * x / s.b));
      sum += k.back();
    }
    const double weight = s.a * std::sqrt(pi / s.b);
    total += weight * sum * sum;
    const plane part = along_columns(along_rows(in, width, height, k), width, height, k);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight * part[i];
  }
  for (double& v : out) v /= total;
  return out;
}

/// Positive weights add up to 1, negative ones to -1.
void balance(kernel& k) {
  double above = 0, below = 0;
  for (const double w : k) (w > 0 ? above : below) += w;
  for (double& w : k) w /= w > 0 ? above : -below;
}

/// Detectors of edges and of points, as wide as features that the eye finds (0.082 degrees): the
/// first and the second derivative of a Gaussian across, the Gaussian along.
struct detectors {
  kernel edge, point, blur;

  explicit detectors(double pixels_per_degree) {
    const double sd = 0.5 * 0.082 * pixels_per_degree;
    const auto r = std::ptrdiff_t(std::ceil(3 * sd));
    for (std::ptrdiff_t i = -r; i <= r; ++i) {
      const auto x = double(i);
      const double g = std::exp(-x * x / (2 * sd * sd));
      blur.push_back(g);
      edge.push_back(-x * g);
      point.push_back((x * x / (sd * sd) - 1) * g);
    }
    balance(edge), balance(point), balance(blur);
  }
};

/// How strongly a detector answers at each pixel, over both directions.
plane feature(const plane& in, std::size_t width, std::size_t height, const kernel& across,
              const kernel& along) {
  plane x = along_columns(along_rows(in, width, height, across), width, height, along);
  const plane y = along_columns(along_rows(in, width, height, along), width, height, across);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::hypot(x[i], y[i]);
  return x;
}

/// What the two pipelines need of one picture.
struct view {
  std::vector<vec3d> colour;  ///< filtered, as hunt_lab
  plane edges, points;
};

view view_of(const picture& p, double pixels_per_degree) {
  const std::vector<std::uint8_t> bytes = to_bytes(p, transfer::srgb);
  const std::size_t width = p.width, height = p.height, pixels = width * height;
  std::array<plane, 3> channel;
  channel.fill(plane(pixels));
  plane luminance(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto linear = [&](std::size_t c) { return linear_from_srgb(bytes[4 * i + c] / 255.0); };
    const vec3d xyz = space().xyz_from_rgb * vec3d{linear(0), linear(1), linear(2)};
    const vec3d c = opponent(divide(xyz, space().white));
    channel[0][i] = c.x, channel[1][i] = c.y, channel[2][i] = c.z;
    luminance[i] = (c.x + 16) / 116;
  }
  const plane a = seen(channel[0], width, height, achromatic, pixels_per_degree),
              b = seen(channel[1], width, height, red_green, pixels_per_degree),
              c = seen(channel[2], width, height, blue_yellow, pixels_per_degree);
  view v;
  v.colour.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const vec3d rgb = space().rgb_from_xyz * (from_opponent({a[i], b[i], c[i]}) * space().white);
    v.colour.push_back(hunt_lab(min(max(rgb, vec3d{0, 0, 0}), vec3d{1, 1, 1})));
  }
  const detectors d(pixels_per_degree);
  v.edges = feature(luminance, width, height, d.edge, d.blur);
  v.points = feature(luminance, width, height, d.point, d.blur);
  return v;
}

constexpr double colour_exponent = 0.7, feature_exponent = 0.5;

/// A colour's distance as an error: the first 40% of the range that can occur take 95% of it.
double colour_error(double distance, double most) {
  constexpr double share = 0.4, height = 0.95;
  const double d = std::pow(distance, colour_exponent), knee = share * most;
  if (d < knee) return d * height / knee;
  return height + (d - knee) / (most - knee) * (1 - height);
}

std::string size_of(const picture& p) {
  return std::to_string(p.width) + "x" + std::to_string(p.height);
}

}  // namespace

flip_map flip(const picture& a, const picture& b, double pixels_per_degree) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("the pictures differ in size: " + size_of(a) + " and " +
                                size_of(b));
  const view p = view_of(a, pixels_per_degree), q = view_of(b, pixels_per_degree);
  const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), colour_exponent);
  flip_map m;
  m.width = a.width, m.height = a.height;
  m.error.reserve(p.colour.size());
  double sum = 0;
  for (std::size_t i = 0; i < p.colour.size(); ++i) {
    const double apart =
        std::max(std::abs(p.edges[i] - q.edges[i]), std::abs(p.points[i] - q.points[i]));
    const double features = std::pow(apart / std::numbers::sqrt2, feature_exponent);
    const double error = std::pow(colour_error(hyab(p.colour[i], q.colour[i]), most), 1 - features);
    m.error.push_back(float(error));
    sum += error;
    m.max = std::max(m.max, error);
  }
  if (!m.error.empty()) m.mean = sum / double(m.error.size());
  return m;
}

}  // namespace facet::image
