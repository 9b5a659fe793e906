#include "bench/part_result.h"

#include <climits>
#include <utility>

#include "core/error.h"
#include "plan/json_reader.h"

namespace penumbra::bench {

namespace {

using io::Json;
using plan::any_number_in;
using plan::array_in;
using plan::member_of;
using plan::text_in;
using plan::whole_in;

Json number(double value) { return io::json_number(value); }

Json json_of(const Summary& summary) {
  return {{"median", number(summary.median)},
          {"min", number(summary.min)},
          {"max", number(summary.max)},
          {"count", summary.count}};
}

Summary summary_in(const Json& json, const char* name) {
  const Json& summary = member_of(json, name);
  return {.median = any_number_in(summary, "median"),
          .min = any_number_in(summary, "min"),
          .max = any_number_in(summary, "max"),
          .count = whole_in(summary, "count", SIZE_MAX)};
}

// The summaries of a cost by name, for writing and for reading.
struct SummaryName {
  const char* name;
  Summary Cost::*value;
};
constexpr SummaryName summary_names[] = {{"frame", &Cost::frame},
                                         {"cpu", &Cost::cpu},
                                         {"passes_sum", &Cost::passes_sum},
                                         {"shadow", &Cost::shadow},
                                         {"swept", &Cost::swept}};

Json json_of(const FloorCost& floor) {
  return {{"fetch", floor.fetch ? json_of(*floor.fetch) : Json()},
          {"mask_ratio", floor.mask_ratio ? number(*floor.mask_ratio) : Json()},
          {"copy", json_of(floor.copy)}};
}

FloorCost floor_from(const Json& json) {
  FloorCost floor{.copy = summary_in(json, "copy")};
  if (!member_of(json, "fetch").is_null()) floor.fetch = summary_in(json, "fetch");
  if (!member_of(json, "mask_ratio").is_null()) floor.mask_ratio = any_number_in(json, "mask_ratio");
  return floor;
}

Json json_of(const Cost& cost) {
  Json passes = Json::array();
  for (const PassCost& pass : cost.passes)
    passes.push_back(
        {{"name", pass.name}, {"ms", json_of(pass.ms)}, {"share", number(pass.share)}, {"shadow", pass.shadow}});
  Json json{{"label", cost.label}, {"passes", passes}};
  for (const auto& [name, value] : summary_names) json[name] = json_of(cost.*value);
  json["sum_ratio"] = number(cost.sum_ratio);
  json["of_first"] = number(cost.of_first);
  json["shadow_bytes"] = cost.shadow_bytes;
  json["floor"] = cost.floor ? json_of(*cost.floor) : Json();
  return json;
}

Cost cost_from(const Json& json) {
  Cost cost{.label = text_in(json, "label")};
  for (const Json& pass : array_in(json, "passes")) {
    cost.passes.push_back({.name = text_in(pass, "name"),
                           .ms = summary_in(pass, "ms"),
                           .share = any_number_in(pass, "share"),
                           .shadow = member_of(pass, "shadow") == true});
  }
  for (const auto& [name, value] : summary_names) cost.*value = summary_in(json, name);
  cost.sum_ratio = any_number_in(json, "sum_ratio");
  cost.of_first = any_number_in(json, "of_first");
  cost.shadow_bytes = whole_in(json, "shadow_bytes", SIZE_MAX);
  if (const Json& floor = member_of(json, "floor"); !floor.is_null()) cost.floor = floor_from(floor);
  return cost;
}

Json json_of(const Point& point) {
  Json values = Json::object();
  for (const auto& [name, value] : point.values) values[name] = io::to_json(value);
  return {{"at", point.at}, {"names", point.names}, {"values", values}};
}

ParamValue value_from(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<int>();
  if (json.is_number_float()) return json.get<float>();
  return plan::text_of_value(json, "values");
}

Point point_from(const Json& json) {
  Point point;
  for (const Json& at : array_in(json, "at")) {
    if (!at.is_number()) fail("\"at\" has something that is no number");
    point.at.push_back(at.get<double>());
  }
  for (const Json& name : array_in(json, "names")) point.names.push_back(plan::text_of_value(name, "names"));
  for (const auto& [name, value] : member_of(json, "values").items())
    point.values.emplace_back(name, value_from(value));
  return point;
}

gl::DeviceInfo device_from(const Json& json) {
  gl::DeviceInfo device{.vendor = text_in(json, "vendor"),
                        .renderer = text_in(json, "renderer"),
                        .version = text_in(json, "version"),
                        .glsl_version = text_in(json, "glsl_version"),
                        .software = member_of(json, "software") == true,
                        .limits = {}};
  for (const auto& [name, value] : member_of(json, "limits").items())
    device.limits.push_back({name, value.is_number_integer() ? value.get<long long>() : 0});
  return device;
}

int int_in(const Json& json, const char* name) { return static_cast<int>(whole_in(json, name, INT_MAX)); }

}  // namespace

plan::Result result_of(const Results& measured) {
  const Measured& point = measured.points.front();
  Json costs = Json::array();
  for (const Cost& cost : point.costs) costs.push_back(json_of(cost));
  return {.data = {{"machine", {{"cpu", measured.machine.cpu}, {"cores", measured.machine.cores}}},
                   {"device", io::to_json(measured.device)},
                   {"backend", measured.backend},
                   {"timing", measured.timing},
                   {"scene", measured.scene},
                   {"sun", measured.sun},
                   {"frames", {{"measured", measured.frames.measured}, {"warmup", measured.frames.warmup}}},
                   {"point", json_of(point.point)},
                   {"width", point.size.width},
                   {"height", point.size.height},
                   {"triangles", point.triangles},
                   {"costs", costs}},
          .files = {}};
}

Results kept_point(const plan::Result& result) {
  const Json& data = result.data;
  const Json& machine = member_of(data, "machine");
  const Json& frames = member_of(data, "frames");
  Results kept;
  kept.machine = {.cpu = text_in(machine, "cpu"), .cores = int_in(machine, "cores")};
  kept.device = device_from(member_of(data, "device"));
  kept.backend = text_in(data, "backend");
  kept.timing = text_in(data, "timing");
  kept.scene = text_in(data, "scene");
  kept.sun = member_of(data, "sun") == true;
  kept.frames = {.measured = int_in(frames, "measured"), .warmup = int_in(frames, "warmup")};
  Measured point{.point = point_from(member_of(data, "point")),
                 .size = {int_in(data, "width"), int_in(data, "height")},
                 .triangles = static_cast<long long>(whole_in(data, "triangles", LLONG_MAX)),
                 .costs = {}};
  for (const Json& cost : array_in(data, "costs")) point.costs.push_back(cost_from(cost));
  kept.points.push_back(std::move(point));
  return kept;
}

}  // namespace penumbra::bench
