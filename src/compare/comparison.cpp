#include "compare/comparison.h"

#include <fmt/format.h>

#include <functional>

#include "cli/progress.h"
#include "compare/drawing.h"
#include "compare/page.h"
#include "compare/scene_names.h"

namespace penumbra::compare {

std::string not_finite_text(const ComparedTechnique& technique) {
  return fmt::format("'{}' gives values that are not finite: {}; each counts as an error of 1", technique.label,
                     technique.figures.not_finite);
}

Comparison compare(const CompareOptions& options, const ComparedValues& values) {
  Drawing drawing(options, values, 0);
  drawing.check_scenes();  // before minutes of drawing
  Comparison comparison{.drawn_by = drawing.drawn_by(),
                        .reference_params = values.reference,
                        .names = scene_names(options.scenes, &std::filesystem::path::stem)};
  const std::size_t drawings = options.scenes.size() * (values.contenders.size() + 1);
  const int frames = options.frames ? options.frames->count() : 1;
  cli::Progress progress("picture", static_cast<int>(drawings) * frames, !options.quiet);
  const std::function<void()> drawn = [&progress] { progress.step(); };
  for (std::size_t i = 0; i < options.scenes.size(); ++i)
    add_scene(comparison, options, drawing.draw({.scene = i, .count = values.contenders.size()}, drawn));
  return comparison;
}

}  // namespace penumbra::compare
