#include "viewer/settings.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "cli/options.h"
#include "core/error.h"
#include "io/output_file.h"
#include "io/report.h"
#include "render/renderer.h"
#include "session/techniques.h"
#include "viewer/json_file.h"

namespace penumbra::viewer {

namespace {

namespace fs = std::filesystem;
using io::Json;

constexpr std::size_t longest_path = 4096;

fs::path folder_from(const char* variable) {
  const char* value = std::getenv(variable);
  const fs::path path = value == nullptr ? "" : value;
  return path.is_absolute() ? path : fs::path();
}

void take(const Json& file, const char* key, bool& value) {
  const Json* json = find(file, key);
  if (json == nullptr) return;
  if (!json->is_boolean()) fail("'{}' takes true or false, not {}", key, json->type_name());
  value = json->get<bool>();
}

void take(const Json& file, const char* key, float least, float most, float& value) {
  const Json* json = find(file, key);
  if (json == nullptr) return;
  const double number = json->is_number() ? json->get<double>() : NAN;
  if (!(number >= least && number <= most)) fail("'{}' takes a number from {:g} to {:g}", key, least, most);
  value = static_cast<float>(number);
}

int side_of(const Json& window, const char* key) {
  const Json* json = find(window, key);
  // Whole numbers from 0 are the parser's unsigned ones.
  const auto value = json != nullptr && json->is_number_unsigned() ? json->get<std::uint64_t>() : 0;
  if (value < 1 || value > cli::largest_side)
    fail("'window.{}' takes a whole number from 1 to {}", key, cli::largest_side);
  return static_cast<int>(value);
}

bool is_in_range(const cli::Size& size) {
  return std::min(size.width, size.height) >= 1 && std::max(size.width, size.height) <= cli::largest_side;
}

void take_window(const Json& file, Settings& settings) {
  const Json* json = find(file, "window");
  if (json == nullptr) return;
  if (!json->is_object()) fail("'window' takes width and height, not {}", json->type_name());
  settings.window = {side_of(*json, "width"), side_of(*json, "height")};
}

bool is_scene(const std::string& path) { return fs::path(path).is_absolute() && path.size() <= longest_path; }

void take_recent(const Json& file, Settings& settings) {
  const Json* json = find(file, "recent");
  if (json == nullptr) return;
  if (!json->is_array() || json->size() > most_recent) fail("'recent' takes a list of at most {} paths", most_recent);
  for (const Json& path : *json) {
    if (!path.is_string() || !is_scene(path.get<std::string>())) fail("'recent' takes absolute paths");
    settings.recent.push_back(path.get<std::string>());
  }
}

void take_tab(const Json& file, Settings& settings) {
  const Json* json = find(file, "tab");
  if (json == nullptr) return;
  if (!json->is_string() || json->get<std::string>().size() > longest_tab) fail("'tab' takes a short name");
  settings.tab = json->get<std::string>();
}

// The value as --set takes it. The JSON type has to fit: the string "16" is not accepted as a number.
std::string text_of(const Param& param, const Json& json) {
  const ParamValue& like = param.default_value;
  const bool is_flag = std::holds_alternative<bool>(like), is_word = std::holds_alternative<std::string>(like);
  if (json.is_boolean() != is_flag || json.is_string() != is_word || json.is_structured() || json.is_null())
    fail("parameter '{}' takes {}, not {}", param.name, type_name(param), json.type_name());
  return is_word ? json.get<std::string>() : json.dump();
}

void take_params(const Json& file, Settings& settings) {
  const Json* json = find(file, "params");
  if (json == nullptr) return;
  if (!json->is_object()) fail("'params' takes values by name, not {}", json->type_name());
  for (const auto& [name, value] : json->items()) {
    const bool known = settings.params.contains(name) || settings.params.renamed_from(name) != nullptr;
    if (!known) fail("unknown parameter '{}'", name);
    cli::assign(settings.params, name + "=" + text_of(settings.params.row(name), value));
  }
}

Settings defaults() {
  Settings settings;
  settings.params = ParamSet(render::Renderer::params(session::all_techniques()));
  session::all_techniques().select(settings.params, session::usual_technique);
  return settings;
}

Settings settings_of(const Json& file) {
  if (!file.is_object()) fail("not settings, but {}", file.type_name());
  Settings settings = defaults();
  take_recent(file, settings);
  take_window(file, settings);
  take(file, "panel", settings.panel);
  take(file, "vsync", settings.vsync);
  take(file, "panel_width", least_panel_width, most_panel_width, settings.panel_width);
  take(file, "panel_share", least_panel_share, most_panel_share, settings.panel_share);
  take(file, "scale", least_scale, most_scale, settings.scale);
  take_tab(file, settings);
  take_params(file, settings);
  return settings;
}

// JSON is UTF-8; paths are any bytes.
bool is_utf8(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace) ==
         Json(text).dump(-1, ' ', false, Json::error_handler_t::ignore);
}

Json recent_of(const Settings& settings) {
  Json recent = Json::array();
  for (const std::string& path : settings.recent) {
    if (recent.size() < most_recent && is_scene(path) && is_utf8(path)) recent.push_back(path);
  }
  return recent;
}

Json params_of(const Settings& settings) {
  Json params = Json::object();
  Settings again = defaults();
  for (const Param& row : settings.params.rows()) {
    const ParamValue& value = settings.params.value(row.name);
    if (value != again.params.value(row.name)) params[row.name] = io::to_json(value);
  }
  try {
    take_params({{"params", params}}, again);
  } catch (const Error&) {
    return Json::object();  // values of a preset file that the next start would refuse
  }
  return params;
}

Json to_json(const Settings& settings) {
  Json json = {{"recent", recent_of(settings)}};
  if (settings.window && is_in_range(*settings.window))
    json["window"] = {{"width", settings.window->width}, {"height", settings.window->height}};
  json["panel"] = settings.panel;
  json["vsync"] = settings.vsync;
  json["panel_width"] = std::clamp(settings.panel_width, least_panel_width, most_panel_width);
  json["panel_share"] = std::clamp(settings.panel_share, least_panel_share, most_panel_share);
  json["scale"] = std::clamp(settings.scale, least_scale, most_scale);
  if (settings.tab.size() <= longest_tab) json["tab"] = settings.tab;
  json["params"] = params_of(settings);
  return json;
}

// Makes the missing folders, readable by the user only, as the specification asks. A fault shows when the file is
// written.
void make_folders(const fs::path& folder) {
  std::error_code code;
  if (folder == folder.root_path() || fs::exists(folder, code)) return;
  make_folders(folder.parent_path());
  mkdir(folder.c_str(), S_IRWXU);
}

}  // namespace

