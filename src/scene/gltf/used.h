#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::scene::gltf {

// Which elements of a document's arrays the drawn scene needs: the default scene's nodes, and everything they refer to,
// directly or indirectly. A fault anywhere else is no reason to refuse a file.
class Used {
 public:
  // The document need not be validated: malformed values count as referring to nothing.
  explicit Used(const nlohmann::json& document);

  // `array` is the path of the array: "nodes", "extensions.KHR_lights_punctual.lights".
  bool holds(std::string_view array, std::size_t index) const;
  // Whether a drawn node gives the mesh a skin.
  bool skinned(std::size_t mesh) const;

 private:
  friend class UsedFinder;
  std::map<std::string, std::vector<bool>, std::less<>> marks_;
  std::vector<bool> skinned_;
};

constexpr const char* lights_array = "extensions.KHR_lights_punctual.lights";

// The arrays whose elements can be left out, and the placeholder for such an element: valid, and never read.
const std::map<std::string, nlohmann::json, std::less<>>& stand_ins();

// The array at a path; null if there is none.
const nlohmann::json* array_at(const nlohmann::json& document, std::string_view path);

}  // namespace penumbra::scene::gltf
