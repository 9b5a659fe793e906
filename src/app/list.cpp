#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/names.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "core/names.h"
#include "io/report.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::app {

namespace {

using io::Json;

// What can be listed: one row a thing, each with at least a "name" and a "help".
struct Listing {
  const char* name;
  const char* help;
  Json (*rows)();
};

Json technique_rows() {
  Json rows = Json::array();
  const shadow::Registry& registry = session::all_techniques();
  for (const shadow::Technique& technique : registry.techniques()) {
    Json params = Json::array();
    for (const Param& param : technique.params) params.push_back(param.name);
    rows.push_back(
        {{"name", technique.name}, {"help", technique.summary}, {"source", technique.source}, {"params", params}});
  }
  for (const shadow::Preset& preset : registry.presets()) {
    rows.push_back({{"name", preset.name},
                    {"help", preset.summary},
                    {"technique", preset.technique},
                    {"sets", preset.assignments}});
  }
  return rows;
}

Json filter_rows() {
  Json rows = Json::array();
  for (const shadow::Filter& filter : session::all_techniques().filters())
    rows.push_back({{"name", filter.name},
                    {"help", filter.summary},
                    {"source", filter.source},
                    {"param", filter.of == shadow::Filter::Of::penumbra ? "filter.penumbra" : "filter.visibility"}});
  return rows;
}

Json denoiser_row(const shadow::Denoiser& denoiser) {
  Json params = Json::array();
  for (const Param& param : denoiser.params) params.push_back(param.name);
  return {{"name", denoiser.name}, {"help", denoiser.summary}, {"source", denoiser.source}, {"params", params}};
}

Json denoiser_rows() {
  Json rows = Json::array();
  for (const shadow::Denoiser& denoiser : session::all_techniques().denoisers()) rows.push_back(denoiser_row(denoiser));
  rows.push_back(denoiser_row(shadow::no_denoiser()));
  return rows;
}

Json product_rows() {
  Json rows = Json::array();
  for (const shadow::Recipe& recipe : session::all_techniques().recipes())
    rows.push_back({{"name", recipe.name}, {"help", recipe.summary}, {"source", recipe.source}});
  return rows;
}

Json param_rows() {
  Json rows = Json::array();
  for (const Param& param : render::Renderer::params(session::all_techniques())) rows.push_back(io::to_json(param));
  return rows;
}

Json aov_rows() {
  Json rows = Json::array();
  for (const render::Aov& aov : render::aovs())
    rows.push_back({{"name", aov.name}, {"help", aov.help}, {"channels", aov.channels}});
  return rows;
}

Json backend_rows() {
  return {
      {{"name", "auto"}, {"help", "The first that works of egl and osmesa."}},
      {{"name", "egl"}, {"help", "Without a display: Mesa's surfaceless platform, or a server's GPU (--egl-device)."}},
      {{"name", "osmesa"}, {"help", "Mesa's software rasteriser as a library, which needs no driver."}},
      {{"name", "window"}, {"help", "An invisible window on a display."}}};
}

constexpr std::array listings{
    Listing{"techniques", "Ways to draw shadows, for --technique.", technique_rows},
    Listing{"filters", "Filters of the shadow mask, for filter.penumbra and filter.visibility.", filter_rows},
    Listing{"denoisers", "What runs after a technique, for the parameter denoiser.", denoiser_rows},
    Listing{"products", "Textures made from a light's maps, for the techniques that need them.", product_rows},
    Listing{"params", "Parameters, for --set and presets.", param_rows},
    Listing{"aovs", "Pictures of a frame, for --aov.", aov_rows},
    Listing{"backends", "Ways to open an OpenGL context, for --backend.", backend_rows}};

Json listing_rows() {
  Json rows = Json::array();
  for (const Listing& listing : listings) rows.push_back({{"name", listing.name}, {"help", listing.help}});
  return rows;
}

const Listing& find_listing(const std::string& name) {
  for (const Listing& listing : listings)
    if (name == listing.name) return listing;
  cli::fail_unknown_usage("list", name, listing_names());
}

// "0.53 deg (0 to 20)", what a parameter's row shows between its name and its sentence.
std::string values_of(const Json& row) {
  if (!row.contains("default")) return "";
  const Json& value = row["default"];
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (const std::string unit = row["unit"].get<std::string>(); !unit.empty()) text += " " + unit;
  if (row.contains("choices")) {
    text += fmt::format(" ({})", fmt::join(row["choices"].get<std::vector<std::string>>(), ", "));
  } else if (row.contains("min")) {
    text += fmt::format(" ({:g} to {:g})", row["min"].get<double>(), row["max"].get<double>());
  }
  return text;
}

// A parameter's sentence is below its values.
void print_rows(const Json& rows) {
  std::size_t width = 0;
  for (const Json& row : rows) width = std::max(width, row["name"].get<std::string>().size());
  for (const Json& row : rows) {
    const std::string name = row["name"], help = row["help"], values = values_of(row);
    std::string text = fmt::format("{:<{}}  {}\n", name, width, values.empty() ? help : values);
    if (!values.empty()) text += fmt::format("{:<{}}  {}\n", "", width, help);
    fmt::print("{}", cli::wrapped(text));
  }
}

}  // namespace

std::vector<std::string> listing_names() {
  std::vector<std::string> names;
  for (const Listing& listing : listings) names.emplace_back(listing.name);
  return names;
}

int run_list(const Arguments& arguments) {
  CLI::App app("List techniques, filters, parameters and others by name", "penumbra list");
  std::string what;
  bool json = false;
  app.add_option("WHAT", what,
                 "techniques, filters, denoisers, products, params, aovs or backends; without it, these choices")
      ->type_name("");
  app.add_flag("--json", json, "Print JSON")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  const bool all = app.count("WHAT") == 0;
  const Json rows = all ? listing_rows() : find_listing(what).rows();
  if (json) {
    fmt::print("{}", io::text_of(io::document("list", 1, {{"list", all ? "lists" : what}, {"rows", rows}})));
  } else {
    print_rows(rows);
  }
  return 0;
}

}  // namespace penumbra::app
