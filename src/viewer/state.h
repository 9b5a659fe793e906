#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/view.h"
#include "viewer/bookmarks.h"
#include "viewer/comparison.h"
#include "viewer/document.h"
#include "viewer/drag.h"
#include "viewer/file_list.h"
#include "viewer/inspect.h"
#include "viewer/settings.h"

namespace penumbra::viewer {

struct Playback {
  bool playing = false;
  float speed = 1;
  double carried = 0;  // the fraction of a frame that has elapsed since the last whole one
};

// One line for the user, shown over the picture for a while.
struct Message {
  std::string text;
  bool is_error = false;
  double until = 0;  // seconds of the viewer's clock
};

// What becomes of changes that are not saved when the window or its scene closes.
enum class ClosingAnswer { save, discard };

// What the user asked for with a widget or a key; done between two frames of the interface.
struct Requests {
  std::optional<std::string> open;  // a scene; asks first where changes would be lost
  std::optional<std::string> open_preset, save_preset;
  std::optional<std::string> overwrite_preset;         // as save_preset, and the user agrees to lose what is there
  bool write_picture = false, write_sequence = false;  // to the state's file
  bool stop_writing = false;
  bool frame_casters = false;
  bool copy_command = false, copy_camera = false;
  bool undo = false, redo = false;
  bool save = false;
  bool quit = false;  // asks first where changes would be lost
  std::optional<ClosingAnswer> closing;

  bool operator==(const Requests&) const = default;
};

// The window asks before it closes, or before another scene takes the place of the one that is shown.
struct ClosingQuestion {
  bool wanted = false;  // ask in the next frame
  bool asks = false;
  std::string scene;  // the other scene's file; empty: the window closes
};

// "Save preset" asks before it overwrites this file.
struct OverwriteQuestion {
  bool wanted = false;  // ask in the next frame
  std::string file;
};

// A lamp of the scene panel's list.
struct LampName {
  bool of_file = false;   // else of the user
  std::size_t index = 0;  // among the file's lights, or among SceneOptions::lamps

  bool operator==(const LampName&) const = default;
};

// Everything that the user can change.
struct UiState {
  Document document;    // picture A
  Bookmarks bookmarks;  // of the scene
  Comparison comparison;
  Inspection inspection;
  Zoom zoom;
  Playback playback;
  bool fly = false;                    // the left button looks around from the eye, instead of orbiting the target
  bool travel_keys_with_ctrl = false;  // the keys that are down were pressed with Ctrl, and move nothing
  double last_travel = -1e9;           // when the wheel or a key moved the camera last, seconds of the viewer's clock
  Drag drag;                           // of the pointer over the picture
  bool dragging_line = false;          // the user drags the line between A and B
  // The lamp whose properties are shown, and the one that the mouse drags.
  std::optional<LampName> lamp, dragged_lamp;
  // A lamp that becomes a spot gets this one's axis and cones: those of the spot that the user last made shine all
  // round.
  render::LampLight last_spot{.axis = {0, -1, 0}, .inner_cone = 0.5585f, .outer_cone = 0.6981f};
  std::optional<glm::ivec2> locked_pixel;  // whose values stay, wherever the cursor is
  bool popup_open = false;                 // a list was open in the last frame: Escape closes it
  bool panel = true, help = false, probe = true, vsync = true;
  float panel_width = usual_panel_width, panel_share = usual_panel_share, scale = 1;  // as Settings has them
  std::string search;                                                                 // filters the parameters
  std::string tab, open_tab;  // the one to open in the next frame; the one that is open
  bool focus_search = false;  // put the keyboard focus into the search field in the next frame
  FileList files;             // of the file browser
  OverwriteQuestion overwrite;
  ClosingQuestion closing;
  std::string preset_file = "preset.toml", picture_file = "penumbra.png", scene_file;
  cli::FrameRange sequence{0, 47};
  bool with_aovs = false;           // write every AOV beside the picture
  std::vector<std::string> recent;  // scenes, the most recent first
  std::deque<Message> messages;
  Requests requests;

  // Opens the list of files.
  void open_files() {
    panel = files.wanted = true;
    tab = "Scene";
  }
  // Compares A with B or not. The first time, B gets A's values, and is the truth if A is another picture at rest.
  void compare(bool on);
  // Picture B: it has A's camera, time, lights, casters, exposure and render options; its own are those of shadows.
  Document document_b() const;
};

}  // namespace penumbra::viewer
