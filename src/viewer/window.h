#pragma once

#include <array>
#include <deque>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/usage.h"
#include "gl/context.h"

struct GLFWwindow;

namespace penumbra::viewer {

// A window with an OpenGL context and Dear ImGui in it.
class Window {
 public:
  struct Options {
    int width = 1280, height = 720;  // in the desktop's units, which HiDPI screens divide into pixels
    bool debug = false;
  };
  // Throws Error where there is no display, with the cause.
  explicit Window(const Options& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Takes the events that are there; waits for one up to `seconds`, 0: not at all. False: the window is to be closed.
  bool poll(double seconds);

  // A frame of the user interface begins; show() ends it and puts it on the screen.
  void begin();
  void show();

  // Of the framebuffer; 0 while it is minimised.
  glm::ivec2 pixels() const;
  // Pixels of a point of text at a scale of 1: 2 on a screen with twice the dots.
  float scale() const { return scale_; }
  // In the desktop's units, while it is neither minimised nor maximised; else as it was before.
  cli::Size size();
  void set_title(const std::string& title);
  void set_vsync(bool on);
  // Files that were dropped on the window since the last call.
  std::vector<std::string> dropped();

 private:
  // Dear ImGui sees which keys and buttons are down between two frames, and where the pointer is by then. On a slow
  // machine a tap or a click is over by that time, and the hand elsewhere: each change is played where it was.
  struct Change {
    enum class Of { key, button, text };
    Of of = Of::key;
    int code = 0;  // GLFW's, or a character
    bool down = false;
    glm::vec2 at{0};  // the pointer, for a button
  };
  void record_input();
  void set_up_interface();
  void play_input();
  void play_text();
  void play_keys();
  void apply(const Change& change);
  void apply_scale(float scale);
  float wanted_scale() const;

  std::unique_ptr<gl::Context> context_;
  GLFWwindow* window_ = nullptr;
  float scale_ = 0;
  cli::Size size_;
  std::vector<std::string> dropped_;
  glm::vec2 pointer_{0};          // as of the events so far, not of this moment
  std::deque<Change> changes_;    // to come
  std::array<bool, 512> keys_{};  // that are down, of those played; as many as Dear ImGui knows
  std::array<bool, 5> buttons_{};
};

// Whether there is a display to open a window on; else what is missing.
std::string missing_display();

}  // namespace penumbra::viewer
