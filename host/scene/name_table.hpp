// Names of a scene file and the indices that they stand for.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/json_reader.hpp"
#include "scene/nearest.hpp"

namespace facet {

class name_table {
 public:
  /// `kind` is what the names name, for messages: "material".
  explicit name_table(std::string kind) : kind_(std::move(kind)) {}

  void add(const std::string& name, std::uint32_t index) { indices_.emplace(name, index); }

  const std::uint32_t* find(const std::string& name) const {
    const auto entry = indices_.find(name);
    return entry == indices_.end() ? nullptr : &entry->second;
  }

  /// The index of the name that the node holds. Throws scene_error with the nearest known name.
  std::uint32_t at(const json_node& node) const {
    const std::string name = node.text("the name of a " + kind_);
    if (const std::uint32_t* index = find(name)) return *index;
    std::vector<std::string> known;
    for (const auto& entry : indices_) known.push_back(entry.first);
    node.fail(unknown_name(kind_, name, known));
  }

 private:
  std::string kind_;
  std::map<std::string, std::uint32_t> indices_;
};

}  // namespace facet
