// What is tuned: values that a device can have, and only where they matter.
#include "study/tunables.hpp"

#include <doctest/doctest.h>

#include <set>

#include "tracer/device_helper.hpp"
#include "tracer/tuning.hpp"

using namespace facet;
using study::tunable;
using study::tunable_of;
using study::tuning_workload;
using tracer::choices;

namespace {

tuning_workload of_rays() { return {}; }

tuning_workload of_picture() {
  tuning_workload w;
  w.is_picture = true;
  return w;
}

choices narrow() { return {}; }

choices packets() {
  choices c;
  c.wide_layout = c.packets = true;
  return c;
}

}  // namespace

TEST_CASE("names and the texts of values tell them apart") {
  std::set<std::string> names;
  for (const tunable& t : study::tunables()) {
    CAPTURE(t.name);
    CHECK(names.insert(t.name).second);
    CHECK(&tunable_of(t.name) == &t);
    std::set<std::string> texts;
    for (const choices& c : t.values(narrow(), test::device()))
      CHECK(texts.insert(t.text(c)).second);
  }
  CHECK_THROWS_AS(tunable_of("colour"), std::out_of_range);
}

TEST_CASE("a value is the choices so far with one thing changed") {
  choices so_far = packets();
  so_far.group = 96;
  for (const tunable& t : study::tunables()) {
    CAPTURE(t.name);
    for (choices c : t.values(so_far, test::device())) {
      for (const tunable& other : study::tunables())
        if (other.name != t.name) CHECK(other.text(c) == other.text(so_far));
    }
  }
}

TEST_CASE("the values can be had on this device, with what is usual beside them") {
  const runtime::device d = test::device();
  const choices usual = tracer::tuning_for(d);
  for (const tunable& t : study::tunables())
    for (const choices& c : t.values(usual, d)) CHECK(tracer::fault_of(c, d) == "");
}

TEST_CASE("only NVIDIA's compiler is told of registers") {
  const bool is_nvidia = test::device().nvidia_compute_capability() > 0;
  CHECK(tunable_of("registers").values(narrow(), test::device()).empty() == !is_nvidia);
}

TEST_CASE("a choice is made on the workloads whose kernels it changes") {
  const auto matters = [](const char* name, const choices& c, const tuning_workload& w) {
    return tunable_of(name).matters(c, w);
  };
  CHECK(matters("layout", narrow(), of_rays()));
  CHECK(matters("layout", packets(), of_picture()));

  CHECK(matters("packet_group", packets(), of_rays()));
  CHECK(matters("packet_group", packets(), of_picture()));
  CHECK(!matters("packet_group", narrow(), of_rays()));

  CHECK(matters("group", narrow(), of_rays()));
  CHECK(!matters("group", packets(), of_rays()));
  CHECK(!matters("group", narrow(), of_picture()));

  CHECK(matters("render_group", narrow(), of_picture()));
  CHECK(!matters("render_group", packets(), of_picture()));

  CHECK(matters("registers", narrow(), of_rays()));
  CHECK(matters("registers", narrow(), of_picture()));

  CHECK(matters("leaves", narrow(), of_rays()));
  CHECK(!matters("leaves", packets(), of_rays()));
}
