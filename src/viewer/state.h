#pragma once

#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "viewer/comparison.h"
#include "viewer/document.h"
#include "viewer/file_list.h"
#include "viewer/inspect.h"

namespace penumbra::viewer {

struct Playback {
  bool playing = false;
  float speed = 1;     // of the file's time
  double carried = 0;  // frames that are due, less than one
};

// One line for the user, over the picture until it has been read.
struct Message {
  std::string text;
  bool is_error = false;
  double until = 0;  // seconds of the viewer's clock
};

// What the interface asks for, done between two frames of it.
struct Requests {
  std::optional<std::string> open;  // a scene
  std::optional<std::string> open_preset, save_preset;
  bool write_picture = false, write_sequence = false;  // to the state's file
  bool frame_all = false;
  bool copy_command = false, copy_camera = false;
  bool quit = false;
};

// All that a hand can change.
struct State {
  Document document;  // picture A
  Comparison comparison;
  Inspection inspection;
  Zoom zoom;
  Playback playback;
  bool fly = false;            // the left button turns the head, instead of the scene
  bool dragging_line = false;  // between A and B
  bool list_open = false;      // in the last frame: Escape closes it
  bool panel = true, help = false, probe = true, vsync = true;
  std::string search;         // in the parameters
  std::string tab, open_tab;  // to be opened; that is open
  bool focus_search = false;  // the next frame
  FileList files;             // to open one
  std::string preset_file = "preset.toml", picture_file = "penumbra.png", scene_file;
  cli::FrameRange sequence{0, 47};
  bool with_aovs = false;           // in what is written
  std::vector<std::string> recent;  // scenes, the last one first
  std::deque<Message> messages;
  Requests requests;

  // Whether A stands beside B; at first B is A.
  void compare(bool on) {
    comparison.on = on;
    if (on && comparison.params.rows().empty()) comparison.params = document.params;
  }
};

}  // namespace penumbra::viewer
