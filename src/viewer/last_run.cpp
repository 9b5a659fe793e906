// What the viewer restores from its last run and saves for the next.
#include "core/log.h"
#include "viewer/panels.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

// Without any shadow option, the parameters are those of the last run.
bool has_no_shadow_options(const cli::ShadowOptions& options) {
  return options.technique.empty() && options.presets.empty() && options.assignments.empty() &&
         options.sun_angle.empty() && options.exposure.empty();
}

}  // namespace

void Viewer::take_settings() {
  if (!fault_.empty()) tell_error(state_, fault_ + "; the defaults are used", 0);
  state_.recent = settings_.recent;
  state_.panel = settings_.panel;
  state_.vsync = settings_.vsync;
  state_.panel_width = settings_.panel_width;
  state_.panel_share = settings_.panel_share;
  state_.scale = settings_.scale;
  state_.tab = settings_.tab;
  if (!settings_.params.rows().empty() && has_no_shadow_options(options_)) state_.document.params = settings_.params;
}

void Viewer::keep_settings() {
  // A file that could not be read is kept: the user may repair it, or a later version has written it.
  if (options_.defaults || !fault_.empty()) return;
  try {
    write_settings({.recent = state_.recent,
                    .window = window_.size(),
                    .panel = state_.panel,
                    .vsync = state_.vsync,
                    .panel_width = state_.panel_width,
                    .panel_share = state_.panel_share,
                    .scale = state_.scale,
                    .tab = state_.open_tab.empty() ? state_.tab : state_.open_tab,
                    .params = state_.document.params});
  } catch (const Error& error) {
    warn("{}", error.what());
  }
}

}  // namespace penumbra::viewer
