#include "app/render/drawing.h"

#include <algorithm>

#include "app/render/stats.h"
#include "cli/progress.h"
#include "io/output_file.h"
#include "io/presets.h"

namespace penumbra::app {

namespace {

// Draws a warm-up frame without advancing time: the first is drawn at its time, the others repeat it.
void draw_still(session::RenderSession& session, int frame, const ParamSet& params, bool first, int samples) {
  if (first) {
    session.draw(frame, params, samples);
  } else {
    session.redraw(params, samples);
  }
}

bool wants_mask_details(const RenderOptions& options) {
  return std::ranges::any_of(render::aovs(), [&](const render::Aov& aov) {
    return aov.mask_details && std::ranges::find(options.aovs, aov.name) != options.aovs.end();
  });
}

}  // namespace

void draw_frames(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                 const cli::FrameRange& range, const std::function<void(int frame)>& drawn) {
  if (wants_mask_details(options)) session.keep_mask_details();
  if (options.average_aovs) session.average_aovs(options.aovs);
  cli::Progress progress("frame", options.warmup + range.count(), !options.quiet);
  for (int frame = range.first - options.warmup; frame <= range.last; ++frame) {
    const int samples = frame < range.first ? 1 : options.samples;  // of warm-up frames nobody sees edges
    if (options.warmup_still && frame <= range.first) {
      draw_still(session, range.first, params, frame == range.first - options.warmup, samples);
    } else {
      session.draw(frame, params, samples);
    }
    if (frame >= range.first) drawn(frame);
    progress.step();
  }
}

std::size_t measure(const RenderOptions& options, session::RenderSession& session, const ParamSet& params,
                    const cli::FrameRange& range) {
  if (range.count() > 1) return static_cast<std::size_t>(range.count() - (options.warmup == 0 ? 1 : 0));
  ParamSet all = params;
  all.set("maps.keep", false);
  for (int i = 0; i < options.stats_frames; ++i) session.redraw(all, options.samples);
  return static_cast<std::size_t>(options.stats_frames);
}

void write_reports(const RenderOptions& options, const session::PreparedScene& prepared, const ParamSet& params,
                   session::RenderSession& session, std::size_t measured) {
  if (!options.stats.empty())
    io::write_text(options.stats, io::text_of(stats_of(options, prepared, params, session, measured)));
  if (!options.save_preset.empty()) io::write_preset(options.save_preset, params);
}

}  // namespace penumbra::app
