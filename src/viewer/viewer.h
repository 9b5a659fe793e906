#pragma once

#include <imgui.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "gl/pass.h"
#include "render/renderer.h"
#include "session/file_watch.h"
#include "session/render_device.h"
#include "truth/technique.h"
#include "viewer/costs.h"
#include "viewer/edit.h"
#include "viewer/frame_pacing.h"
#include "viewer/frame_plan.h"
#include "viewer/history.h"
#include "viewer/options.h"
#include "viewer/picture_area.h"
#include "viewer/picture_renderer.h"
#include "viewer/render_process.h"
#include "viewer/scene_loader.h"
#include "viewer/settings.h"
#include "viewer/state.h"
#include "viewer/status.h"
#include "viewer/unsaved.h"
#include "viewer/widgets.h"
#include "viewer/window.h"

namespace penumbra::viewer {

// The desktop viewer: a window in which a scene is drawn by the same code as offscreen, with panels to change its
// options and parameters.
class Viewer {
 public:
  // Throws Error where there is no display, or the options' values are wrong.
  explicit Viewer(ViewOptions options);
  ~Viewer();

  // Until the window is closed. Returns the exit code.
  int run();

 private:
  // What a picture is drawn for.
  struct Wishes {
    std::string picture;  // the text of A's document
    Comparison comparison;
    Zoom zoom;
    Requests requests;
    glm::ivec2 size{0};  // of the picture's area, pixels
    bool playing = false;

    bool operator==(const Wishes&) const = default;
  };
  // What could not be drawn of a picture.
  struct Failed {
    std::optional<std::uint64_t> shaders = {};  // with what ShaderLibrary::changes() counted then
    bool reduced = false;                       // in less than full detail
    std::optional<Wishes> full = {};            // in full detail, for these
  };
  // One of the two pictures, A or B: what draws it, what it cost and the values read back from it.
  struct Side {
    Side(gl::Device& device, render::Renderer& shared, int view) : renderer(device, shared, view) {}
    PictureRenderer renderer;
    Costs costs;
    Detail detail;                  // of the last frame
    Values values;                  // of the inspected AOV or texture
    int reads = 0;                  // how often they were read back
    std::vector<float> visibility;  // if measured
    bool measured = false;          // the visibility is that of the finished picture
    bool untraced = false;          // it was drawn before the rays of all its lights were traced
    Failed failed;
    const gl::Texture* colors = nullptr;  // its values in false colour, if any are inspected
    const gl::Texture* shown = nullptr;   // its picture, or these colours
  };
  // A rectangle of the window, its pixels.
  struct Box {
    ImVec2 corner, size;
  };
  // Where the parts of the window are.
  struct Places {
    Box panel, picture, status;
    bool beside = true;  // the panel is at the picture's left, not below it
  };
  // What a frame does for both.
  struct PictureWork {
    Document b;
    bool b_shown = false;
    FramePlan plan;
  };
  // What a frame does for one of them.
  struct SideWork {
    Side& side;
    const Document& document;
    const PicturePlan& plan;
  };

