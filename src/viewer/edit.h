#pragma once

#include "viewer/bookmarks.h"
#include "viewer/comparison.h"
#include "viewer/document.h"

namespace penumbra::viewer {

// What Undo takes back: camera, bookmarks, sun, lights, and the parameters of A and B. Not the scene, the time, the
// window's size.
struct Edit {
  cli::SceneOptions view;  // of which only camera, sun and lights count
  ParamSet a, b;           // b has no rows until B is first shown, and is then equal to any other
  Bookmarks bookmarks;

  bool operator==(const Edit& other) const;
};

// Whether sun, lights and lamps are the same.
bool same_lights(const Edit& a, const Edit& b);

Edit edit_of(const Document& document, const Comparison& comparison, const Bookmarks& bookmarks);
// Makes document, B and bookmarks what they were. A B that the edit does not know stays.
void restore(const Edit& edit, Document& document, Comparison& comparison, Bookmarks& bookmarks);

// The scene's own camera, which `render` chooses by default.
void use_scene_camera(cli::SceneOptions& options);
// Its own camera, sun and lights.
void use_scene_view(cli::SceneOptions& options);

}  // namespace penumbra::viewer
