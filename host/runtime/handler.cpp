#include "runtime/handler.hpp"

#include <algorithm>
#include <string>

#include "runtime/command_group.hpp"
#include "runtime/event_state.hpp"
#include "runtime/launch.hpp"

namespace facet::runtime {
namespace {

using detail::argument;
using detail::memory;

const cl::Buffer as_buffer(const memory& m) { return cl::Buffer(m.object()(), true); }

const cl::Image2D as_image(const memory& m) { return cl::Image2D(m.object()(), true); }

const std::vector<cl::Event>* or_null(const std::vector<cl::Event>& waits) {
  return waits.empty() ? nullptr : &waits;
}

void check_fits(const char* what, std::size_t from, std::size_t to) {
  if (from > to)
    throw exception(errc::invalid, std::string(what) + " of " + std::to_string(from) +
                                       " bytes into " + std::to_string(to) +
                                       ": the destination must be at least as large");
}

detail::description copy_name(const char* between, std::size_t bytes) {
  return std::make_shared<const std::string>(std::string(between) + " of " + std::to_string(bytes) +
                                             " bytes");
}

constexpr cl::array<cl::size_type, 3> origin{0, 0, 0};

cl::array<cl::size_type, 3> whole(const memory& image) {
  const auto r = static_cast<const detail::image_memory&>(image).region();
  return {r[0], r[1], r[2]};
}

}  // namespace

void detail::require(handler& h, const std::shared_ptr<memory>& m, access_mode mode, bool discard) {
  h.group_.require(m, mode, discard);
}

void handler::depends_on(const event& e) {
  if (e.state()) detail::add_once(group_.after, e.state()->of);
}

void handler::depends_on(const std::vector<event>& events) {
  for (const event& e : events) depends_on(e);
}

void handler::clear_args() {
  group_.arguments.clear();
  group_.values.clear();
}

void handler::set_value(std::uint32_t index, const void* value, std::size_t bytes) {
  if (index >= group_.arguments.size()) group_.arguments.resize(index + 1);
  const std::size_t offset = group_.values.size();
  const auto* first = static_cast<const std::byte*>(value);
  group_.values.insert(group_.values.end(), first, first + bytes);
  group_.arguments[index] = {argument::kind::value, offset, bytes, nullptr, access_mode::read};
}

void handler::set_memory(std::uint32_t index, const memory_ptr& m, access_mode mode) {
  if (!group_.requires_memory(*m))
    throw exception(errc::accessor, "argument " + std::to_string(index) +
                                        " is an accessor of another command group; make it with "
                                        "this group's handler");
  if (index >= group_.arguments.size()) group_.arguments.resize(index + 1);
  group_.arguments[index] = {argument::kind::memory, 0, sizeof(cl_mem), m.get(), mode};
}

void handler::set_local(std::uint32_t index, std::size_t bytes) {
  if (index >= group_.arguments.size()) group_.arguments.resize(index + 1);
  group_.arguments[index] = {argument::kind::local, 0, bytes, nullptr, access_mode::read_write};
}

void handler::launch(const detail::launch_shape& shape, const kernel& k) {
  const std::size_t* global = shape.global;
  if (std::find(global, global + shape.dimensions, 0u) != global + shape.dimensions) {
    group_.act(k.state()->what, {});
    return;
  }
  detail::command_group& g = group_;
  g.act(k.state()->what, [&g](const auto& queue, const auto& waits, cl::Event& done) {
    detail::enqueue_launch(*g.launched, g.shape, g.arguments, g.values, queue, waits, done);
  });
  g.launched = k.state();
  g.shape = shape;
}

void handler::copy_buffer(const memory_ptr& from, const memory_ptr& to) {
  check_fits("a copy of a buffer", from->bytes(), to->bytes());
  detail::description name = copy_name("a copy between buffers", from->bytes());
  if (!from->bytes()) return group_.act(std::move(name), {});
  group_.act(std::move(name), [from, to](const auto& queue, const auto& waits, cl::Event& done) {
    queue.enqueueCopyBuffer(as_buffer(*from), as_buffer(*to), 0, 0, from->bytes(), or_null(waits),
                            &done);
  });
}

void handler::copy_to_image(const memory_ptr& from, const memory_ptr& to) {
  if (from->bytes() < to->bytes())
    throw exception(errc::invalid, "a copy to an image of " + std::to_string(to->bytes()) +
                                       " bytes from a buffer of " + std::to_string(from->bytes()) +
                                       ": the buffer must hold all its pixels");
  group_.act(copy_name("a copy to an image", to->bytes()),
             [from, to](const auto& queue, const auto& waits, cl::Event& done) {
               queue.enqueueCopyBufferToImage(as_buffer(*from), as_image(*to), 0, origin,
                                              whole(*to), or_null(waits), &done);
             });
}

void handler::copy_from_image(const memory_ptr& from, const memory_ptr& to) {
  check_fits("a copy of an image", from->bytes(), to->bytes());
  group_.act(copy_name("a copy from an image", from->bytes()),
             [from, to](const auto& queue, const auto& waits, cl::Event& done) {
               queue.enqueueCopyImageToBuffer(as_image(*from), as_buffer(*to), origin, whole(*from),
                                              0, or_null(waits), &done);
             });
}

void handler::copy_to_host(const memory_ptr& from, void* to) {
  detail::description name = copy_name("a copy to the host", from->bytes());
  if (!from->bytes()) return group_.act(std::move(name), {});
  group_.act(std::move(name), [from, to](const auto& queue, const auto& waits, cl::Event& done) {
    queue.enqueueReadBuffer(as_buffer(*from), CL_FALSE, 0, from->bytes(), to, or_null(waits),
                            &done);
  });
}

void handler::copy_from_host(const void* from, const memory_ptr& to) {
  detail::description name = copy_name("a copy from the host", to->bytes());
  if (!to->bytes()) return group_.act(std::move(name), {});
  group_.act(std::move(name), [from, to](const auto& queue, const auto& waits, cl::Event& done) {
    queue.enqueueWriteBuffer(as_buffer(*to), CL_FALSE, 0, to->bytes(), from, or_null(waits), &done);
  });
}

void handler::fill_buffer(const memory_ptr& to, const void* value, std::size_t bytes) {
  detail::description name = copy_name("a fill", to->bytes());
  if (!to->bytes()) return group_.act(std::move(name), {});
  const auto* first = static_cast<const std::byte*>(value);
  group_.act(std::move(name), [to, pattern = std::vector<std::byte>(first, first + bytes)](
                                  const auto& queue, const auto& waits, cl::Event& done) {
    // The bindings take the pattern's size from its type.
    const std::vector<cl_event> list = [&] {
      std::vector<cl_event> handles;
      handles.reserve(waits.size());
      for (const cl::Event& e : waits) handles.push_back(e());
      return handles;
    }();
    const cl_int result =
        clEnqueueFillBuffer(queue(), to->object()(), pattern.data(), pattern.size(), 0, to->bytes(),
                            cl_uint(list.size()), list.empty() ? nullptr : list.data(), &done());
    if (result != CL_SUCCESS) throw cl::Error(result, "clEnqueueFillBuffer");
  });
}

}  // namespace facet::runtime
