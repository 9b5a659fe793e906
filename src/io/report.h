#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/params.h"
#include "gl/context.h"
#include "gl/timer.h"
#include "scene/scene_info.h"

namespace penumbra::io {

// JSON with its keys in the order of insertion, so that reports can be compared line by line.
using Json = nlohmann::ordered_json;

// JSON has no infinity: "inf" and "-inf", as text. NaN is null.
Json json_number(double value);

// What one pass cost over the frames that were counted, milliseconds.
struct PassCost {
  std::string name;
  double median = 0, min = 0, max = 0;
  std::size_t frames = 0;  // that drew it
};

// Costs over the last `frames` frames: those before are warm-up. Passes that none of them drew are left out.
std::vector<PassCost> pass_costs(std::span<const gl::Timers::Row> rows, std::size_t frames);

Json to_json(const PassCost& cost);
Json to_json(const gl::DeviceInfo& device);
Json to_json(const scene::SceneInfo& scene);
Json to_json(const ParamValue& value);
// Every parameter's value by name.
Json to_json(const ParamSet& params);
// A parameter's declaration.
Json to_json(const Param& param);

// Two spaces of indentation, a final newline; bytes that are no UTF-8 (names in a scene) are replaced.
std::string text_of(const Json& json);

}  // namespace penumbra::io
