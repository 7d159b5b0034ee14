// Internal: where a buffer's or an image's contents are, and which commands they wait for.
#pragma once

#include <array>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>

#include "runtime/command.hpp"
#include "runtime/memory.hpp"
#include "runtime/queue_state.hpp"

namespace facet::runtime::detail {

/// Aligned for any element that OpenCL knows.
struct aligned_delete {
  static constexpr std::align_val_t alignment{128};
  void operator()(std::byte* p) const { ::operator delete(p, alignment); }
};
using host_bytes = std::unique_ptr<std::byte[], aligned_delete>;

/// Contents live on the host until the first command needs them; from then on on the device, in
/// the context of that command's queue. Members with `locked` in their comment want mutex held;
/// a command group holds it from prepare to record, so that what it depends on cannot change.
class memory {
 public:
  explicit memory(std::size_t bytes) : bytes_(bytes) {}
  memory(const memory&) = delete;
  memory& operator=(const memory&) = delete;
  /// Waits for an upload under way: it reads host memory that may die now.
  virtual ~memory();

  std::size_t bytes() const noexcept { return bytes_; }
  std::mutex mutex;

  /// Locked. Allocates on the queue's device and uploads, where that is still to be done. Throws
  /// errc::accessor if a host accessor is in the way, errc::invalid for another context.
  void prepare(const std::shared_ptr<queue_state>& q, access_mode mode, bool discard);
  void collect(access_mode mode, std::vector<command>& to) const { hazards_.collect(mode, to); }
  void record(access_mode mode, const command& c);
  const cl::Memory& object() const noexcept { return object_; }

  void copy_in(const void* data);
  void bind(void* data);
  void set_final_data(void* data);
  void set_write_back(bool on);
  void* open_host(access_mode mode, bool discard);
  void close_host(void* data, access_mode mode);
  void report(std::exception_ptr failure) noexcept;

 protected:
  /// Creates the device's object; throws if it is larger than the device allows.
  virtual cl::Memory create(const cl::Context& c, const device& d) const = 0;
  /// Enqueues a write of the whole from host memory.
  virtual cl::Event upload(const cl::CommandQueue& q, const void* from) const = 0;
  /// Buffers only: copies the contents to the final data, if there is any.
  void write_back();

 private:
  void check_host_access(access_mode mode) const;
  void allocate_host();
  void* map(access_mode mode, bool discard);
  cl::CommandQueue transfers() const;

  const std::size_t bytes_;

  std::byte* host_ = nullptr;  // contents before the first use on a device
  host_bytes owned_;           // what host_ points to, if it is not the caller's
  bool host_filled_ = false;   // host_ holds contents that no device has
  void* target_ = nullptr;     // final data
  bool write_back_ = false;

  cl::Memory object_;
  std::shared_ptr<queue_state> last_;  // queue of the last use
  hazards hazards_;
  std::optional<command> uploading_;
  bool device_wrote_ = false;
  unsigned host_readers_ = 0;  // host accessors that live
  bool host_writer_ = false;
};

class buffer_memory : public memory {
 public:
  buffer_memory(std::size_t bytes, std::size_t element_bytes)
      : memory(bytes), element_bytes_(element_bytes) {}
  ~buffer_memory() override;

 protected:
  cl::Memory create(const cl::Context& c, const device& d) const override;
  cl::Event upload(const cl::CommandQueue& q, const void* from) const override;

 private:
  const std::size_t element_bytes_;
};

class image_memory : public memory {
 public:
  static constexpr std::size_t pixel_bytes = 4 * sizeof(float);

  image_memory(std::size_t width, std::size_t height, std::size_t bytes)
      : memory(bytes), width_(width), height_(height) {}
  std::array<std::size_t, 3> region() const { return {width_, height_, 1}; }

 protected:
  cl::Memory create(const cl::Context& c, const device& d) const override;
  cl::Event upload(const cl::CommandQueue& q, const void* from) const override;

 private:
  const std::size_t width_, height_;
};

}  // namespace facet::runtime::detail
