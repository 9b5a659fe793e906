#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/frame_options.h"

namespace penumbra::app {

// What `penumbra render` was asked for; every value is parsed and in range.
struct RenderOptions : FrameOptions {
  std::optional<int> frame;  // one frame of a sequence, whose picture has no number; `frames` is then that frame
  int warmup = 0;
  bool warmup_still = false;  // all warm-up frames are drawn at the time of the first frame
  std::string save_preset;
  std::vector<std::string> aovs;
  bool average_aovs = false;  // over all samples of a pixel, where that means something; else they are the first one's
  std::string stats;
  int stats_frames = 1;

  bool is_sequence() const { return frames && !frame; }
};

// Where the user names no technique, that of session::usual_technique: maps of a picture that is no frame of a sequence
// are then fitted to it, and have a second layer where casters overlap, unless cascades.fit or maps.layers are set.
ParamSet params_of(const RenderOptions& options);

void add_render_options(CLI::App& app, RenderOptions& options);

// Warns of options that change nothing beside the others.
void warn_without_effect(const RenderOptions& options, const ParamSet& params);

// Throws UsageError for options that can't be combined.
void check_together(const RenderOptions& options);

}  // namespace penumbra::app
