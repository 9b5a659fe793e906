#include "viewer/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <span>
#include <utility>

#include "core/error.h"
#include "gl/api.h"
#include "viewer/theme.h"

namespace penumbra::viewer {

namespace {

constexpr float text_size = 15.0f;  // pixels, at a scale of 1

// The path of an installed font that covers more scripts than ImGui's built-in one, which has only Latin letters; file
// names may need them.
const char* font_file() {
  static constexpr std::array places{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                     "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                                     "/usr/share/fonts/TTF/DejaVuSans.ttf"};
  for (const char* place : places) {
    if (std::filesystem::exists(place)) return place;
  }
  return nullptr;
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

gl::ContextOptions context_options(const Window::Options& options) {
  gl::ContextOptions wanted;
  wanted.debug = wanted.debug || options.debug;
  wanted.width = options.width;
  wanted.height = options.height;
  return wanted;
}

// What the interface draws: equal bytes are equal pixels, as long as textures have the same content.
std::vector<std::byte> bytes_of(const ImDrawData& data) {
  std::vector<std::byte> bytes;
  const auto add = [&](const auto* items, int count) {
    const auto* first = reinterpret_cast<const std::byte*>(items);  // NOLINT: to compare them
    bytes.insert(bytes.end(), first, first + static_cast<std::size_t>(count) * sizeof(*items));
  };
  for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
    add(list->VtxBuffer.Data, list->VtxBuffer.Size);
    add(list->IdxBuffer.Data, list->IdxBuffer.Size);
    for (const ImDrawCmd& command : list->CmdBuffer) {
      add(&command.ClipRect, 1);
      add(&command.TextureId, 1);
      add(&command.VtxOffset, 1);
      add(&command.IdxOffset, 1);
      add(&command.ElemCount, 1);
    }
  }
  return bytes;
}

}  // namespace

std::string missing_display() {
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") ? "" : "neither DISPLAY nor WAYLAND_DISPLAY is set";
}

Window::Window(const Options& options)
    : context_(gl::make_window_context(context_options(options))), window_(gl::window_of(*context_)) {
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    self.dropped_.insert(self.dropped_.end(), paths, paths + count);
  });
  glfwSetWindowRefreshCallback(
      window_, [](GLFWwindow* window) { static_cast<Window*>(glfwGetWindowUserPointer(window))->must_show_ = true; });
  record_input();
  set_up_interface();
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Window::record_input() {
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    if (key < 0 || key >= static_cast<int>(self.keys_.size()) || action == GLFW_REPEAT) return;
    self.changes_.push_back({.of = Change::Of::key, .code = key, .down = action == GLFW_PRESS});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    self.pointer_ = {x, y};
    self.touched_ = true;
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->touched_ = true;
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
    auto& self = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    if (button < 0 || button >= static_cast<int>(self.buttons_.size())) return;
    self.changes_.push_back(
        {.of = Change::Of::button, .code = button, .down = action == GLFW_PRESS, .at = self.pointer_});
  });
}

void Window::set_up_interface() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the viewer keeps its own settings
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  ImGui_ImplGlfw_InitForOpenGL(window_, /* install_callbacks= */ true);
  // Replaces ImGui's callback, which would handle a character at once, before key presses that are still queued.
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))
        ->changes_.push_back({.of = Change::Of::text, .code = static_cast<int>(character)});
  });
  ImGui_ImplOpenGL3_Init("#version 450 core");
  apply_scale(wanted_scale());
}

float Window::wanted_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return user_scale_ * (std::isfinite(x) && x > 0 ? x : 1.0f);
}

void Window::apply_scale(float scale) {
  const bool is_first = scale_ == 0;
  scale_ = scale;
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const float size = std::round(text_size * scale);
  if (const char* file = font_file()) {
    static constexpr std::array<ImWchar, 9> ranges{0x20, 0x24f, 0x370, 0x3ff, 0x2000, 0x22ff, 0x25a0, 0x25ff, 0};
    io.Fonts->AddFontFromFileTTF(file, size, nullptr, ranges.data());
  } else {
    ImFontConfig config;
    config.SizePixels = size;
    io.Fonts->AddFontDefault(&config);
  }
  // The first frame creates the first texture. Not all of the backend's objects are replaced: Dear ImGui 1.86 would
  // believe that its new buffers are as large as the old ones, and draw nothing.
  if (!is_first) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  set_theme(scale);
  must_show_ = true;
}

void Window::poll(double seconds) {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) must_show_ = true;
  if (seconds > 0 && changes_.empty()) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

bool Window::take_close() {
  const bool closed = glfwWindowShouldClose(window_) != GLFW_FALSE;
  if (closed) glfwSetWindowShouldClose(window_, GLFW_FALSE);
  return closed;
}

bool Window::has_news() const {
  return !dropped_.empty() || glfwWindowShouldClose(window_) != GLFW_FALSE || pixels() != shown_;
}

// Whether a press has to wait for a frame with the pointer at its place: some widgets of ImGui, such as tabs, are
// pressed only if they were hovered in the frame before.
bool Window::must_hover(const Change& change) const {
  return change.of == Change::Of::button && change.down && change.at != hovered_;
}

