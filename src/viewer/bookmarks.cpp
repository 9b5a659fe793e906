#include "viewer/bookmarks.h"

#include <glm/trigonometric.hpp>

namespace penumbra::viewer {

Bookmark bookmark_of(const Document& document, const session::PreparedScene& prepared) {
  Document placed = document;
  place(placed, prepared, present_rig(document, prepared));
  return {.eye = *placed.options.eye, .target = *placed.options.target, .fov = *placed.options.fov};
}

void go_to(Document& document, const session::PreparedScene& prepared, const Bookmark& bookmark) {
  const auto fov = static_cast<float>(glm::radians(bookmark.fov));
  place(document, prepared, {.eye = bookmark.eye, .target = bookmark.target, .fov_y = fov});
}

std::vector<std::string> arguments_of(const Bookmark& bookmark) {
  cli::SceneOptions options;
  options.eye = bookmark.eye;
  options.target = bookmark.target;
  options.fov = bookmark.fov;
  return camera_arguments(options);
}

std::optional<Bookmark> bookmark_from(const cli::SceneOptions& options) {
  if (!options.eye || !options.target || !options.fov) return {};
  return Bookmark{.eye = *options.eye, .target = *options.target, .fov = *options.fov};
}

}  // namespace penumbra::viewer
