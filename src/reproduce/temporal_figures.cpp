// Section 2.5 of the thesis: a history of shadows in a scene whose casters move and stop.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "image/read.h"
#include "lib/packed_texel.glsl"
#include "render/receivers.h"
#include "report/table.h"
#include "reproduce/crops.h"
#include "reproduce/figures.h"
#include "scene/gpu_scene.h"
#include "session/render_device.h"

namespace penumbra::reproduce {

namespace {

constexpr double step = 1 / 30.0;                   // s
constexpr int begin = 52, stop = 60, at_rest = 61;  // frames of moving.glb, where all casters rest from 2 s on
constexpr int still_frames = 16;                    // are drawn at rest
constexpr float darker = 0.05f;                     // than at rest: a shadow was here
constexpr float changed = 1 / 255.0f;               // visible with 8 bits
constexpr double lingering = 0.004;                 // 1/255
constexpr double large_share = 10, wasteful = 2;    // %, and times what changed
constexpr const char* wide_sun = "sun.angle=8";
constexpr const char* one_caster = "ball";  // of radius 0.3 m

using Mask = std::vector<std::uint8_t>;

struct DrawnFrame {
  std::vector<float> visibility;
  Mask refused;  // 1 where the history is refused because a caster moved
};

// scenes/moving.glb at the size of the page, drawn with a history of its own.
class MovingScene {
 public:
  // `mover`: the node that alone moves; empty: all do.
  explicit MovingScene(Workbench& bench, const std::string& mover = {})
      : bench_(bench),
        prepared_(load(bench.options(), mover)),
        device_(bench.options(), session::RenderDevice::Timed::nothing),
        scene_(device_.device, prepared_.scene),
        renderer_(device_.device, shadow::built_in_registry()) {}

  // Frames from `first` to `last`, the first one without a history.
  std::vector<DrawnFrame> draw(const ShadowConfig& config, int first, int last) {
    const ParamSet params = bench_.params_of(config);
    std::vector<DrawnFrame> frames;
    for (int frame = first; frame <= last; ++frame) {
      render::FrameInputs inputs =
          frame_inputs(prepared_, bench_.options().size,
                       {.time = frame * step, .last_time = (frame - 1) * step, .cut = frame == first});
      inputs.mask_details = true;
      renderer_.draw(scene_, inputs, params);
      frames.push_back({.visibility = renderer_.read_aov("shadow"), .refused = {}});
      for (const float reason : renderer_.read_aov("history"))
        frames.back().refused.push_back(reason == static_cast<float>(HISTORY_CASTER_MOVED) ? 1 : 0);
      bench_.count_drawn();
    }
    return frames;
  }

  // Of the last frame.
  Mask receivers() const {
    return render::receivers_of(renderer_, prepared_.setup.sun, bench_.params_of(Workbench::pcss_config()));
  }

 private:
  static session::PreparedScene load(const Options& options, const std::string& mover) {
    cli::SceneOptions moving;
    moving.scene = options.moving_scene;
    moving.reading = options.reading;
    moving.size = options.size;
    session::PreparedScene prepared =
        session::load_scene(moving, image::image_decoder(cli::limits_of(options.reading)));
    const auto rests = [&](const scene::AnimationChannel& channel) {
      return !mover.empty() && prepared.scene.nodes[static_cast<std::size_t>(channel.node)].name != mover;
    };
    for (scene::Animation& animation : prepared.scene.animations) std::erase_if(animation.channels, rests);
    return prepared;
  }

  Workbench& bench_;
  session::PreparedScene prepared_;
  session::RenderDevice device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
};

// Receivers that a shadow left in one of the last frames.
Mask trail_of(const std::vector<DrawnFrame>& moving, const std::vector<float>& rest, const Mask& receivers) {
  Mask trail(rest.size());
  for (const DrawnFrame& frame : moving) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (receivers[i] != 0 && frame.visibility[i] < rest[i] - darker) trail[i] = 1;
    }
  }
  return trail;
}

double mean_error(const std::vector<float>& picture, const std::vector<float>& reference, const Mask& mask) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (mask[i] == 0) continue;
    sum += std::abs(static_cast<double>(picture[i]) - static_cast<double>(reference[i]));
    ++count;
  }
  return sum / static_cast<double>(count);
}