void Window::apply(const Change& change) {
  ImGuiIO& io = ImGui::GetIO();
  switch (change.of) {
    case Change::Of::key:
      keys_.at(static_cast<std::size_t>(change.code)) = change.down;
      break;
    case Change::Of::button:
      buttons_.at(static_cast<std::size_t>(change.code)) = change.down;
      io.MousePos = {change.at.x, change.at.y};
      break;
    case Change::Of::text:
      io.AddInputCharacter(static_cast<unsigned>(change.code));
      break;
  }
}

// Presses go into one frame and releases into another, so that nothing is pressed and released in the same frame, and a
// key is pressed together with its modifiers. A mouse button ends its frame, because ImGui has one pointer position per
// frame.
void Window::play_keys() {
  const auto changes_state = [](const Change& change) { return change.of != Change::Of::text; };
  const auto first = std::find_if(changes_.begin(), changes_.end(), changes_state);
  const bool down = first != changes_.end() && first->down;
  for (bool clicked = false; !clicked && !changes_.empty();) {
    const Change change = changes_.front();
    if (changes_state(change) && change.down != down) break;
    if (must_hover(change)) {
      ImGui::GetIO().MousePos = {change.at.x, change.at.y};
      break;
    }
    changes_.pop_front();
    apply(change);
    clicked = change.of == Change::Of::button;
  }
}

// All pending characters go into one frame. An editing key, or a key with Ctrl, gets a separate frame after the
// characters before it, because an ImGui text field handles the characters of a frame first, and ignores them while
// Ctrl is down.
void Window::play_text() {
  const auto is_letter = [&](const Change& change) {
    const bool modified = keys_[GLFW_KEY_LEFT_CONTROL] || keys_[GLFW_KEY_RIGHT_CONTROL];
    constexpr int first_special = GLFW_KEY_ESCAPE;
    const bool shift = change.code == GLFW_KEY_LEFT_SHIFT || change.code == GLFW_KEY_RIGHT_SHIFT;
    return change.of == Change::Of::text || shift ||
           (change.of == Change::Of::key && change.code < first_special && !modified);
  };
  bool any = false;
  while (!changes_.empty()) {
    const Change change = changes_.front();
    const bool letter = is_letter(change);
    if (any && !letter) break;
    if (must_hover(change)) {
      ImGui::GetIO().MousePos = {change.at.x, change.at.y};
      break;
    }
    changes_.pop_front();
    apply(change);
    if (!letter) break;
    any = true;
  }
}

void Window::play_input() {
  ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput) {
    play_text();
  } else {
    play_keys();
  }
  hovered_ = {io.MousePos.x, io.MousePos.y};
  std::copy(buttons_.begin(), buttons_.end(), std::begin(io.MouseDown));
  std::copy(keys_.begin(), keys_.end(), std::begin(io.KeysDown));
  io.KeyCtrl = keys_[GLFW_KEY_LEFT_CONTROL] || keys_[GLFW_KEY_RIGHT_CONTROL];
  io.KeyShift = keys_[GLFW_KEY_LEFT_SHIFT] || keys_[GLFW_KEY_RIGHT_SHIFT];
  io.KeyAlt = keys_[GLFW_KEY_LEFT_ALT] || keys_[GLFW_KEY_RIGHT_ALT];
}

// Dear ImGui's backend asks for the window's size and for its framebuffer's, one after the other. If the window is
// resized in between, their ratio is no scale: so both are asked for until the window has the same size before and
// after.
void Window::measure() {
  constexpr int most_tries = 16;
  glm::ivec2 before(-1), after(0), framebuffer(0);
  for (int i = 0; i < most_tries && before != after; ++i) {
    glfwGetWindowSize(window_, &before.x, &before.y);
    glfwGetFramebufferSize(window_, &framebuffer.x, &framebuffer.y);
    glfwGetWindowSize(window_, &after.x, &after.y);
  }
  ImGuiIO& io = ImGui::GetIO();
  if (before == after && after.x > 0 && after.y > 0) dots_ = glm::vec2(framebuffer) / glm::vec2(after);
  io.DisplaySize = {static_cast<float>(after.x), static_cast<float>(after.y)};
  io.DisplayFramebufferScale = {dots_.x, dots_.y};
}

void Window::begin() {
  if (const float scale = wanted_scale(); scale != scale_) apply_scale(scale);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  measure();
  touched_ = false;
  play_input();
  ImGui::NewFrame();
}

bool Window::show(std::uint64_t contents) {
  ImGui::Render();
  const glm::ivec2 size = pixels();
  std::vector<std::byte> drawn = bytes_of(*ImGui::GetDrawData());
  if (!must_show_ && size == shown_ && contents == contents_ && drawn == drawn_) return false;
  must_show_ = false;
  shown_ = size;
  contents_ = contents;
  drawn_ = std::move(drawn);
  gl::glBindFramebuffer(GL_FRAMEBUFFER, 0);
  gl::glViewport(0, 0, size.x, size.y);
  gl::glClearColor(0.07f, 0.07f, 0.07f, 1.0f);
  gl::glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
  return true;
}

glm::ivec2 Window::pixels() const {
  glm::ivec2 size(0);
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) return size;
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

cli::Size Window::size() {
  const bool usual =
      glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == 0 && glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == 0;
  if (usual) glfwGetWindowSize(window_, &size_.width, &size_.height);
  return size_;
}

void Window::restore() {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0) glfwRestoreWindow(window_);
}

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

void Window::set_vsync(bool on) { glfwSwapInterval(on ? 1 : 0); }

std::vector<std::string> Window::dropped() { return std::exchange(dropped_, {}); }

}  // namespace penumbra::viewer
