#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/document.h"

namespace penumbra::viewer {

// A camera that the user has stored, in the terms of --eye, --target and --fov.
struct Bookmark {
  glm::vec3 eye{0}, target{0};
  double fov = 0;  // degrees

  bool operator==(const Bookmark&) const = default;
};

// By the keys 1 to 9.
using Bookmarks = std::array<std::optional<Bookmark>, 9>;

// The present camera, also if it is one of the file's.
Bookmark bookmark_of(const Document& document, const session::PreparedScene& prepared);
void go_to(Document& document, const session::PreparedScene& prepared, const Bookmark& bookmark);

// The same as options, and back from options that were checked.
std::vector<std::string> arguments_of(const Bookmark& bookmark);
std::optional<Bookmark> bookmark_from(const cli::SceneOptions& options);

}  // namespace penumbra::viewer