fs::path settings_file() {
  if (const fs::path config = folder_from("XDG_CONFIG_HOME"); !config.empty()) return config / "penumbra/viewer.json";
  if (const fs::path home = folder_from("HOME"); !home.empty()) return home / ".config/penumbra/viewer.json";
  return {};
}

Settings read_settings(std::string& fault) {
  fault.clear();
  const fs::path file = settings_file();
  std::error_code code;
  const bool exists = fs::exists(file, code);
  if (!exists && !code) return defaults();
  try {
    if (code) fail("{}", code.message());
    return settings_of(read_json(file));
  } catch (const Error& error) {
    fault = ignored("settings", file, error.what());
  }
  return defaults();
}

void write_settings(const Settings& settings) {
  const fs::path file = settings_file();
  if (file.empty()) fail("no place for settings: neither XDG_CONFIG_HOME nor HOME is an absolute path");
  make_folders(file.parent_path());
  io::write_text(file, io::text_of(to_json(settings)));
}

void add_recent(std::vector<std::string>& recent, const std::string& scene) {
  std::error_code code;
  const fs::path absolute = fs::absolute(scene, code);
  if (code) return;
  const std::string path = absolute.lexically_normal().string();
  std::erase(recent, path);
  recent.insert(recent.begin(), path);
  if (recent.size() > most_recent) recent.resize(most_recent);
}

}  // namespace penumbra::viewer
