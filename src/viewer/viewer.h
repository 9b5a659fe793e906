#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gl/pass.h"
#include "render/renderer.h"
#include "session/file_watch.h"
#include "truth/technique.h"
#include "viewer/costs.h"
#include "viewer/facts.h"
#include "viewer/options.h"
#include "viewer/pace.h"
#include "viewer/painter.h"
#include "viewer/picture_area.h"
#include "viewer/plan.h"
#include "viewer/render_process.h"
#include "viewer/scene_loader.h"
#include "viewer/settings.h"
#include "viewer/state.h"
#include "viewer/widgets.h"
#include "viewer/window.h"

namespace penumbra::viewer {

// The desktop viewer: a window in which a scene is drawn by the same code as offscreen, and all that tunes it.
class Viewer {
 public:
  // Throws Error where there is no display, or the first values are wrong.
  explicit Viewer(ViewOptions options);
  ~Viewer();

  // Until the window is closed. Returns the exit code.
  int run();

 private:
  // One of the two pictures, what it cost and, where numbers are looked at, these.
  struct Side {
    Side(gl::Device& device, render::Renderer& renderer, int view) : painter(device, renderer, view) {}
    Painter painter;
    Costs costs;
    int divisor = 1;                    // of the last frame
    Values values;                      // of what is inspected
    int reads = 0;                      // of them, so far
    std::vector<float> visibility;      // if measured
    bool measured = false;              // at rest, as it is seen
    const gl::Texture* seen = nullptr;  // its picture, or its values in false colour
  };

  void show_frames();
  void frame(float seconds);
  void take_events();
  void take_loaded();
  void take_saved();
  void take_shaders(std::span<const std::filesystem::path> changed);
  void play(float seconds);
  PictureArea build_interface(float seconds);
  void side_panel(const Panel& panel);
  void draw_pictures(const PictureArea& area, double now);
  Situation situation_of(const Document& b, const PictureArea& area, double now);
  void take_traced(const Document& b);
  void draw_sides(const Plan& plan, const Document& b, double now);
  void measure(Side& side);
  void forget_b();
  bool draw_side(Side& side, const Document& document, int divisor, bool measures);
  Document document_b() const;
  void inspect(Side& side);
  void color_values(bool differ);
  void color(Side& side, const Values& values, int number);
  void measure_distance();
  bool probes(const PictureArea& area) const;
  void probe(const PictureArea& area);
  void show_pictures();
  PresentInputs present_inputs(const glm::ivec2& window_size) const;
  void do_requests();
  void open(const std::string& scene);
  void open_preset(const std::string& file);
  void save_preset(const std::string& file);
  std::vector<std::string> command() const;
  void copy_command();
  void write_picture(bool sequence);
  void take_written();
  void copy_camera();
  void frame_all();
  void take_settings();
  void keep_settings();
  void aim();
  // Tells the user of an Error that it throws, and goes on.
  void guarded(const std::function<void()>& action);

  ViewOptions options_;
  std::string fault_;  // of the last run's settings
  Settings settings_;
  Window window_;
  gl::DeviceInfo device_info_;
  gl::Device device_;
  truth::TruthTechnique truth_;
  render::Renderer renderer_;
  std::unique_ptr<LoadedScene> scene_;
  SceneLoader loader_;
  std::optional<session::FileWatch> watch_;  // absent: the system has none left
  RenderProcess writer_;
  State state_;
  Side a_, b_;
  Pace pace_;
  CostReader cost_reader_;
  WidgetMap widgets_;
  Facts facts_;
  std::string aimed_;                // the options that camera and sun were last chosen for
  std::string inspected_, colored_;  // what values were last read of, and coloured
  bool readable_ = false;            // the renderer's last frame; it is
  bool last_is_b_ = false;           // B's
  std::optional<glm::ivec2> last_probed_;
  glm::ivec2 window_size_{1};  // of the picture's area, pixels
  bool vsync_ = true;
  double last_draw_ = 0;
};

}  // namespace penumbra::viewer
