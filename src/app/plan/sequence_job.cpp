#include "app/plan/sequence_job.h"

#include <utility>

#include "cli/no_effect.h"
#include "image/probe.h"
#include "image/read.h"
#include "io/output_file.h"
#include "plan/json_reader.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;
using io::Json;

}  // namespace

SequenceJob::SequenceJob(ParamSet params, cli::OutputNames names, SequenceItems items,
                         std::vector<cli::GivenOption> given)
    : params_(std::move(params)), names_(std::move(names)), items_(std::move(items)), given_(std::move(given)) {}

std::string SequenceJob::name(std::size_t item) const {
  const cli::FrameRange frames = items_.frames(item);
  const std::string scene = fs::path(options().scene).filename().string();
  return options().frames ? fmt::format("{}, frames {} to {}", scene, frames.first, frames.last) : scene;
}

// Of the options, only what the values below do not tell. The scene's name is in the metadata of EXR files.
Json SequenceJob::depends(std::size_t item) const {
  const cli::FrameRange frames = items_.frames(item);
  return {
      {"options", plan::json_of(given_, {"--frames", "--technique", "--preset", "--set", "--sun-angle", "--exposure",
                                         "--spp", "--error", "--seed", "--frames-per-item", "--lead-in", "--warmup"})},
      {"name", options().output},
      {"params", io::to_json(params_)},
      {"sequence", options().frames.has_value()},
      {"frames", {frames.first, frames.last}},
      {"drawn_from", items_.drawn(item).first},
      {"warmup", warmup_of(item)}};
}

Json SequenceJob::what(std::size_t item) const {
  const cli::FrameRange frames = items_.frames(item);
  return {{"frames", {frames.first, frames.last}},
          {"techniques", {{{"name", session::technique_label(params_)}, {"params", io::changed_params(params_)}}}}};
}

plan::SceneFacts SequenceJob::facts(std::size_t /*scene*/) const {
  plan::ImageSizes images([](const scene::ReadAt& file) { return image::probe(file); });
  const session::PreparedScene prepared = session::load_scene(options(), images.decoder());
  cli::warn_without_lights(options(), options(), session::kinds_of_light(prepared));
  return plan::facts_of(prepared, options(), images);
}

plan::Estimate SequenceJob::estimate(std::size_t item, const plan::SceneFacts& facts) const {
  const FrameOptions& how = options();
  const cli::Size pixels{how.size.width * how.supersample, how.size.height * how.supersample};
  const plan::Drawn drawn{.params = &params_,
                          .frames = items_.drawn(item).count() + warmup_of(item),
                          .samples = samples(),
                          .own_shadows = how.own_shadows};
  const double kept_bytes = file_bytes(facts.lights) * items_.frames(item).count();
  return plan::estimate_of(facts, pixels, {&drawn, 1}, session::all_techniques(), kept_bytes);
}

void SequenceJob::warn() const {
  items_.warn();
  cli::warn_without_effect(options(), {&params_, 1}, session::all_techniques());
  cli::warn_of_rate(options());
}

plan::Result SequenceJob::work(std::size_t item) const {
  const FrameOptions& how = options();
  const session::PreparedScene prepared = session::load_scene(how, image::image_decoder(cli::limits_of(how.reading)));
  const truth::TruthTechnique truth(session::truth_options(how, how));
  session::RenderSession session(how, how, session::open_context(how, how), prepared, truth.registry(),
                                 /* timed= */ false);
  plan::Result result{
      .data = {{"device", session.device_info().renderer}, {"lights", render::shadowed_lights(prepared.setup).size()}},
      .files = {}};
  for (cli::EncodedFile& file : draw(session, truth, item))
    result.files.push_back({file.path.string(), std::move(file.bytes)});
  return result;
}

std::vector<fs::path> SequenceJob::files_of_item(std::size_t item, std::size_t lights) const {
  std::vector<fs::path> files;
  const cli::FrameRange frames = items_.frames(item);
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    for (fs::path& file : files_of(frame, lights)) files.push_back(std::move(file));
  }
  return files;
}

// A scene's lights are not known before it is read.
std::vector<fs::path> SequenceJob::outputs(const fs::path& folder) const {
  std::vector<fs::path> files;
  for (std::size_t item = 0; item < count(); ++item) {
    for (const fs::path& file : files_of_item(item, render::max_shadowed_lights)) files.push_back(folder / file);
  }
  return files;
}

std::vector<fs::path> SequenceJob::merge(const Read& read, const fs::path& folder) const {
  plan::DeviceCheck devices;
  // All before any is written, so that a damaged result leaves the pictures of the last merge as they are.
  for (std::size_t item = 0; item < count(); ++item) {
    const plan::Result result = read(item);
    check_files(item, result);
    devices.add(plan::text_in(result.data, "device"));
  }
  devices.warn();
  std::vector<fs::path> written;
  for (std::size_t item = 0; item < count(); ++item) {
    const plan::Result result = read(item);
    check_files(item, result);
    for (const plan::ResultFile& file : result.files) {
      written.push_back(folder / file.name);
      io::write_text(written.back(), {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()});
    }
  }
  return written;
}

// Names come from a file that anybody may have written: none may lead elsewhere.
void SequenceJob::check_files(std::size_t item, const plan::Result& result) const {
  const std::size_t lights = plan::whole_in(result.data, "lights", render::max_shadowed_lights);
  const std::vector<fs::path> expected = files_of_item(item, lights);
  for (std::size_t i = 0; i < std::max(result.files.size(), expected.size()); ++i) {
    if (i == result.files.size()) fail("the result of item {} lacks the picture {}", item, io::quoted(expected[i]));
    if (i == expected.size() || expected[i] != result.files[i].name)
      fail("the result of item {} has the picture '{}', which it should not have", item, result.files[i].name);
  }
}

}  // namespace penumbra::app
