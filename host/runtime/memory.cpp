// The two kinds of memory, and what their public headers call.
#include "runtime/memory.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "runtime/huge_pages.hpp"
#include "runtime/memory_state.hpp"

namespace facet::runtime::detail {
namespace {

std::string sides(std::size_t width, std::size_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void check_bytes(const char* what, std::size_t bytes, const device& d) {
  const auto refuse = [&](std::uint64_t allowed, const char* limit) {
    throw exception(errc::memory_allocation, std::string(what) + " of " + std::to_string(bytes) +
                                                 " bytes does not fit: " + d.name() + " allows " +
                                                 std::to_string(allowed) + " bytes " + limit);
  };
  if (bytes > d.max_mem_alloc_size()) refuse(d.max_mem_alloc_size(), "in one allocation");
  if (bytes > d.global_mem_size()) refuse(d.global_mem_size(), "in all");
}

}  // namespace

buffer_memory::~buffer_memory() {
  try {
    write_back();
  } catch (...) {
    report(std::current_exception());
  }
}

cl::Memory buffer_memory::create(const cl::Context& c, const device& d) const {
  // OpenCL has no empty buffers: a kernel that is given one gets room for one element.
  const std::size_t size = std::max(bytes(), element_bytes_);
  check_bytes("a buffer", size, d);
  if (d.is_cpu())
    if (const std::optional<cl::Buffer> b = buffer_in_huge_pages(c, size)) return *b;
  return call([&] { return cl::Buffer(c, CL_MEM_READ_WRITE, size); },
              std::to_string(size) + " bytes");
}

cl::Event buffer_memory::upload(const cl::CommandQueue& q, const void* from) const {
  cl::Event done;
  const cl::Buffer to(object()(), true);
  q.enqueueWriteBuffer(to, CL_FALSE, 0, bytes(), from, nullptr, &done);
  return done;
}

cl::Memory image_memory::create(const cl::Context& c, const device& d) const {
  if (!d.image_support()) throw exception(errc::feature_not_supported, d.name() + " has no images");
  if (width_ > d.image2d_max_width() || height_ > d.image2d_max_height())
    throw exception(errc::memory_allocation,
                    "an image of " + sides(width_, height_) + " pixels does not fit: " + d.name() +
                        " allows " + sides(d.image2d_max_width(), d.image2d_max_height()));
  check_bytes("an image", bytes(), d);
  return call(
      [&] {
        return cl::Image2D(c, CL_MEM_READ_WRITE, cl::ImageFormat(CL_RGBA, CL_FLOAT), width_,
                           height_);
      },
      sides(width_, height_) + " pixels");
}

cl::Event image_memory::upload(const cl::CommandQueue& q, const void* from) const {
  cl::Event done;
  const std::array<std::size_t, 3> whole = region();
  const std::size_t origin[3] = {0, 0, 0};
  const cl_int result = clEnqueueWriteImage(q(), object()(), CL_FALSE, origin, whole.data(), 0, 0,
                                            from, 0, nullptr, &done());
  if (result != CL_SUCCESS)
    throw failed_call("clEnqueueWriteImage", result, sides(width_, height_) + " pixels");
  return done;
}

std::shared_ptr<memory> make_buffer(std::size_t count, std::size_t element_bytes) {
  if (count > std::numeric_limits<std::size_t>::max() / element_bytes)
    throw exception(errc::memory_allocation, "a buffer of " + std::to_string(count) +
                                                 " elements of " + std::to_string(element_bytes) +
                                                 " bytes: no memory is that large");
  return std::make_shared<buffer_memory>(count * element_bytes, element_bytes);
}

std::shared_ptr<memory> make_image2d(std::size_t width, std::size_t height) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / image_memory::pixel_bytes;
  if (width == 0 || height == 0)
    throw exception(errc::invalid, "an image of " + sides(width, height) +
                                       " pixels; each side must be at least 1");
  if (width > most / height)
    throw exception(errc::memory_allocation,
                    "an image of " + sides(width, height) + " pixels: no memory is that large");
  return std::make_shared<image_memory>(width, height, width * height * image_memory::pixel_bytes);
}

void copy_in(memory& m, const void* data) { m.copy_in(data); }
void bind(memory& m, void* data) { m.bind(data); }
void set_final_data(memory& m, void* data) { m.set_final_data(data); }
void set_write_back(memory& m, bool on) { m.set_write_back(on); }
std::size_t byte_size(const memory& m) noexcept { return m.bytes(); }
native::memory native_handle(const memory& m) { return m.object()(); }

void* open_host(memory& m, access_mode mode, bool discard) { return m.open_host(mode, discard); }

void close_host(memory& m, void* data, access_mode mode) noexcept {
  try {
    m.close_host(data, mode);
  } catch (...) {
    m.report(std::current_exception());
  }
}

}  // namespace facet::runtime::detail
