#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/commands.h"
#include "cli/usage.h"
#include "core/names.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

std::string range_of(const Param& param) {
  if (!param.choices.empty() || std::holds_alternative<bool>(param.default_value)) return type_name(param);
  return fmt::format("{}, {:g} to {:g}", type_name(param), param.min, param.max);
}

void print_param(const Param& param) {
  fmt::print("{}: {}\n\n", param.name, param.help);
  fmt::print("  type     {}\n", range_of(param));
  fmt::print("  default  {}\n", to_text(param.default_value));
  if (!param.unit.empty()) fmt::print("  unit     {}\n", param.unit);
  fmt::print("\n  penumbra render SCENE -o FILE --set {}={}\n", param.name, to_text(param.default_value));
}

void print_technique(const shadow::Technique& technique) {
  fmt::print("{}: {}\n", technique.name, technique.summary);
  if (!technique.source.empty()) fmt::print("\n  source  {}\n", technique.source);
  fmt::print("\n  penumbra render SCENE -o FILE --technique {}\n", technique.name);
  if (technique.params.empty()) return;
  fmt::print("\nIts parameters:\n");
  for (const Param& param : technique.params)
    fmt::print("  {} = {}  {}\n", param.name, to_text(param.default_value), param.help);
}

bool explain_command(const std::string& name) {
  for (const Command& command : commands()) {
    if (name != command.name || command.run == run_help) continue;
    command.run({"--help"});
    return true;
  }
  return false;
}

bool explain_technique(const std::string& name) {
  const shadow::Registry& registry = session::all_techniques();
  for (const shadow::Preset& preset : registry.presets()) {
    if (preset.name != name) continue;
    fmt::print("{}: {}\n\n  {} with {}\n", preset.name, preset.summary, preset.technique,
               fmt::join(preset.assignments, ", "));
    return true;
  }
  for (const shadow::Technique& technique : registry.techniques()) {
    if (technique.name != name) continue;
    print_technique(technique);
    return true;
  }
  return false;
}

bool explain_param(const std::string& name) {
  for (const Param& param : render::Renderer::params(session::all_techniques())) {
    if (param.name != name) continue;
    print_param(param);
    return true;
  }
  return false;
}

bool explain_filter(const std::string& name) {
  for (const shadow::Filter& filter : session::all_techniques().filters()) {
    if (filter.name != name) continue;
    const bool of_penumbra = filter.of == shadow::Filter::Of::penumbra;
    fmt::print("{}: {}\n\n  source  {}\n", filter.name, filter.summary, filter.source);
    fmt::print("\n  penumbra render SCENE -o FILE --set filter.{}={}\n", of_penumbra ? "penumbra" : "visibility",
               filter.name);
    return true;
  }
  return false;
}

bool explain_denoiser(const std::string& name) {
  for (const shadow::Denoiser& denoiser : session::all_techniques().denoisers()) {
    if (denoiser.name != name) continue;
    fmt::print("{}: {}\n\n  source  {}\n", denoiser.name, denoiser.summary, denoiser.source);
    fmt::print("\n  penumbra render SCENE -o FILE --set denoiser={}\n", denoiser.name);
    return true;
  }
  return false;
}

bool explain_product(const std::string& name) {
  for (const shadow::Recipe& recipe : session::all_techniques().recipes()) {
    if (recipe.name != name) continue;
    fmt::print("{}: {}\n\n  source  {}\n  made of {}\n", recipe.name, recipe.summary, recipe.source,
               fmt::join(recipe.needs, ", "));
    return true;
  }
  return false;
}

const char* to_text(render::Reduction reduction) {
  switch (reduction) {
    case render::Reduction::mean:
      return "the mean of the pixels that are drawn for each pixel of the picture";
    case render::Reduction::mean_of_valid:
      return "the mean of those that are not 0, of the pixels that are drawn for each pixel of the picture";
    case render::Reduction::nearest_center:
      return "the middle one of the pixels that are drawn for each pixel of the picture";
  }
  return "";
}

bool explain_aov(const std::string& name) {
  for (const render::Aov& aov : render::aovs()) {
    if (aov.name != name) continue;
    fmt::print("{}: {}\n\n  channels       {}\n  --supersample  {}\n", aov.name, aov.help,
               fmt::join(aov.channels, ", "), to_text(aov.reduction));
    fmt::print("\n  penumbra render SCENE -o FILE --aov {}\n", aov.name);
    return true;
  }
  return false;
}

std::vector<std::string> explained_names() {
  std::vector<std::string> names = session::all_techniques().names();
  for (const Command& command : commands()) names.emplace_back(command.name);
  const shadow::Registry& registry = session::all_techniques();
  for (const shadow::Filter& filter : registry.filters()) names.push_back(filter.name);
  for (const shadow::Denoiser& denoiser : registry.denoisers()) names.push_back(denoiser.name);
  for (const shadow::Recipe& recipe : registry.recipes()) names.push_back(recipe.name);
  for (const render::Aov& aov : render::aovs()) names.push_back(aov.name);
  for (const Param& param : render::Renderer::params(session::all_techniques())) names.push_back(param.name);
  return names;
}

}  // namespace

int run_help(const Arguments& arguments) {
  CLI::App app("Explain a parameter, technique, filter, denoiser, product, AOV or sub-command", "penumbra help");
  std::string name;
  app.add_option("NAME", name, "What to explain")->required()->type_name("");
  if (!cli::parse(app, arguments)) return 0;
  // Several things may have one name: truth is a technique and a command.
  bool found = false;
  for (const auto explain : {explain_technique, explain_filter, explain_denoiser, explain_product, explain_param,
                             explain_aov, explain_command})
    found = explain(name) || found;
  if (found) return 0;
  const ParamSet params(render::Renderer::params(session::all_techniques()));
  if (const Param* present = params.renamed_from(name))
    cli::fail_usage("parameter '{}' is now called '{}'", name, present->name);
  const std::vector<std::string> near = near_names(name, explained_names());
  if (near.empty()) cli::fail_usage("nothing is called '{}'; see penumbra list --help", name);
  cli::fail_usage("nothing is called '{}'; did you mean '{}'?", name, fmt::join(near, "' or '"));
}

}  // namespace penumbra::app
