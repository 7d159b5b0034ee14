// Devices: listed, chosen, and missing.
#include <doctest/doctest.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

outcome render_on(const std::string& device, const surroundings& s = {},
                  std::vector<std::string> more = {}) {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{"render", (folder / "s.json").string(), "-o",
                                 (folder / "out.npy").string()};
  if (!device.empty()) words.insert(words.end(), {"--device", device});
  words.insert(words.end(), more.begin(), more.end());
  outcome o = run(words, s);
  CHECK(folder.names().size() == (o.code == 0 ? 2u : 1u));
  return o;
}

}  // namespace

TEST_CASE("no device at all: which package provides one, and the serial tracer is offered") {
  for (const outcome& o : {run({"devices"}, without_devices()), render_on("", without_devices()),
                           render_on("0", without_devices())}) {
    CHECK(o.code == 4);
    CHECK(contains(o.err, "no OpenCL device was found"));
    CHECK(contains(o.err, "pocl-opencl-icd"));
    CHECK(contains(o.err, "--device serial"));
  }
}

TEST_CASE("devices are listed flat, from index 0") {
  if (!has_device()) return;
  const outcome o = run({"devices"});
  CHECK(o.code == 0);
  CHECK(o.out.rfind("0  ", 0) == 0);
  CHECK(contains(o.out, "compute units"));
}

TEST_CASE("a device that is not there: the list of those that are") {
  if (!has_device()) return;
  const std::string list = run({"devices"}).out;
  const std::string first = list.substr(3, list.find('\n') - 3);
  for (const char* text : {"abacus", "99"}) {
    const outcome o = render_on(text);
    CHECK(o.code == 4);
    CHECK(contains(o.err, text));
    CHECK(contains(o.err, first));
  }
}

TEST_CASE("a device is chosen by its index, by a part of its name, or by default") {
  if (!has_device()) return;
  const std::string list = run({"devices"}).out;
  const std::string name = list.substr(3, list.find('\n') - 3);
  for (const std::string& text : {std::string("0"), name.substr(0, 5), std::string()}) {
    const outcome o = render_on(text, {}, {"-v"});
    CAPTURE(o.err);
    CHECK(o.code == 0);
    CHECK(contains(o.err, "device: "));
  }
}

TEST_CASE("a work-group that the kernel cannot have is refused with the largest that it can") {
  if (!has_device()) return;
  const outcome o = render_on("", {}, {"--work-group", "32768x32768"});
  CAPTURE(o.err);
  CHECK(o.code == 4);
  CHECK(contains(o.err, "32768"));
  CHECK(contains(o.err, "render"));  // the kernel's name
}

TEST_CASE("a kernel folder that is not there is an error that names it") {
  if (!has_device()) return;
  const outcome o = render_on("", {}, {"--kernels", "/nonexistent/cl"});
  CHECK(o.code == 4);
  CHECK(contains(o.err, "/nonexistent/cl"));
}