Mask changes(const std::vector<float>& last, const std::vector<float>& present) {
  Mask mask(present.size());
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = std::abs(present[i] - last[i]) > changed ? 1 : 0;
  return mask;
}

double percent(const Mask& mask) {
  return 100 * static_cast<double>(std::ranges::count(mask, 1)) / static_cast<double>(mask.size());
}

// Means over the frames after the first.
struct Shares {
  double refused = 0, changed = 0;  // % of the picture
};

Shares shares_of(const std::vector<DrawnFrame>& frames, const std::vector<DrawnFrame>& references) {
  Shares shares;
  const std::size_t count = references.size() - 1;
  for (std::size_t i = 1; i <= count; ++i) {
    shares.refused += percent(frames[i].refused) / static_cast<double>(count);
    shares.changed +=
        percent(changes(references[i - 1].visibility, references[i].visibility)) / static_cast<double>(count);
  }
  return shares;
}

report::Html table_of(const std::vector<Quantity>& quantities) {
  report::Table table{.caption = "scenes/moving.glb, preset thesis.", .columns = {{"What"}, {"Measured"}}, .rows = {}};
  for (const Quantity& quantity : quantities)
    table.rows.push_back({{quantity.name}, {.text = quantity.text(), .value = quantity.value}});
  return report::to_html(table);
}

}  // namespace