  void show_frames();
  double pause() const;
  void frame();
  void begin_interface();
  void show_interface();
  void take_events();
  std::optional<SceneLoader::Loaded> finished_scene();
  void take_loaded();
  void load_again();
  void take_saved();
  void take_shaders(std::span<const std::filesystem::path> changed);
  void play(float seconds);
  Places places(bool with_panel, float menus) const;
  PictureArea build_interface();
  void side_panel(const Panel& panel, const Box& box);
  void panel_edge(const Panel& panel, const Box& box, bool upright);
  void status_window(const Panel& panel, const Box& box);
  PictureArea picture_window(const Panel& panel, const Box& box);
  std::optional<PictureWork> plan_pictures(const PictureArea& area, double now);
  Wishes drawn_wishes() const;
  bool is_undrawable(const Side& side) const;
  void mind_failures(PictureWork& work);
  void note_failure(Side& side, const Detail& detail);
  void draw_pictures(const PictureWork& work);
  void draw_at_rest(const PictureWork& work);
  Wishes wishes() const;
  void attend();
  void answer(int frames);
  void show_first_sample(Side& side);
  FrameState frame_state(const Document& b, const PictureArea& area, double now);
  void take_traced(const Document& b);
  void draw_sides(std::span<const SideWork> work, const Detail& detail);
  void note_progress();
  void measure(Side& side);
  void forget_b();
  bool is_last_of_refined(const Side& side, const Document& document) const;
  bool draw_side(const SideWork& work, const Detail& detail);
  void inspect(Side& side);
  void color_values(bool differ);
  void color(Side& side, const Values& values, int number);
  void measure_difference();
  bool probes(const PictureArea& area) const;
  std::optional<glm::ivec2> probed_pixel(const PictureArea& area);
  void probe(const PictureArea& area);
  void read_texel(const PictureArea& area);
  bool shows_texture_alone() const;
  std::uint64_t contents() const;
  void show_pictures();
  PresentInputs present_inputs(const glm::ivec2& window_size) const;
  void do_requests();
  bool is_shown(const std::string& scene) const;
  void open(const std::string& asked);
  void open_preset(const std::string& file);
  // Asks first where it would overwrite a preset, unless the user has agreed.
  void save_preset(const std::string& file, bool overwrite);
  std::vector<std::string> command() const;
  void copy_command();
  void write_picture(bool sequence);
  void take_written();
  void take_view();
  void note_saved_view();
  void take_preset_option();
  void note_preset(const std::string& file);
  void update_unsaved();
  void save_view();
  void save();
  void save(bool view, bool preset, bool overwrite);
  bool closes();
  bool leaves_scene_for(const std::string& scene);
  bool changed_while_loading();
  void answer_closing(ClosingAnswer answer);
  Edit present_edit() const;
  void note_edit();
  void go_back(bool redo);
  void copy_camera();
  void frame_casters();
  void take_settings();
  void keep_settings();
  void update_view();
  void leave_out_unknown();
  // Runs an action; an Error that it throws becomes a message to the user.
  void guarded(const std::function<void()>& action);

  ViewOptions options_;
  std::string fault_;  // why the last run's settings could not be read
  Settings settings_;
  Window window_;
  session::RenderDevice device_;
  truth::TruthTechnique truth_;
  render::Renderer renderer_;
  std::unique_ptr<LoadedScene> scene_;
  SceneLoader loader_;
  std::vector<std::string> failed_loads_;    // why scenes could not be read, until one has been read
  std::optional<session::FileWatch> watch_;  // absent if the system's limit of watches is reached
  RenderProcess writer_;
  UiState state_;
  History<Edit> history_;
  SavedState saved_;
  Edit leaving_;            // the view when another scene was asked for
  std::string view_fault_;  // why the view beside the scene could not be read
  std::string title_;
  bool ended_ = false;
  Side a_, b_;
  FramePacing pacing_;
  CostReader cost_reader_;
  Costs unshown_costs_;  // of frames with shadows of their own for all samples
  WidgetMap widgets_;
  ViewerStatus status_;
  std::string view_options_;                // the options that camera and sun were last chosen for
  std::string inspected_, colored_;         // what values were last read back from, and coloured
  bool readable_ = false;                   // the renderer's last frame succeeded, so values can be read back
  bool last_is_b_ = false;                  // it drew B
  bool probe_is_old_ = false;               // a picture was drawn since values were last probed
  glm::ivec2 window_size_{1};               // of the picture's area, pixels
  const gl::Texture* presented_ = nullptr;  // what the window shows of the pictures
  // What that was drawn from, to be compared alone: its textures may be gone. Their contents(), and the texture's
  // serial.
  PresentInputs presented_inputs_;
  std::uint64_t presented_contents_ = 0, presented_texture_ = 0;
  std::uint64_t presents_ = 0;   // how often it was drawn
  std::uint64_t colorings_ = 0;  // how often values were coloured
  // Frames of the interface after the last press: a list or a question that opens takes some to find its size.
  static constexpr int settling = 4;
  int unsettled_ = 0;            // those to come before a picture is begun that takes long
  std::optional<Wishes> begun_;  // what the picture at rest is drawn for that is being drawn
  bool dragging_ = false;        // the user held a button over the picture in the last frame
  bool attending_ = false;       // a picture is being drawn, between two of its passes
  bool vsync_ = true;
  bool interface_changed_ = true;  // the last frame of the interface differed from the one before
  double last_draw_ = 0;
  double history_began_ = -1e9;  // when A's last history began, seconds
  TurnClock turn_;
};

}  // namespace penumbra::viewer
