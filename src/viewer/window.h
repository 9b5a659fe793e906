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

  // Handles the pending events, and waits up to `seconds` for one if there are none.
  void poll(double seconds);
  // Whether begin() has input to give to the interface.
  bool has_input() const { return touched_ || has_presses(); }
  // The same, without motion of the pointer and the wheel.
  bool has_presses() const { return !changes_.empty(); }
  // Whether the user has closed the window since the last call; it stays open.
  bool take_close();
  // Whether take_close() or dropped() have something to return, or the window has another size than its last frame.
  bool has_news() const;

  // begin() starts a frame of the user interface; show() ends it and puts it on the screen. Where the screen has it
  // already, show() draws nothing and returns false: the interface consists of the same triangles as in the last frame,
  // and `contents`, which the caller changes whenever a texture in it has other content, is the same.
  void begin();
  bool show(std::uint64_t contents);

  // Of the framebuffer; 0 while it is minimised.
  glm::ivec2 pixels() const;
  // The desktop's content scale, 2 on a screen with twice as many dots per inch, times the user's.
  float scale() const { return scale_; }
  void set_user_scale(float scale) { user_scale_ = scale; }
  // In the desktop's units, while it is neither minimised nor maximised; else as it was before.
  cli::Size size();
  // Shows it again if it is minimised.
  void restore();
  void set_title(const std::string& title);
  void set_vsync(bool on);
  // Files that were dropped on the window since the last call.
  std::vector<std::string> dropped();

 private:
  // Dear ImGui polls keys, buttons and the pointer once a frame. On a slow machine a click can begin and end between
  // two frames, with the pointer elsewhere by then. So each change is recorded with the pointer's place, and given to
  // ImGui in order.
  struct Change {
    enum class Of { key, button, text };
    Of of = Of::key;
    int code = 0;  // GLFW's, or a character
    bool down = false;
    glm::vec2 at{0};  // the pointer, for a button
  };
  void record_input();
  void measure();
  void set_up_interface();
  void play_input();
  void play_text();
  void play_keys();
  bool must_hover(const Change& change) const;
  void apply(const Change& change);
  void apply_scale(float scale);
  float wanted_scale() const;

  std::unique_ptr<gl::Context> context_;
  GLFWwindow* window_ = nullptr;
  float scale_ = 0, user_scale_ = 1;
  cli::Size size_;
  std::vector<std::string> dropped_;
  glm::vec2 dots_{1};             // pixels of the framebuffer over units of the window
  glm::vec2 pointer_{0};          // at the last recorded event
  glm::vec2 hovered_{0};          // in the interface's last frame
  bool touched_ = false;          // the pointer or the wheel moved since begin()
  glm::ivec2 shown_{0};           // size of the last frame, pixels
  std::uint64_t contents_ = 0;    // of its textures
  std::vector<std::byte> drawn_;  // by the interface in it, bytes of vertices and commands
  bool must_show_ = true;         // the screen has lost it, or textures of fonts have changed
  std::deque<Change> changes_;    // recorded, not given to ImGui yet
  std::array<bool, 512> keys_{};  // the keys that ImGui considers pressed; it has 512
  std::array<bool, 5> buttons_{};
};

// Empty if there is a display to open a window on; else what is missing.
std::string missing_display();

}  // namespace penumbra::viewer
