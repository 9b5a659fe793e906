#include "cli/reading.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "cli/options.h"
#include "cli/progress.h"
#include "core/names.h"
#include "io/memory.h"
#include "io/output_file.h"
#include "scene/casting.h"
#include "scene/limits.h"
#include "scene/sky.h"

namespace penumbra::cli {

namespace {

void add_limit(ReadingOptions& options, const std::string& text) {
  try {
    scene::ReadLimits unused;
    scene::set_limit(unused, text);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  options.limits.push_back(text);
}

// Splits at the last '=': the name of a material may contain one, the words after it do not.
void add_caster(ReadingOptions& options, const std::string& text) {
  const auto equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) fail_usage("--casters: '{}' is not MATERIAL=HOW", text);
  const std::string word = one_of("word for --casters", text.substr(equals + 1), scene::casting_words());
  options.casters.emplace_back(text.substr(0, equals), *scene::casting_of(word));
}

// Shows progress only once reading has taken a second.
class ReadingProgress {
 public:
  void operator()(const scene::ReadProgress& at) {
    if (std::chrono::steady_clock::now() - start_ < std::chrono::seconds(1)) return;
    if (part_ != at.part) {
      part_ = at.part;
      progress_.reset();
      progress_ = std::make_unique<Progress>(std::string("reading: ") + at.part, static_cast<int>(at.count), true);
    }
    progress_->set_done(static_cast<int>(at.done));
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string part_;
  std::unique_ptr<Progress> progress_;
};

std::string word_of(scene::CastSetting casting) {
  const auto& words = scene::casting_words();
  return *std::ranges::find_if(words, [&](const std::string& word) { return scene::casting_of(word) == casting; });
}

// "; it has 'Bark', 'Leaves'", at most a dozen.
std::string known_names(std::vector<std::string> names) {
  std::erase(names, "");
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  if (names.empty()) return "; it names no material";
  constexpr std::size_t most = 12;
  std::string text = "; it has";
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += fmt::format("{} '{}'", i == 0 ? "" : ",", names[i]);
  if (names.size() > most) text += fmt::format(" and {} more", names.size() - most);
  return text;
}

}  // namespace

void add_reading_options(CLI::App& app, ReadingOptions& o) {
  const auto add_texts = [&app](const char* name, const char* type, const std::string& help, auto set) {
    app.add_option_function<std::vector<std::string>>(
           name,
           [set](const std::vector<std::string>& texts) {
             for (const std::string& text : texts) set(text);
           },
           help)
        ->type_name(type)
        ->allow_extra_args(false);
  };
  add_texts("--casters", "MATERIAL=HOW",
            "How surfaces of a material cast shadows: off, on, both (faces), front or back; repeatable",
            [&o](const std::string& text) { add_caster(o, text); });
  std::string names;
  for (const scene::LimitRow& row : scene::limit_rows()) names += (names.empty() ? "" : ", ") + std::string(row.name);
  add_texts("--limit", "NAME=VALUE", "Changes a limit for scene files: " + names + "; repeatable",
            [&o](const std::string& text) { add_limit(o, text); });
  app.add_flag("--follow-links", o.follow_links,
               "Files beside the scene may be symbolic links that lead out of its folder")
      ->disable_flag_override();
}

scene::ReadLimits limits_of(const ReadingOptions& options) {
  scene::ReadLimits limits;
  const std::size_t memory = io::available_memory();
  limits.image_bytes = memory / 5 * 2;
  limits.decoded_most = memory / 2;
  for (const std::string& text : options.limits) scene::set_limit(limits, text);
  return limits;
}

scene::Scene read_scene(const std::string& file, const ReadingOptions& options, const scene::ImageDecoder& decode) {
  scene::ReadOptions read{
      .limits = limits_of(options), .follow_links = options.follow_links, .names_files = options.names_files};
  ReadingProgress progress;
  if (options.progress) read.progress = std::ref(progress);
  scene::Scene scene = scene::read_gltf(file, decode, read);
  for (const auto& [material, casting] : options.casters) {
    if (scene::set_casting(scene, material, casting)) continue;
    std::vector<std::string> names;
    for (const scene::Material& candidate : scene.materials) names.push_back(candidate.name);
    const std::vector<std::string> near = near_names(material, names);
    fail("{}: no material is named '{}' (--casters){}", io::quoted(file), material,
         near.empty() ? known_names(std::move(names)) : fmt::format("; did you mean '{}'?", near.front()));
  }
  if (!options.skies_chosen) scene::warn_of_skies(file, scene);
  return scene;
}

std::vector<std::string> reading_arguments(const ReadingOptions& options) {
  std::vector<std::string> arguments;
  for (const std::string& limit : options.limits) arguments.push_back("--limit=" + limit);
  for (const auto& [material, casting] : options.casters)
    arguments.push_back("--casters=" + material + "=" + word_of(casting));
  if (options.follow_links) arguments.emplace_back("--follow-links");
  return arguments;
}

}  // namespace penumbra::cli
