#include "cli/options.hpp"

#include <charconv>
#include <map>

namespace facet::cli {
namespace {

/// The whole text as a number; false if it is not one, or too large for any limit here.
bool to_number(const std::string& text, std::uint64_t& value) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& name, T& target,
                        const std::map<std::string, T>& choices, const std::string& about) {
  std::string words;
  for (const auto& [word, value] : choices) words += (words.empty() ? "" : "|") + word;
  return app
      .add_option_function<std::string>(
          name,
          [&target, choices, words, name](const std::string& text) {
            const auto found = choices.find(text);
            if (found == choices.end())
              throw CLI::ValidationError(name, "found \"" + text + "\"; allowed: " + words);
            target = found->second;
          },
          about)
      ->type_name(words);
}

}  // namespace

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most, const std::string& unit) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        std::uint64_t value = 0;
        if (to_number(text, value) && value >= least && value <= most) return "";
        return "found \"" + text + "\"; whole numbers from " + std::to_string(least) + " to " +
               std::to_string(most) + (unit.empty() ? "" : " " + unit) + " are allowed";
      },
      "", "whole_number");
}

CLI::Option* add_size(CLI::App& app, const std::string& name, size& target, std::uint32_t most,
                      const std::string& about) {
  return app
      .add_option_function<std::string>(
          name,
          [&target, name, most](const std::string& text) {
            std::uint64_t w = 0, h = 0;
            const std::size_t x = text.find('x');
            if (x == std::string::npos || !to_number(text.substr(0, x), w) ||
                !to_number(text.substr(x + 1), h) || w < 1 || h < 1 || w > most || h > most)
              throw CLI::ValidationError(name, "found \"" + text +
                                                   "\"; WIDTHxHEIGHT, like 16x8, is allowed, "
                                                   "both from 1 to " +
                                                   std::to_string(most));
            target = {std::uint32_t(w), std::uint32_t(h)};
          },
          about)
      ->type_name("WxH");
}

void add_device(CLI::App& app, std::string& target, bool serial_too) {
  const std::string serial =
      serial_too ? ", a part of its name in any case, \"serial\"\n"
                   "(one CPU thread, no OpenCL) or \"serial-double\" (the same in double "
                   "precision).\nDefault: "
                 : ", or a part of its name in any case\n(default: ";
  app.add_option("-d,--device", target,
                 "Device: an index of `facet devices`" + serial +
                     "the first GPU, or else the first device" + (serial_too ? "" : ")"))
      ->type_name(serial_too ? "NAME|INDEX|serial" : "NAME|INDEX");
}

void add_kernels(CLI::App& app, tracer::options& target) {
  add_choice<tracer::geometry_kind>(
      app, "--geometry", target.geometry,
      {{"auto", tracer::geometry_kind::automatic},
       {"buffer", tracer::geometry_kind::buffer},
       {"image", tracer::geometry_kind::image}},
      "Where the device reads vertices from (default auto: as tuned, or what was\n"
      "measured to be faster on this kind of device)");
  add_choice<tracer::layout_kind>(
      app, "--layout", target.layout,
      {{"auto", tracer::layout_kind::automatic},
       {"narrow", tracer::layout_kind::narrow},
       {"wide", tracer::layout_kind::wide}},
      "Nodes of two children and single triangles, or eight of both\n"
      "at a time (default auto: as tuned, or wide on CPUs, but for images)");
  app.add_option("--kernels", target.kernel_folder,
                 "Read the OpenCL C files from this folder, not from the program")
      ->type_name("DIR");
  app.add_flag("--all-features", target.all_features, "Compile what the scene does not need, too");
}

void add_no_tuning(CLI::App& app, bool& target) {
  app.add_flag("--no-tuning", target,
               "What is left open follows from the kind of device, not from what `facet tune`\n"
               "has measured");
}

void add_tracing(CLI::App& app, tracing_options& target) {
  add_device(app, target.device, true);
  add_choice<tracer::tree_kind>(
      app, "--tree", target.tracer.tree,
      {{"binned", tracer::tree_kind::binned},
       {"levels", tracer::tree_kind::levels},
       {"none", tracer::tree_kind::none}},
      "Tree over the triangles; none tests every triangle (default binned)");
  add_choice<tracer::packet_kind>(
      app, "--packets", target.tracer.packets,
      {{"auto", tracer::packet_kind::automatic},
       {"on", tracer::packet_kind::on},
       {"off", tracer::packet_kind::off}},
      "Rays that follow one another, or pixels of a tile, are taken by one\n"
      "work-item, together where they stay close: in the wide layout, with\n"
      "a tree (default auto: as tuned, or on CPUs)");
  add_kernels(app, target.tracer);
  add_no_tuning(app, target.no_tuning);
}

void refuse_with_serial(const CLI::App& app, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (app.count(name) > 0)
      throw usage_error(std::string(name) +
                        " has no meaning with the serial tracer; leave it out, or choose an "
                        "OpenCL device (`facet devices`)");
}

void add_transfer(CLI::App& app, image::transfer& target, const std::string& about) {
  add_choice<image::transfer>(
      app, "--transfer", target,
      {{"srgb", image::transfer::srgb}, {"linear", image::transfer::linear}}, about);
}

}  // namespace facet::cli
