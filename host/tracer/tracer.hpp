// The device ray tracer, as a caller sees it: a scene goes to a device once, then pictures and
// hits come back.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/picture.hpp"
#include "scene/scene.hpp"
#include "tracer/choices.hpp"

namespace facet::tracer {

/// none: every triangle is tested. levels: neighbours along the Morton curve are joined
/// (levels.hpp). binned: splits by the surface area heuristic (tree_builder.hpp).
enum class tree_kind { none, levels, binned };
/// As the command line names it.
const char* word_of(tree_kind kind);
enum class geometry_kind { automatic, buffer, image };
/// How a kernel finds trees and triangles: two children to a node and one triangle at a time, for
/// GPUs, or eight of both at a time, for CPUs. Hits are the same. Images are for `narrow`.
enum class layout_kind { automatic, narrow, wide };

/// Whether a work-item takes FACET_PACKET rays or pixels (cl/layout.h), their rays together where
/// they stay close, or one. It can in the wide layout, with a tree.
enum class packet_kind { automatic, on, off };

/// Whether the work-items of a warp take new rays while others of it are on their way
/// (cl/refill.h), or each has one ray. They can in the narrow layout, with a tree. Hits are the
/// same. Of `trace` alone; automatic: for any hit, and where a sample of
/// the rays shows that many would wait, on devices whose warps are known.
enum class refill_kind { automatic, on, off };

/// Whether rays that do not stay close go through the tree in lists, node by node
/// (cl/search_stream.h), or one after the other. They can on a CPU, beside packets, in a scene of
/// one mesh that is placed by the identity. Hits are the same. Of `trace` alone; automatic: for
/// many rays.
enum class stream_kind { automatic, on, off };

/// A change of the kernels' text: `from`, which must stand in `file` exactly once, becomes `to`.
struct kernel_edit {
  std::string file, from, to;
};

struct options {
  tree_kind tree = tree_kind::binned;
  geometry_kind geometry = geometry_kind::automatic;
  layout_kind layout = layout_kind::automatic;
  packet_kind packets = packet_kind::automatic;
  /// A work-item for each sample, where pixels have several or rays part at glass and none go in
  /// packets; none: on GPUs. Not where a work-group is asked for.
  std::optional<bool> samples_apart;
  std::optional<bool> glass_first;  ///< then, work-groups that come to glass; none: if it pays
  refill_kind refill = refill_kind::automatic;
  stream_kind streams = stream_kind::automatic;
  std::uint32_t group_width = 0, group_height = 0;  ///< work-group; 0: the device's default
  bool driver_group = false;                        ///< the driver chooses the work-group instead
  std::uint32_t tile_width = 0, tile_height = 0;    ///< pixels a launch; 0: about 50 ms each
  bool movable = false;                             ///< see device_scene::move_vertices, place
  bool starts_soon = false;                         ///< a CPU compiles less, and may build longer
  bool all_features = false;                        ///< compile what the scene does not need, too
  std::string kernel_folder;                        ///< read cl/ from here, not from the library
  std::vector<kernel_edit> edits;                   ///< how a variant differs, in order
  std::string compiler_flags;                       ///< added to those of every program
  /// What `automatic` and work-groups of 0 mean, as measured on the device; none: by its kind
  /// (tuning.hpp). What the fields above name goes before it.
  std::optional<choices> defaults;
};

/// A binary tree over a mesh's triangles that the caller has made, in place of the device's. Only
/// its shape counts: boxes are those of the mesh.
struct given_tree {
  /// A leaf holds `count` > 0 triangles from `first` on in `order`, the leaves one after the other;
  /// an inner node (`count` 0) has its children at `first` and `first + 1`.
  struct node {
    std::uint32_t first, count;
  };
  std::vector<node> nodes;           ///< the root first
  std::vector<std::uint32_t> order;  ///< each triangle of the mesh once
};

/// One ray of `trace`: 32 bytes, as in the file format of `facet trace`.
struct ray {
  float origin[3];
  float tmin;
  float direction[3];  ///< any length; t counts in its units
  float tmax;
};

inline constexpr std::uint32_t miss = 0xffffffffu;

/// The canonical hit: the smallest (t, instance, triangle) with tmin <= t <= tmax.
/// The point is (1-u-v)*p0 + u*p1 + v*p2. A miss has instance and triangle `miss`, t = tmax, u = v
/// = 0.
struct hit {
  float t, u, v;
  std::uint32_t instance, triangle;
};

/// The surface that a ray meets and the rays that follow it, as shading sees them; a miss has
/// triangle `miss` and is 0 but for t. The sides are where rays start that leave it.
struct surface_point {
  hit met;
  bool is_front;
  std::uint32_t material;
  vec3f point, geometric, shading;  ///< unit normals, against the ray
  float delta;                      ///< how far the sides lie from the point
  vec3f near_side, far_side;
  bool reflects, refracts;
  vec3f reflected, reflected_weight;  ///< unit direction, and the share of its radiance
  vec3f refracted, refracted_weight;
};

/// What passes along a ray, and how many transparent surfaces it enters and leaves.
struct passage {
  vec3f transmittance;
  bool is_dark;  ///< something opaque stands in the way; the counts are then those met before it
  std::uint32_t entries, exits;
};

/// Times in milliseconds: device times from events, compile and wall times from the host's clock.
struct statistics {
  std::string device, platform, driver;
  double compile_ms = 0;          ///< programs, all of them; of those made before, too
  double upload_ms = 0;           ///< packing and moving the scene, host clock
  double build_ms = 0;            ///< tree, host clock from first launch to last
  std::vector<double> kernel_ms;  ///< trace: one a repeat; render: the sum over the tiles, once
  double wall_ms = 0;             ///< first timed launch until the result is on the host
  std::uint64_t rays = 0;         ///< trace: those given; render: eye rays
  std::uint32_t group_width = 0, group_height = 0;  ///< 0 where the driver chose
  std::uint32_t tiles = 0;
  std::string geometry;                ///< "image" or "buffer", as chosen
  std::string layout;                  ///< "wide" or "narrow", as chosen
  std::uint32_t rays_a_work_item = 1;  ///< or pixels
  bool is_refilled = false;            ///< trace: as refill_kind has it
  bool is_streamed = false;            ///< trace: as stream_kind has it
  bool is_tuned = false;               ///< by options::defaults, not by the kind of device
  std::string features;                ///< what the kernel was compiled with, comma-separated
  std::uint32_t tree_depth = 0;
  std::uint64_t tree_nodes = 0;
  std::uint64_t device_bytes = 0;
  std::uint64_t peak_bytes =
      0;  ///< on the device while the geometry was made, what it keeps included
  /// Rays, of the last repeat, that could not be used: not finite, or out of range
  /// (cl/triangle.h: space_of). They meet nothing.
  std::uint64_t refused = 0;
  /// Times that a ray entered a transparent object while it was in scene::nesting of them.
  std::uint64_t crowded = 0;
};

/// A kernel as compiled.
struct kernel_description {
  std::string text;             ///< its source, all includes expanded
  std::string options;          ///< the compiler's flags
  std::size_t group_items = 0;  ///< the most work-items of a group that it can have
};

/// Called after each tile with done and total pixels.
using progress = std::function<void(std::uint64_t done, std::uint64_t total)>;

/// Thrown out of render when `cancel` became true: the tile under way was finished, the rest not.
struct cancelled : std::runtime_error {
  std::uint64_t done, total;  ///< pixels
  cancelled(std::uint64_t pixels_done, std::uint64_t pixels_total)
      : std::runtime_error("cancelled"), done(pixels_done), total(pixels_total) {}
};

struct traced_trees;  // plain_tree.hpp

/// A scene on a device: packed, its tree built. Throws runtime::exception for what the device
/// refuses (a work-group too large, memory that does not fit, a compile error), with the figures.
class device_scene {
 public:
  /// `given`: trees of the first meshes; those of the rest, and of instances, are the device's.
  /// Throws runtime::exception (invalid) if one is not a tree over its mesh.
  device_scene(runtime::queue queue, const scene& s, options o = {},
               std::span<const given_tree> given = {});
  ~device_scene();
  device_scene(device_scene&&) noexcept;
  device_scene& operator=(device_scene&&) noexcept;

