#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "scene/gltf/used.h"

namespace penumbra::scene::gltf {

// Records the parts of a file that are left out because of a fault, which is allowed since nothing drawn uses them.
// Each causes one warning with its place; after the first few, only their number is printed.
class LeftOut {
 public:
  LeftOut(std::string file, Used used) : file_(std::move(file)), used_(std::move(used)) {}

  const Used& used() const { return used_; }
  bool holds(std::string_view array, std::size_t index) const;

  // Records an element as left out, or throws Error "meshes[3]: CAUSE" if something drawn uses it.
  void add(std::string_view array, std::size_t index, std::string_view cause);
  // The same for a part that is not an element of such an array; the message begins with `place`.
  void add_part(const std::string& place, bool used, std::string_view cause);
  // Warns of how many more parts were left out than were listed.
  void finish();

 private:
  std::string file_;
  Used used_;
  std::set<std::pair<std::string, std::size_t>, std::less<>> elements_;
  std::size_t count_ = 0;
};

}  // namespace penumbra::scene::gltf
