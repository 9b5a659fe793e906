// What the user asked for with a widget or a key, done between two frames of the interface.
#include <imgui.h>

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "cli/output_names.h"
#include "cli/text.h"
#include "core/error.h"
#include "io/output_file.h"
#include "io/presets.h"
#include "render/framing.h"
#include "session/techniques.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

constexpr const char* copied = "copied: ";  // how the message begins that shows what the clipboard has

// A preset overwrites nothing but another preset file: many other programs have files that end in .toml too.
void check_overwrites_preset(const std::string& file) {
  if (!is_preset(file)) fail("cannot write {}: the name of a preset file ends in .toml", io::quoted(file));
  std::error_code unread;
  if (!std::filesystem::is_regular_file(file, unread)) return;
  cli::ShadowOptions options;
  options.presets = {file};
  try {
    cli::resolve_params(options, session::all_techniques());
  } catch (const Error& error) {
    fail("cannot write {}: what is there is no preset ({})", io::quoted(file), error.what());
  }
}

}  // namespace

void Viewer::do_requests() {
  const Requests wanted = std::exchange(state_.requests, {});
  guarded([&] {
    if (wanted.open && leaves_scene_for(*wanted.open)) open(*wanted.open);
    if (wanted.open_preset) open_preset(*wanted.open_preset);
    if (wanted.save_preset) save_preset(*wanted.save_preset, /* overwrite= */ false);
    if (wanted.overwrite_preset) save_preset(*wanted.overwrite_preset, /* overwrite= */ true);
    if ((wanted.write_picture || wanted.write_sequence) && scene_ != nullptr) write_picture(wanted.write_sequence);
    if (wanted.stop_writing) writer_.stop();
    if (wanted.frame_casters && scene_ != nullptr) frame_casters();
    if (wanted.undo || wanted.redo) go_back(wanted.redo);
    if (wanted.copy_command && scene_ != nullptr) copy_command();
    if (wanted.copy_camera && scene_ != nullptr) copy_camera();
    if (wanted.save) save();
    if (wanted.closing) answer_closing(*wanted.closing);
  });
}

// Whether that file is the scene that is shown, by whichever path.
bool Viewer::is_shown(const std::string& scene) const {
  const std::string& shown = state_.document.options.scene;
  std::error_code unread;
  return scene == shown || std::filesystem::equivalent(scene, shown, unread);
}

void Viewer::open(const std::string& asked) {
  const std::string scene = is_shown(asked) ? state_.document.options.scene : asked;
  // Watched before it is read: a file that fails is read again when it is saved.
  guarded([&] {
    std::vector<std::filesystem::path> files{scene};
    if (scene_ != nullptr)
      files.insert(files.end(), scene_->prepared.scene.files.begin(), scene_->prepared.scene.files.end());
    if (watch_) watch_->set_files(std::move(files));
  });
  cli::SceneOptions options;
  options.scene = scene;
  options.fps = options_.fps;
  options.samples = options_.samples;
  options.frames = cli::FrameRange{};
  options.reading.limits = options_.reading.limits;
  options.reading.follow_links = options_.reading.follow_links;
  options.reading.skies_chosen = state_.document.options.reading.skies_chosen;
  // The shown scene keeps its camera, sun, ground and time; another one starts with the defaults.
  if (scene == state_.document.options.scene && scene_ != nullptr) return load_again();
  leaving_ = present_edit();
  loader_.start(scene == state_.document.options.scene ? state_.document.options : options);
}

void Viewer::open_preset(const std::string& file) {
  if (std::error_code unread; std::filesystem::is_fifo(file, unread))
    fail("cannot read {}: it is a pipe, and the window would wait for it", io::quoted(file));
  cli::ShadowOptions options;
  options.presets = {file};
  const ParamSet before =
      std::exchange(state_.document.params, cli::resolve_params(options, session::all_techniques()));
  if (is_preset(file)) {
    note_preset(file);
    if (before != state_.document.params) saved_.before = before;
  } else {
    saved_.preset.clear();  // one of the program's own is no file to save to
    saved_.undone.clear();
  }
  tell(state_, "loaded " + file, ImGui::GetTime());
}

void Viewer::save_preset(const std::string& file, bool overwrite) {
  check_overwrites_preset(file);
  if (scene_ != nullptr) {
    for (const std::filesystem::path& read : scene_->prepared.scene.files) {
      if (io::would_replace(file, read)) fail("cannot write {}: it is a file of the scene", io::quoted(file));
    }
  }
  std::error_code unread;
  if (!overwrite && std::filesystem::exists(file, unread)) {
    state_.overwrite = {true, file};
    state_.panel = true;
    state_.tab = "Shadow";  // which asks
    return;
  }
  io::write_preset(file, state_.document.params);
  note_preset(file);
  tell(state_, "wrote " + file, ImGui::GetTime());
}

