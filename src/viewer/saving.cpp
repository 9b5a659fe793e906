// What the user saves: the view beside the scene, and the open preset. Closing the window asks before it loses them,
// and so does opening another scene.
#include <fmt/format.h>
#include <imgui.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "io/output_file.h"
#include "session/techniques.h"
#include "viewer/view_file.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

// The view that was saved beside a scene that has just been loaded.
void Viewer::take_view() {
  cli::SceneOptions& options = state_.document.options;
  state_.bookmarks = {};
  view_fault_.clear();
  if (options_.defaults) return;
  if (const std::optional<SavedView> view = read_view(options.scene, view_fault_)) {
    use_view(view->options, options);
    state_.bookmarks = view->bookmarks;
    try {
      session::update_view(scene_->prepared, options);
    } catch (const Error& error) {
      leave_out_unknown();
      tell_error(state_, fmt::format("{}: {}", io::quoted(view_file(options.scene)), error.what()), ImGui::GetTime());
    }
  }
  if (!view_fault_.empty()) tell_error(state_, view_fault_, ImGui::GetTime());
}

void Viewer::note_saved_view() { saved_.view = present_edit(); }

void Viewer::note_preset(const std::string& file) {
  state_.preset_file = saved_.preset = file;
  saved_.params = state_.document.params;
  saved_.before = {};
  saved_.undone.clear();
}

// A preset that the command line names alone can be saved as one that was opened in the window.
void Viewer::take_preset_option() {
  const bool alone = options_.presets.size() == 1 && options_.technique.empty() && options_.assignments.empty() &&
                     options_.sun_angle.empty() && options_.exposure.empty();
  if (alone && is_preset(options_.presets.front())) note_preset(options_.presets.front());
}

// Tells the interface what is not saved. Without a scene there is no view to lose.
void Viewer::update_unsaved() {
  if (!options_.defaults) status_.unsaved = unsaved(saved_, present_edit());
  if (scene_ == nullptr) status_.unsaved.view = false;
  status_.unsaved.picture = writer_.runs();
  status_.saved_to = scene_ == nullptr ? "" : view_file(state_.document.options.scene).filename().string();
  status_.preset = saved_.preset;
  if (scene_ == nullptr) return;
  const std::string name = std::filesystem::path(state_.document.options.scene).filename().string();
  std::string title = (status_.unsaved.changes() ? "*" : "") + name + " - Penumbra";
  if (title != title_) window_.set_title(title);
  title_ = std::move(title);
}

void Viewer::save_view() {
  const std::filesystem::path file = view_file(state_.document.options.scene);
  if (!view_fault_.empty()) fail("cannot write {}: what is there could not be read", io::quoted(file));
  write_view(state_.document.options.scene, {.options = state_.document.options, .bookmarks = state_.bookmarks});
  note_saved_view();
  tell(state_, "wrote " + file.string(), ImGui::GetTime());
}

void Viewer::save() {
  if (options_.defaults) fail("nothing is saved: --defaults was given");
  if (scene_ == nullptr && saved_.preset.empty()) fail("nothing is saved: no scene and no preset file is open");
  // Another technique or preset may have been chosen only to look at it.
  const auto selected = [](const ParamSet& params) { return session::selection_of(params).name; };
  const bool same = saved_.preset.empty() || selected(state_.document.params) == selected(saved_.params);
  save(/* view= */ scene_ != nullptr, status_.unsaved.preset, /* overwrite= */ same);
}

// Where one of them can't be written, the other one is.
void Viewer::save(bool view, bool preset, bool overwrite) {
  std::string fault;
  try {
    if (preset) save_preset(saved_.preset, overwrite);
  } catch (const Error& error) {
    fault = error.what();
  }
  if (view) save_view();
  if (!fault.empty()) fail("{}", fault);
}

// Whether the window closes now: the user wants it, and nothing would be lost. Else the next frame asks.
bool Viewer::closes() {
  if (!std::exchange(state_.requests.quit, false)) return false;
  update_unsaved();
  if (!status_.unsaved.any()) return true;
  state_.closing = {.wanted = true};
  window_.restore();
  return false;
}

// Whether that scene is opened now: nothing would be lost. Else the next frame asks. Parameters stay as they are.
bool Viewer::leaves_scene_for(const std::string& scene) {
  update_unsaved();
  if (is_shown(scene) || !status_.unsaved.view) return true;
  state_.closing = {.wanted = true, .scene = scene};
  return false;
}

// Whether opening the scene that was asked for would lose what the user has changed since.
bool Viewer::changed_while_loading() {
  update_unsaved();
  return status_.unsaved.view && unsaved({.view = leaving_}, present_edit()).view;
}

void Viewer::answer_closing(ClosingAnswer answer) {
  if (!state_.closing.scene.empty()) {
    if (answer == ClosingAnswer::save) save_view();
    open(state_.closing.scene);
    return;
  }
  if (answer == ClosingAnswer::save) save(status_.unsaved.view, status_.unsaved.preset, /* overwrite= */ true);
  // The parameters that the next run begins with.
  if (answer == ClosingAnswer::discard && status_.unsaved.preset) state_.document.params = saved_.params;
  ended_ = true;
}

}  // namespace penumbra::viewer