  /// Renders scene's camera at width x height. `stats` may be null.
  picture render(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                 statistics* stats = nullptr, const progress& on_progress = {},
                 const std::atomic<bool>* cancel = nullptr);

  /// The work-group of later pictures, as options has it: 0 x 0 is the device's default.
  void set_work_group(std::uint32_t width, std::uint32_t height);
  /// The driver chooses the work-group of later pictures.
  void leave_work_group_to_driver();

  /// The kernel of pictures of that depth; compiles it unless that was done before.
  kernel_description describe_render(std::uint32_t max_depth);

  /// A mesh's vertices move, its triangles stay: pictures and hits are then those of a device_scene
  /// made from the scene as it is now, bit for bit. The mesh's tree keeps its shape, with boxes
  /// that fit (cl/refit.cl), so the further vertices move apart, the slower it may be traced; the
  /// tree over instances is built anew. `positions`: as many as the mesh has. `normals`: as many,
  /// or none: they stay. The first move of a mesh puts its vertices and indices on the device,
  /// which stay there. Throws runtime::exception (invalid) if the scene was not made with
  /// options::movable, has no such mesh, or another number of either; scene_error for vertices that
  /// no scene may have (scene/validate.hpp). Nothing has changed then. After another error the
  /// scene is to be made anew.
  void move_vertices(std::uint32_t mesh, std::span<const vec3f> positions,
                     std::span<const vec3f> normals = {});

  /// Instances move, all at once: `world_from_object` has one for each instance of the scene, in
  /// its order. As above; meshes' trees are left as they are. Kernels are compiled anew if the
  /// scene's only instance was placed by the identity before, and is not now.
  void place(std::span<const transform> world_from_object);

  /// Traces `rays`; `any` stops at the first accepted triangle and fills only instance and
  /// triangle with 0 for a hit (which one is not defined), t, u, v with 0.
  std::vector<hit> trace(std::span<const ray> rays, bool any = false, unsigned repeat = 1,
                         statistics* stats = nullptr);

  /// The surfaces that rays with unit directions meet.
  std::vector<surface_point> surfaces(std::span<const ray> rays);
  /// What passes along rays with unit directions from their origin to tmax (a point light there,
  /// or a directional one if it is infinite); `medium` is the material around the origins.
  std::vector<passage> passages(std::span<const ray> rays, std::uint32_t medium = miss);

  /// What is known before anything is traced: device, layout, trees, times of preparation, or of
  /// the last move.
  statistics prepared() const;

  /// The trees that rays are led by. Throws runtime::exception (invalid) with tree_kind::none.
  traced_trees read_trees() const;

  struct state;  ///< state.hpp

 private:
  std::unique_ptr<state> state_;
};

}  // namespace facet::tracer
