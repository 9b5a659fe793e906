#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gl/context.h"
#include "metrics/error_figures.h"
#include "shadow/registry.h"
#include "viewer/costs.h"
#include "viewer/inspect.h"
#include "viewer/picture_renderer.h"
#include "viewer/progress.h"
#include "viewer/unsaved.h"

namespace penumbra::viewer {

// A value of the pixel under the cursor.
struct ProbeRow {
  std::string name, value;
};

// What is shown instead of the picture, at the cursor.
struct ShownTexel {
  glm::ivec2 at{0};
  std::string value;
};

// The figures of A against B, over the surfaces of the picture.
struct PictureDifference {
  metrics::ErrorFigures figures;  // of visibility
  double flip = 0;
};

// What the panels show and the user can't change.
struct ViewerStatus {
  const shadow::Registry& techniques;
  const gl::DeviceInfo& device;
  const gl::Device& gl;
  const LoadedScene* scene = nullptr;  // absent until one is loaded
  std::string loading;                 // the file that is being read, or empty
  const Costs& costs_a;
  const Costs& costs_b;
  glm::ivec2 drawn_size{0};           // of the last picture, pixels
  Detail detail;                      // of it
  std::vector<DrawnMaps> drawn_maps;  // of each light in it
  Progress progress;                  // of A
  bool idle = false;                  // all pictures are finished: nothing will be drawn until something changes
  bool can_undo = false, can_redo = false;
  Unsaved unsaved;
  std::string saved_to, preset;  // the files that saving writes: the view's and, or empty, the open preset's
  std::vector<std::string> shader_errors;
  bool undrawable = false;                      // the picture failed, and will until it or a shader changes
  std::string load_error;                       // why the last scene could not be read; empty: it could
  std::optional<double> writing;                // share of the files that are written
  std::string command;                          // the command line that draws this picture
  std::optional<double> tracing;                // share of the ray-traced picture that is done
  bool both_traced = false;                     // A and B are both ray traced: then B is not drawn
  bool b_is_old = false;                        // what is shown of B, if anything, is not its present picture
  std::optional<PictureDifference> difference;  // of A and B, once both are finished
  std::optional<glm::ivec2> probed;             // the picture's pixel under the cursor, or the locked one
  std::optional<glm::ivec2> last_probed;        // the last one, also once the cursor has left the picture
  std::vector<ProbeRow> probe;
  bool texture_alone = false;          // a texture of another size than the picture's takes its place
  std::optional<glm::vec2> locked_at;  // the middle of the locked pixel, from the picture's upper left
  ColorMapping mapping;                // of the inspected values
  glm::ivec2 shown_size{0};            // of what is shown instead of the picture, texels
  std::optional<ShownTexel> texel;     // of it; of a texture as texelFetch() counts, from the lower left
  glm::vec2 fitted{1};                 // share of the picture's area that it takes where it is not magnified
  Range range;                         // of the colours
  Range values;                        // of A's values; the same unless differences are shown
};

}  // namespace penumbra::viewer
