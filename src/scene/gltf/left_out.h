#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "scene/gltf/used.h"

namespace penumbra::scene::gltf {

// The parts of a file that are left out for a fault, since nothing drawn uses them. Each is warned of once, with its
// place; after the first few, only their number is told.
class LeftOut {
 public:
  LeftOut(std::string file, Used used) : file_(std::move(file)), used_(std::move(used)) {}

  const Used& used() const { return used_; }
  bool holds(std::string_view array, std::size_t index) const;

  // Leaves an element out, or throws Error "meshes[3]: CAUSE" if something drawn uses it.
  void add(std::string_view array, std::size_t index, std::string_view cause);
  // The same for a part that is no element of such an array; `place` begins the message.
  void add_part(const std::string& place, bool used, std::string_view cause);
  // Says how many more there were than warnings.
  void finish();

 private:
  std::string file_;
  Used used_;
  std::set<std::pair<std::string, std::size_t>, std::less<>> elements_;
  std::size_t count_ = 0;
};

}  // namespace penumbra::scene::gltf
