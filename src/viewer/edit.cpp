#include "viewer/edit.h"

#include <tuple>

namespace penumbra::viewer {

namespace {

// References to parts of an edit; const or not as `options` is.
template <class Options>
auto camera_of(Options& options) {
  return std::tie(options.camera, options.eye, options.target, options.fov);
}

template <class Options>
auto lights_of(Options& options) {
  return std::tie(options.no_sun, options.lights, options.lamp_radius, options.lamps);
}

bool same_sun(const std::optional<cli::Direction>& a, const std::optional<cli::Direction>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->azimuth == b->azimuth && a->elevation == b->elevation;
}

}  // namespace

bool Edit::operator==(const Edit& other) const {
  const bool same_b = b.rows().empty() || other.b.rows().empty() || b == other.b;
  return same_b && a == other.a && bookmarks == other.bookmarks && camera_of(view) == camera_of(other.view) &&
         same_lights(*this, other);
}

bool same_lights(const Edit& a, const Edit& b) {
  return lights_of(a.view) == lights_of(b.view) && same_sun(a.view.sun, b.view.sun);
}

Edit edit_of(const Document& document, const Comparison& comparison, const Bookmarks& bookmarks) {
  return {.view = document.options, .a = document.params, .b = comparison.params, .bookmarks = bookmarks};
}

void restore(const Edit& edit, Document& document, Comparison& comparison, Bookmarks& bookmarks) {
  camera_of(document.options) = camera_of(edit.view);
  lights_of(document.options) = lights_of(edit.view);
  document.options.sun = edit.view.sun;
  document.params = edit.a;
  bookmarks = edit.bookmarks;
  if (!edit.b.rows().empty()) comparison.params = edit.b;
}

void use_scene_camera(cli::SceneOptions& options) {
  options.camera.reset();
  options.eye.reset();
  options.target.reset();
  options.fov.reset();
}

void use_scene_view(cli::SceneOptions& options) {
  use_scene_camera(options);
  const cli::SceneOptions untouched;
  lights_of(options) = lights_of(untouched);
  options.sun.reset();
}

}  // namespace penumbra::viewer
