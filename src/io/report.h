#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/params.h"
#include "gl/context.h"
#include "gl/timer.h"
#include "scene/scene_info.h"

namespace penumbra::io {

// JSON that keeps its keys in the order of insertion, so that reports can be compared line by line.
using Json = nlohmann::ordered_json;

// A document that other programs read: {"format": "penumbra.KIND/VERSION", …}. docs/schemas/KIND.json describes it. The
// version changes whenever a reader of the last one could misread the new one.
Json document(std::string_view kind, int version, const Json& body);

// JSON has no infinity or NaN: infinities become the strings "inf" and "-inf", NaN becomes null.
Json json_number(double value);

// What one pass cost over the measured frames, milliseconds.
struct PassCost {
  std::string name;
  double median = 0, min = 0, max = 0;
  std::size_t frames = 0;  // measured frames in which the pass ran
};

// Costs over the last `frames` frames; earlier ones are warm-up. Passes that ran in none of them are left out.
std::vector<PassCost> pass_costs(std::span<const gl::Timers::Row> rows, std::size_t frames);

Json to_json(const PassCost& cost);
Json to_json(const gl::DeviceInfo& device);
Json to_json(const scene::SceneInfo& scene);
Json to_json(const ParamValue& value);
// Every parameter's value by name.
Json to_json(const ParamSet& params);
// The same of those that differ from their defaults.
Json changed_params(const ParamSet& params);
// A parameter's declaration.
Json to_json(const Param& param);

// JSON as text with two spaces of indentation and a final newline; invalid UTF-8 (in names of a scene) is replaced.
std::string text_of(const Json& json);

}  // namespace penumbra::io
