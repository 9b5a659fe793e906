#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/light_layers.h"
#include "app/names.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "core/names.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  fmt::print("{}", cli::wrapped(fmt::format(format, std::forward<Args>(args)...)));
}

std::string range_of(const Param& param) {
  if (!param.choices.empty()) return fmt::format("{}", fmt::join(param.choices, ", "));
  if (std::holds_alternative<bool>(param.default_value)) return type_name(param);
  return fmt::format("{}, {:g} to {:g}", type_name(param), param.min, param.max);
}

void print_param(const Param& param) {
  say("{}: {}\n\n", param.name, param.help);
  say("  type     {}\n", range_of(param));
  say("  default  {}\n", to_text(param.default_value));
  if (!param.unit.empty()) say("  unit     {}\n", param.unit);
  say("\n  penumbra render SCENE -o FILE --set {}={}\n", param.name, to_text(param.default_value));
}

// A table of the parameters whose names begin with the group's name and a dot; returns whether there are any.
bool print_group(const std::string& group, const char* title) {
  std::vector<Param> params = render::Renderer::params(session::all_techniques());
  std::erase_if(params, [&](const Param& param) { return !param.name.starts_with(group + "."); });
  if (params.empty()) return false;
  say("{}\n", title);
  for (const Param& param : params) {
    const std::string unit = param.unit.empty() ? "" : " " + param.unit;
    say("\n  {} = {}{} ({})\n", param.name, to_text(param.default_value), unit, range_of(param));
    say("    {}\n", param.help);
  }
  return true;
}

void print_technique(const shadow::Technique& technique) {
  say("{}: {}\n", technique.name, technique.summary);
  if (!technique.source.empty()) say("\n  source  {}\n", technique.source);
  say("\n  penumbra render SCENE -o FILE --technique {}\n", technique.name);
  print_group(technique.name, "\nIts parameters, with their defaults:");
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
    say("{}: {}\n\n  {} with {}\n", preset.name, preset.summary, preset.technique, fmt::join(preset.assignments, ", "));
    return true;
  }
  for (const shadow::Technique& technique : registry.techniques()) {
    if (technique.name != name) continue;
    print_technique(technique);
    return true;
  }
  return false;
}

bool explain_group(const std::string& name) {
  for (const shadow::Technique& technique : session::all_techniques().techniques()) {
    if (technique.name == name) return false;  // listed with the technique
  }
  return print_group(name, fmt::format("The parameters {}.*, with their defaults:", name).c_str());
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
    say("{}: {}\n\n  source  {}\n", filter.name, filter.summary, filter.source);
    say("\n  penumbra render SCENE -o FILE --set filter.{}={}\n", of_penumbra ? "penumbra" : "visibility", filter.name);
    return true;
  }
  return false;
}

bool explain_denoiser(const std::string& name) {
  for (const shadow::Denoiser& denoiser : session::all_techniques().denoisers()) {
    if (denoiser.name != name) continue;
    say("{}: {}\n\n  source  {}\n", denoiser.name, denoiser.summary, denoiser.source);
    say("\n  penumbra render SCENE -o FILE --set denoiser={}\n", denoiser.name);
    return true;
  }
  return false;
}

bool explain_product(const std::string& name) {
  for (const shadow::Recipe& recipe : session::all_techniques().recipes()) {
    if (recipe.name != name) continue;
    say("{}: {}\n\n  source  {}\n  made of {}\n", recipe.name, recipe.summary, recipe.source,
        fmt::join(recipe.needs, ", "));
    return true;
  }
  return false;
}

// What a pixel of an AOV shows where there are `several` to choose from: all of them, or the one that is `chosen`.
std::string to_text(render::Reduction reduction, std::string_view several, std::string_view chosen) {
  switch (reduction) {
    case render::Reduction::mean:
      return fmt::format("the mean of {}", several);
    case render::Reduction::mean_of_valid:
      return fmt::format("the mean of {}, without those that are 0", several);
    case render::Reduction::nearest_center:
      break;
  }
  return std::string(chosen);
}

bool explain_aov(const std::string& name) {
  for (const render::Aov& aov : render::aovs()) {
    if (aov.name != name) continue;
    say("{}: {}\n\n  channels           {}\n  --supersample      {}\n  --aov-samples all  {}\n", aov.name, aov.help,
        fmt::join(aov.channels, ", "),
        to_text(aov.reduction, "the pixels that are drawn for each pixel of the picture",
                "the pixel in the middle of those that are drawn for each pixel of the picture"),
        to_text(aov.reduction, "all samples of the pixel", "the first sample of the pixel, in its middle"));
    if (aov.of_light)
      say("\n  Of several lights with shadows, the first one's picture has this name, the second one's is {}, and so "
          "on.\n",
          layer_name(aov.name, 1));
    say("\n  penumbra render SCENE -o FILE --aov {}\n", aov.name);
    return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> explained_names() {
  std::vector<std::string> names = session::all_techniques().names();
  for (const Command& command : commands()) names.emplace_back(command.name);
  const shadow::Registry& registry = session::all_techniques();
  for (const shadow::Filter& filter : registry.filters()) names.push_back(filter.name);
  for (const shadow::Denoiser& denoiser : registry.denoisers()) names.push_back(denoiser.name);
  for (const shadow::Recipe& recipe : registry.recipes()) names.push_back(recipe.name);
  for (const render::Aov& aov : render::aovs()) names.push_back(aov.name);
  for (const Param& param : render::Renderer::params(session::all_techniques())) {
    const std::string group = param.name.substr(0, param.name.find('.'));
    if (group != param.name && std::ranges::find(names, group) == names.end()) names.push_back(group);
    names.push_back(param.name);
  }
  return names;
}

int run_help(const Arguments& arguments) {
  CLI::App app("Explain a parameter or a group of them, a technique, filter, denoiser, product, AOV or command",
               "penumbra help");
  std::string name;
  app.add_option("NAME", name, "What to explain")->required()->type_name("");
  if (!cli::parse(app, arguments)) return 0;
  // Several things may have one name: truth is a technique and a command.
  bool found = false;
  for (const auto explain : {explain_technique, explain_filter, explain_denoiser, explain_product, explain_param,
                             explain_group, explain_aov, explain_command})
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
