#include "library_params.h"

#include <iterator>
#include <utility>

#include "cascades.h"
#include "samples.h"

namespace penumbra::shadow {

namespace {

Param word(const char* name, std::vector<std::string> choices, const char* help,
           ParamBinding binding = ParamBinding::host) {
  std::string first = choices.front();
  return {
      .name = name, .default_value = std::move(first), .help = help, .binding = binding, .choices = std::move(choices)};
}

Param with_default(Param row, const char* value) {
  row.default_value = std::string(value);
  return row;
}

void append(std::vector<Param>& rows, std::vector<Param> more) {
  rows.insert(rows.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<Param> light_rows() {
  using enum ParamBinding;
  return {
      word("driver", {"fragment", "compute"}, "Shader stage that evaluates the technique."),
      {"sun.angle", 0.53f, 0, 20, "deg", "Full angle that the sun spans as seen from the ground.", host},
      word("sun.shape", {"disc", "square"}, "Outline of the sun: a disc, or a square with two horizontal sides."),
  };
}

std::vector<Param> map_rows() {
  using enum ParamBinding;
  return {
      {"cascades.count", 4, 1, max_cascades, "",
       "Cascades of the sun's shadow map; the most, where they are fitted to what is visible.", host},
      {"cascades.size", 2048, 16, max_cascade_size, "texels",
       "Side of each cascade's map; larger where fewer are fitted to what is visible.", host},
      word("cascades.fit", {"stable", "visible", "penumbrae"},
           "What the shadow maps cover: all that the camera could see, so that shadows stay still while it moves "
           "(stable), or only what each frame shows, in more detail; all their texels are then divided among as many "
           "maps as make them finest (visible); or all but one of these maps only where penumbrae may be, as small "
           "maps that are drawn first show (penumbrae). The last two make the CPU wait for the GPU in each frame."),
      {"cascades.split", 0.75f, 0, 1, "", "Spacing of the cascades: 0 uniform, 1 logarithmic.", host},
      {"cascades.distance", 0.0f, 0, 1e7, "m", "Range of the last cascade; 0: as far as the view sees the scene.",
       host},
      with_default(word("cascades.seam", {"none", "fade", "dither"}, "Transition between cascades.", uniform), "fade"),
      {"maps.keep", true, 0, 1, "",
       "Keeps shadow maps, and what is made from them, where nothing has moved since the last frame; off: draws all "
       "anew.",
       host},
      {"maps.jitter", false, 0, 1, "",
       "Moves the sun's maps by a part of a texel in each frame in which the view rests, so that a history averages "
       "what one map can't resolve, unless blended surfaces read them; and with sampling.seed. Such frames draw their "
       "maps.",
       host},
      {"lamps.size", 1024, 16, 8192, "texels", "Side of each map of a lamp: a spot has one, other lamps have six.",
       host},
      {"lamps.near", 0.02f, 1e-4, 100, "m",
       "Casters that are nearer to a lamp's centre cast no shadow of it: they are the lamp itself. A lamp that lights "
       "receivers farther away than 2000 times this takes 1/2000 of their distance.",
       host},
      {"cascades.blend", 0.1f, 0.001, 0.5, "", "Width of the transition, as a fraction of the cascade's half width."},
      {"bias.constant", 0.02f, 0, 10, "texels",
       "How much nearer to the light than a receiver a texel has to be to block it."},
      {"bias.slope", 0.02f, 0, 10, "texels",
       "Added to bias.constant for each unit of the receiver's slope against the light."},
      {"bias.normal_offset", 0.0f, 0, 10, "texels", "Shift of receivers along their normal."},
      {"mask.tiles", true, 0, 1, "",
       "Computes only the tiles of 8 × 8 pixels that a penumbra can reach, and decides all others at once; always if "
       "mask.scale is above 1.",
       host},
      {"mask.scale", 1, 1, 4, "px",
       "Computes only every n-th pixel of each row and column, and those between that show another surface, a sharp "
       "edge or a narrow shadow; the others are interpolated.",
       host},
  };
}

std::vector<Param> sampling_rows() {
  const std::vector<std::string> sequences{"still", "shift", "set"};
  return {
      word("sampling.blocker_pattern", pattern_names(), "Pattern of the points that the blocker search reads."),
      word("sampling.filter_pattern", pattern_names(), "Pattern of the points that the filter compares."),
      word("sampling.scramble", scramble_names(),
           "What differs from pixel to pixel: a rotation of the points (disc suns) or a shift on the torus."),
      with_default(
          word(
              "sampling.noise",
              {"none", "white", "blue", "void_and_cluster", "interleaved_gradient", "spatiotemporal", "heitz_belcour"},
              "Tile of 64 × 64 pixels that sets each pixel's rotation or shift (none: all pixels use the same points), "
              "or, heitz_belcour, which of Sobol's points it uses."),
          "blue"),
      word("sampling.blocker_sequence", sequences,
           "The blocker search's points from frame to frame: the same (still), shifted, or the next of 16 sets."),
      word("sampling.filter_sequence", sequences,
           "The filter's points from frame to frame: the same (still), shifted, or the next of 16 sets."),
      {"sampling.seed", 0, 0, 65535, "",
       "Shifts the noise, and with maps.jitter the maps: another number rotates or shifts all points differently.",
       ParamBinding::host},
  };
}

std::vector<std::string> names_of(std::span<const Filter> filters, Filter::Of of) {
  std::vector<std::string> names{"none"};
  for (const Filter& filter : filters) {
    if (filter.of == of) names.push_back(filter.name);
  }
  return names;
}

}  // namespace

std::vector<Param> filter_params(std::span<const Filter> filters) {
  return {
      word("filter.penumbra", names_of(filters, Filter::Of::penumbra),
           "Filter of the blocker distances, from which the penumbrae's widths are then computed."),
      word("filter.visibility", names_of(filters, Filter::Of::visibility), "Filter of the shadow mask."),
      {"filter.width", 0.1f, 0, 1, "",
       "Standard deviation of filter.visibility, as a fraction of the penumbra's width."},
      {"filter.max_sigma", 24.0f, 0, 24, "px", "Largest standard deviation of filter.visibility."},
      {"filter.taps", 6, 1, 48, "taps",
       "Most pixels that filter.visibility reads to each side along an axis; in wider kernels they are spaced out."},
      {"filter.edge", 0.25f, 0.01, 100, "px",
       "Distance from the receiver's plane, in widths of a pixel, at which a bilateral filter weights a neighbour by "
       "e^-1/2."},
  };
}

std::vector<Param> library_params() {
  std::vector<Param> rows = light_rows();
  append(rows, map_rows());
  append(rows, sampling_rows());
  return rows;
}

const Denoiser& no_denoiser() {
  static const Denoiser none{
      .name = "none",
      .summary = "The technique writes the mask itself: no filter and no history, whatever their parameters.",
      .source = {}};
  return none;
}

Param denoiser_param(std::span<const Denoiser> denoisers) {
  std::vector<std::string> choices;
  for (const Denoiser& denoiser : denoisers) choices.push_back(denoiser.name);
  choices.push_back(no_denoiser().name);
  return word("denoiser", std::move(choices),
              "What runs after the technique: filters, and a blend with earlier frames.");
}

std::vector<Param> movement_params() {
  return {
      with_default(
          word("movement.map", {"none", "average", "maximum"},
               "How a pyramid combines the shadow map's texels that show moved casters. Where a receiver's disc "
               "covers one, the history is refused. none: no pyramid."),
          "maximum"),
      word("movement.present", {"own_pass", "shadow_pass"},
           "Draws moved casters at their present position in a pass of their own, or as a second target of the shadow "
           "pass."),
  };
}

}  // namespace penumbra::shadow