std::vector<std::string> Viewer::command() const {
  return render_arguments(state_.document, state_.picture_file, warmup_of(state_.document), options_.glsl);
}

void Viewer::copy_command() {
  const std::string text = cli::command_text("penumbra", command());
  ImGui::SetClipboardText(text.c_str());
  tell(state_, copied + text, ImGui::GetTime(), copied);
}

void Viewer::write_picture(bool sequence) {
  std::vector<std::string> arguments =
      render_arguments(state_.document, state_.picture_file, warmup_of(state_.document), options_.glsl,
                       sequence ? std::optional(state_.sequence) : std::nullopt);
  const cli::FrameRange one{state_.document.frame, state_.document.frame};
  const cli::FrameRange range = sequence ? state_.sequence : one;
  if (state_.with_aovs) {
    for (const render::Aov& aov : render::aovs()) arguments.push_back("--aov=" + aov.name);
  }
  for (std::string& argument : cache_arguments(options_)) arguments.push_back(std::move(argument));
  if (options_.threads) arguments.push_back(fmt::format("--threads={}", *options_.threads));
  // Without a window the driver may offer only a software rasteriser.
  if (!device_.info.software) arguments.emplace_back("--backend=window");
  const cli::OutputNames names(state_.picture_file, sequence);
  std::vector<std::filesystem::path> files;
  for (int frame = range.first; frame <= range.last; ++frame) files.push_back(names.picture(frame));
  writer_.start(arguments, std::move(files));
}

// Shows how far writing is, and its result.
void Viewer::take_written() {
  status_.writing = writer_.runs() ? std::optional(writer_.progress()) : std::nullopt;
  const std::optional<RenderProcess::Result> result = writer_.finished();
  if (!result) return;
  status_.writing.reset();
  if (result->good) {
    tell(state_, result->text, ImGui::GetTime());
  } else {
    tell_error(state_, result->text, ImGui::GetTime());
  }
}

Edit Viewer::present_edit() const { return edit_of(state_.document, state_.comparison, state_.bookmarks); }

// Lets the history see what the user has changed. Notches of the wheel, and keys that move the camera, belong together
// if they follow each other closely.
void Viewer::note_edit() {
  constexpr double pause = 0.5;
  const bool held = ImGui::IsAnyItemActive() || ImGui::GetTime() - state_.last_travel < pause;
  history_.note(present_edit(), held);
  status_.can_undo = history_.can_undo();
  status_.can_redo = history_.can_redo();
  update_unsaved();
}

void Viewer::go_back(bool redo) {
  if (ImGui::IsAnyItemActive()) return;  // the user holds what would change
  const Edit now = present_edit();
  const std::optional<Edit> edit = redo ? history_.redo(now) : history_.undo(now);
  if (!edit) return;
  restore(*edit, state_.document, state_.comparison, state_.bookmarks);
  if (now.a == edit->a) return;
  // With the values from before a preset was opened, it is not open.
  if (!redo && edit->a == saved_.before && !saved_.preset.empty()) {
    saved_.undone = std::exchange(saved_.preset, {});
  } else if (redo && edit->a == saved_.params && !saved_.undone.empty()) {
    saved_.preset = std::exchange(saved_.undone, {});
  }
}

void Viewer::copy_camera() {
  const std::string text = cli::command_text("", camera_arguments(state_.document.options));
  ImGui::SetClipboardText(text.c_str());
  tell(state_, text.empty() ? "copied: nothing, since the camera is the default one" : copied + text, ImGui::GetTime(),
       copied);
}

void Viewer::frame_casters() {
  const session::PreparedScene& prepared = scene_->prepared;
  CameraRig rig = present_rig(state_.document, prepared);
  const scene::Pose pose = scene::pose_at(prepared.scene, state_.document.seconds());
  const scene::CasterChoice choice =
      render::caster_choice(state_.document.params, render::frame_lights(prepared.setup), session::all_techniques());
  rig.frame(render::caster_bounds(prepared.scene, pose, choice),
            static_cast<float>(window_size_.x) / static_cast<float>(window_size_.y));
  place(state_.document, prepared, rig);
  state_.zoom = {};
}

}  // namespace penumbra::viewer
