#include "image/write.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <stdexcept>
#include <string>

#include "image/output.hpp"

namespace facet::image {
namespace {

/// Lets OpenImageIO write into an output_file, whose errors know the reason; the first is kept,
/// since OpenImageIO's own words for it are poorer.
class output_proxy : public OIIO::Filesystem::IOProxy {
 public:
  explicit output_proxy(output_file& file) : IOProxy(file.path().string(), Write), file_(file) {}

  const char* proxytype() const override { return "facet"; }
  bool seek(int64_t offset) override {
    m_pos = offset;
    return true;
  }
  size_t write(const void* data, size_t bytes) override {
    const size_t written = pwrite(data, bytes, m_pos);
    m_pos += int64_t(written);
    return written;
  }
  size_t pwrite(const void* data, size_t bytes, int64_t offset) override {
    if (failure_) return 0;
    try {
      file_.write_at(data, bytes, std::uint64_t(offset));
    } catch (const output_error&) {
      failure_ = std::current_exception();
      return 0;
    }
    size_ = std::max(size_, std::size_t(offset) + bytes);
    return bytes;
  }
  size_t size() const override { return size_; }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  output_file& file_;
  std::exception_ptr failure_;
  std::size_t size_ = 0;
};

void encode(const std::filesystem::path& path, const char* format, OIIO::ImageSpec spec,
            const void* pixels) {
  output_file file(path);
  output_proxy proxy(file);
  const auto out = OIIO::ImageOutput::create(format);
  if (!out)
    throw output_error(
        path, "this OpenImageIO cannot write " + std::string(format) + ": " + OIIO::geterror());
  OIIO::Filesystem::IOProxy* target = &proxy;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &target);
  const bool whole =
      out->open(path.filename().string(), spec) && out->write_image(spec.format, pixels);
  const bool closed = out->close();
  proxy.rethrow();
  if (!whole || !closed) throw output_error(path, "cannot be written: " + out->geterror());
  file.commit();
}

}  // namespace

void write_picture(const std::filesystem::path& path, const picture& p, transfer curve) {
  refuse_nan(p);
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  const int width = int(p.width), height = int(p.height);
  if (extension == ".png") {
    OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", curve == transfer::srgb ? "sRGB" : "Linear");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    encode(path, "png", spec, to_bytes(p, curve).data());
  } else if (extension == ".exr") {
    OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::FLOAT);
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("compression", "zip");
    encode(path, "openexr", spec, p.rgba.data());
  } else {
    throw std::invalid_argument("\"" + extension + "\" is not .png or .exr");
  }
}

}  // namespace facet::image