Finding section_2_5(Workbench& bench) {
  const ShadowConfig with{"thesis", {}}, without{"thesis", {"movement.map=none"}};
  const ShadowConfig no_history{"thesis", {"history.reuse=false"}};
  const metrics::ImageView shape{.width = bench.width(), .height = bench.height(), .pixels = {}};

  MovingScene all(bench);
  const std::vector<DrawnFrame> references = all.draw({"brute_force", {}}, begin, stop);
  const std::vector<float>& rest = references.back().visibility;
  const Mask receivers = all.receivers();
  const Mask trail = trail_of(references, rest, receivers);
  const std::vector<DrawnFrame> mapped = all.draw(with, begin, at_rest), unmapped = all.draw(without, begin, at_rest);
  const std::vector<DrawnFrame> still = all.draw(with, at_rest, at_rest + still_frames - 1);
  const DrawnFrame fresh = all.draw(no_history, at_rest, at_rest).front();

  MovingScene one(bench, one_caster);
  const std::vector<DrawnFrame> one_references = one.draw({"brute_force", {}}, begin, stop);
  const std::vector<DrawnFrame> one_mapped = one.draw(with, begin, stop);
  const std::vector<DrawnFrame> wide_references = one.draw({"brute_force", {wide_sun}}, begin, stop);
  const Shares of_wide = shares_of(one.draw({"thesis", {wide_sun}}, begin, stop), wide_references);
  const Shares of_all = shares_of(mapped, references), of_one = shares_of(one_mapped, one_references);

  const auto error = [&](const std::string& name, const DrawnFrame& frame) {
    return Quantity{"the mean error of the trail " + name, mean_error(frame.visibility, rest, trail), "", 4};
  };
  const auto psnr = [&](const std::string& name, const DrawnFrame& frame) {
    metrics::ImageView test = shape, reference = shape;
    test.pixels = frame.visibility;
    reference.pixels = rest;
    return Quantity{"the PSNR in the penumbra of " + name,
                    metrics::error_figures(test, reference, receivers).psnr_penumbra, "dB"};
  };
  const Quantity with_map = error("with a movement map", mapped.back());
  const Quantity without_map = error("without a movement map", unmapped.back());
  const Quantity first_error = error("in a frame without a history", still.front());
  const Quantity first = psnr("the first frame at rest", still.front());
  const Quantity last = psnr(fmt::format("frame {} at rest", still_frames), still.back());
  const Quantity same_taps = psnr("a frame at rest without a history and its additional taps", fresh);
  const Quantity refused{"the share of the picture refused while a ball moves", of_one.refused, "%", 1};
  const Quantity moved{"the share of the picture whose shadow changes while a ball moves", of_one.changed, "%", 1};
  const Quantity ratio{"what is refused over what changes while a ball moves", of_one.refused / of_one.changed, "", 1};
  const Quantity wide_refused{"the share of the picture refused while a ball moves under a sun of 8°", of_wide.refused,
                              "%", 1};
  const Quantity wide_moved{"the share of the picture whose shadow changes while a ball moves under a sun of 8°",
                            of_wide.changed, "%", 1};
  const Quantity all_refused{"the share of the picture refused while six casters move", of_all.refused, "%", 1};
  const Quantity all_moved{"the share of the picture whose shadow changes while six casters move", of_all.changed, "%",
                           1};

  Finding finding;
  finding.kind = Finding::Kind::section;
  finding.id = "2.5";
  finding.title = "History and movement map";
  finding.claim =
      "A movement map invalidates the history where casters moved (section 2.5.1), which would leave ghosts otherwise "
      "(research question 3, chapter 6). A history does a great job at improving quality, but mostly a small movement "
      "of some caster invalidates a large area of the screen (chapter 5).";
  finding.test = fmt::format(
      "scenes/moving.glb with the preset thesis, 30 frames a second, against converged PCSS. Ghosts: the mean "
      "error, in the first frame in which nothing moves any more, of receivers that a shadow left in the {} frames "
      "before; with a movement map it must be within 1/255 of that of a frame without a history, without one above "
      "it. Quality: after {} frames at rest the history must have gained 1 dB in the penumbra; the first frame has "
      "more taps, since it has no history. Area: while a ball of 0.3 m hops and nothing else moves, at least a "
      "tenth of the picture must be refused, and twice what changes by more than 1/255 from one frame to the next, "
      "both as means of {} frames. Under a wider sun, which the table has too, the movement map is read in a wider "
      "disc.",
      stop - begin, still_frames, stop - begin);
  std::vector<double> ghosts(rest.size());
  for (std::size_t i = 0; i < ghosts.size(); ++i)
    ghosts[i] =
        trail[i] == 0 ? 0 : std::abs(static_cast<double>(unmapped.back().visibility[i]) - static_cast<double>(rest[i]));
  const Crop crop = best_crop(bench, ghosts);
  const auto cropped = [&](const std::string& title, const std::string& note, const std::vector<float>& visibility) {
    return tile(title, note, enlarged(visibility, bench.width(), crop));
  };
  finding.body = report::tiles({
      cropped("Just stopped, no movement map", "error of the trail " + without_map.text(), unmapped.back().visibility),
      cropped("Just stopped, movement map", "error of the trail " + with_map.text(), mapped.back().visibility),
      cropped("Without a history", "error of the trail " + first_error.text(), still.front().visibility),
      cropped("Converged PCSS", "", rest),
  });
  const std::size_t middle = one_references.size() / 2;
  const std::vector<float>& before = one_references[middle - 1].visibility;
  const std::vector<float>& now = one_references[middle].visibility;
  const auto whole = [&](const std::string& title, const std::string& note, const auto& values) {
    const std::vector<float> pixels(values.begin(), values.end());
    return tile(title, note, enlarged(pixels, bench.width(), bench.height()));
  };
  const Mask differs = changes(before, now);
  finding.body.add(
      report::tiles({whole("A ball moves", "converged PCSS", now),
                     whole("Changes", fmt::format("white: {:.1f} % of this frame", percent(differs)), differs),
                     whole("Refused", fmt::format("white: {:.1f} % of this frame", percent(one_mapped[middle].refused)),
                           one_mapped[middle].refused)}));
  finding.body.add(table_of({without_map, with_map, first_error, same_taps, first, last, refused, moved, wide_refused,
                             wide_moved, all_refused, all_moved}));

  finding.expect_above(without_map, first_error);
  finding.expect_near(with_map, first_error, lingering);
  finding.expect_above_by(clear_gain, last, first);
  finding.record(same_taps);
  finding.expect_at_least(refused, large_share);
  finding.record(moved);
  finding.expect_at_least(ratio, wasteful);
  finding.record(wide_refused);
  finding.record(wide_moved);
  finding.record(all_refused);
  finding.record(all_moved);
  return finding;
}

}  // namespace penumbra::reproduce
