#include "io/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/median.h"

namespace penumbra::io {

Json document(std::string_view kind, int version, const Json& body) {
  Json json{{"format", fmt::format("penumbra.{}/{}", kind, version)}};
  json.update(body);
  return json;
}

Json json_number(double value) {
  if (std::isnan(value)) return nullptr;
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

namespace {

// The shortest digits of the float: 0.53f becomes 0.53 and not the double 0.5299999713897705.
Json number(float value) { return std::stod(to_text(ParamValue(value))); }

// Rounds to microseconds, the useful precision of the timer.
double rounded(double milliseconds) { return std::round(milliseconds * 1000.0) / 1000.0; }

}  // namespace

std::vector<PassCost> pass_costs(std::span<const gl::Timers::Row> rows, std::size_t frames) {
  std::vector<PassCost> costs;
  for (const gl::Timers::Row& row : rows) {
    const auto first = row.milliseconds.size() - std::min(frames, row.milliseconds.size());
    std::vector<double> drawn(row.milliseconds.begin() + static_cast<std::ptrdiff_t>(first), row.milliseconds.end());
    std::erase(drawn, 0.0);  // frames without this pass
    if (drawn.empty()) continue;
    const auto [min, max] = std::minmax_element(drawn.begin(), drawn.end());
    costs.push_back({row.name, median_of(drawn), *min, *max, drawn.size()});
  }
  return costs;
}

Json to_json(const PassCost& cost) {
  return {{"name", cost.name},
          {"median_ms", rounded(cost.median)},
          {"min_ms", rounded(cost.min)},
          {"max_ms", rounded(cost.max)},
          {"frames", cost.frames}};
}

Json to_json(const gl::DeviceInfo& device) {
  Json limits = Json::object();
  for (const auto& limit : device.limits) limits[limit.name] = limit.value;
  return {{"vendor", device.vendor},     {"renderer", device.renderer},
          {"version", device.version},   {"glsl_version", device.glsl_version},
          {"software", device.software}, {"limits", limits}};
}

Json to_json(const ParamValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag;
  if (const int* whole = std::get_if<int>(&value)) return *whole;
  if (const float* quantity = std::get_if<float>(&value)) return number(*quantity);
  return std::get<std::string>(value);
}

Json to_json(const ParamSet& params) {
  Json values = Json::object();
  for (const Param& param : params.rows()) values[param.name] = to_json(params.value(param.name));
  return values;
}

Json changed_params(const ParamSet& params) {
  Json changed = Json::object();
  for (const Param& param : params.rows()) {
    if (!params.is_default(param.name)) changed[param.name] = to_json(params.value(param.name));
  }
  return changed;
}

Json to_json(const Param& param) {
  Json json = {{"name", param.name}, {"type", type_name(param)}, {"default", to_json(param.default_value)}};
  if (!param.choices.empty()) {
    json["type"] = "word";
    json["choices"] = param.choices;
  } else if (!std::holds_alternative<bool>(param.default_value)) {
    json["min"] = param.min;
    json["max"] = param.max;
  }
  json["unit"] = param.unit;
  json["help"] = param.help;
  return json;
}

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace penumbra::io
