#include "runtime/memory_state.hpp"

#include <cstring>
#include <string>

namespace facet::runtime::detail {

memory::~memory() {
  try {
    if (uploading_) wait_for(*uploading_);
  } catch (...) {
    report(std::current_exception());
  }
  if (object_()) last_->context->memory.remove(bytes_);
}

void memory::prepare(const std::shared_ptr<queue_state>& q, access_mode mode, bool discard) {
  check_host_access(mode);
  if (uploading_ && !host_readers_ && status_of(uploading_->event) <= CL_COMPLETE) {
    uploading_.reset();
    if (owned_) host_ = nullptr;
    owned_.reset();
  }
  if (!object_()) {
    object_ = create(q->context->context, q->target);
    q->context->memory.add(bytes_);
  } else if (last_->context != q->context) {
    throw exception(errc::invalid,
                    "the memory lives in the context of the queue that first used it, and this "
                    "command group's queue has another: use queues of one context, or go through "
                    "the host");
  }
  last_ = q;
  if (host_filled_ && bytes_ && (reads(mode) || !discard)) {
    uploading_ = {call([&] { return upload(q->queue, host_); }), q->queue, q->in_order};
    hazards_.record(access_mode::write, *uploading_);
  }
  host_filled_ = false;
}

void memory::record(access_mode mode, const command& c) {
  hazards_.record(mode, c);
  if (writes(mode)) device_wrote_ = true;
}

void memory::copy_in(const void* data) {
  const std::lock_guard lock(mutex);
  allocate_host();
  if (bytes_) std::memcpy(host_, data, bytes_);
  host_filled_ = true;
}

void memory::bind(void* data) {
  const std::lock_guard lock(mutex);
  host_ = static_cast<std::byte*>(data);
  target_ = data;
  host_filled_ = write_back_ = data != nullptr;
}

void memory::set_final_data(void* data) {
  const std::lock_guard lock(mutex);
  target_ = data;
  write_back_ = data != nullptr;
}

void memory::set_write_back(bool on) {
  const std::lock_guard lock(mutex);
  write_back_ = on && target_ != nullptr;
}

void memory::check_host_access(access_mode mode) const {
  if (host_writer_ || (host_readers_ && writes(mode)))
    throw exception(errc::accessor,
                    std::string("a host_accessor that ") + (host_writer_ ? "writes" : "reads") +
                        " this memory is still alive, and it was asked to be " +
                        (writes(mode) ? "written" : "read") + ": end its scope first");
}

void memory::allocate_host() {
  if (host_ || !bytes_) return;
  owned_.reset(static_cast<std::byte*>(::operator new(bytes_, aligned_delete::alignment)));
  host_ = owned_.get();
}

cl::CommandQueue memory::transfers() const { return last_->context->transfers(last_->target); }

void* memory::open_host(access_mode mode, bool discard) {
  std::vector<command> before;
  {
    const std::lock_guard lock(mutex);
    check_host_access(mode);
    if (!object_()) {
      allocate_host();
      host_filled_ = host_filled_ || writes(mode);
    } else {
      hazards_.collect(mode, before);
    }
    if (writes(mode))
      host_writer_ = true;
    else
      ++host_readers_;
    if (!object_()) return host_;
  }
  // No command that conflicts can come between: the accessor is already counted.
  try {
    wait_for_success(before);
    return bytes_ ? map(mode, discard) : nullptr;
  } catch (...) {
    close_host(nullptr, mode);
    throw;
  }
}

void* memory::map(access_mode mode, bool discard) {
  const cl_map_flags flags = mode == access_mode::read ? CL_MAP_READ
                             : discard && !reads(mode) ? CL_MAP_WRITE_INVALIDATE_REGION
                             : reads(mode)             ? CL_MAP_READ | CL_MAP_WRITE
                                                       : CL_MAP_WRITE;
  cl_int result = CL_SUCCESS;
  void* data = clEnqueueMapBuffer(transfers()(), object_(), CL_TRUE, flags, 0, bytes_, 0, nullptr,
                                  nullptr, &result);
  if (result != CL_SUCCESS)
    throw failed_call("clEnqueueMapBuffer", result, std::to_string(bytes_) + " bytes");
  return data;
}

void memory::close_host(void* data, access_mode mode) {
  const std::lock_guard lock(mutex);
  if (writes(mode))
    host_writer_ = false;
  else
    --host_readers_;
  if (!data || data == host_) return;
  const cl::CommandQueue q = transfers();
  command unmap{{}, q, true};
  call([&] { return q.enqueueUnmapMemObject(object_, data, nullptr, &unmap.event); });
  record(mode, unmap);
  call([&] { return q.flush(); });
}

void memory::report(std::exception_ptr failure) noexcept {
  if (last_) last_->report(std::move(failure));
}

void memory::write_back() {
  if (!write_back_ || !target_ || !bytes_) return;
  if (!object_()) {
    if (host_filled_ && target_ != host_) std::memcpy(target_, host_, bytes_);
    return;
  }
  if (!device_wrote_ && target_ == host_) return;
  std::vector<command> before;
  hazards_.collect(access_mode::read, before);
  wait_for_success(before);
  const cl_int result = clEnqueueReadBuffer(transfers()(), object_(), CL_TRUE, 0, bytes_, target_,
                                            0, nullptr, nullptr);
  if (result != CL_SUCCESS)
    throw failed_call("clEnqueueReadBuffer", result, std::to_string(bytes_) + " bytes");
}

}  // namespace facet::runtime::detail
