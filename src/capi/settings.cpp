#include "settings.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>

#include "../core/error.h"
#include "../core/names.h"
#include "../core/preset.h"
#include "../shadow/registry.h"
#include "../shadow/selection.h"
#include "call.h"

namespace penumbra::capi {

namespace {

// The value of a parameter's own type that a number stands for.
ParamValue value_of(const Param& param, double number) {
  if (!std::isfinite(number)) {
    fail_with(PENUMBRA_ERROR_ARGUMENT, "the value for the parameter '{}' is not finite", param.name);
  }
  if (std::holds_alternative<float>(param.default_value)) return static_cast<float>(number);
  const bool is_switch = std::holds_alternative<bool>(param.default_value);
  if (!is_switch && !std::holds_alternative<int>(param.default_value)) {
    fail("parameter '{}' takes {}, not a number", param.name, type_name(param));
  }
  if (is_switch && number != 0 && number != 1) fail("parameter '{}' is a switch: 0 or 1, not {}", param.name, number);
  if (is_switch) return number != 0;
  if (number != std::trunc(number)) fail("parameter '{}' takes a whole number, not {}", param.name, number);
  constexpr double most = 1e9;  // no parameter's range goes beyond, and an int holds it
  return static_cast<int>(number > most ? most : number < -most ? -most : number);
}

// The preset that a text has chosen by this name. A text that was written names the technique and lists what the preset
// sets.
std::string preset_of(const ParamSet& params, const std::string& chosen) {
  if (chosen != params.get_word("technique")) return chosen;
  static const shadow::PresetValues presets(shadow::built_in_registry(), default_params());
  return presets.selection_of(params).name;
}

void select_technique(ParamSet& params, std::string_view technique) {
  if (std::ranges::find(techniques_of_program, technique) != techniques_of_program.end())
    fail("technique '{}' needs the program's scene: the library does not have it", technique);
  shadow::built_in_registry().select(params, technique);
}

// The name of a parameter. The message about one that is like none has no list of all.
const char* checked(const ParamSet& params, const char* name) {
  required(name, "name");
  const bool known = params.contains(name) || params.renamed_from(name) != nullptr;
  if (!known && near_names(name, params.names()).empty())
    fail("unknown parameter '{}'; see penumbra_param_info()", name);
  return name;
}

// What presets of the program say of its own scene and pictures is nothing to the library.
bool is_of_program(std::string_view param) {
  return std::ranges::any_of(groups_of_program, [&](std::string_view group) {
    return param.starts_with(group) && param.substr(group.size()).starts_with('.');
  });
}

}  // namespace

const ParamSet& default_params() {
  static const ParamSet params(shadow::built_in_registry().params());
  return params;
}

}  // namespace penumbra::capi

using namespace penumbra::capi;

penumbra_result penumbra_settings_create(penumbra_settings** settings) {
  return run("penumbra_settings_create", [&] {
    required(settings, "settings") = nullptr;
    *settings = new penumbra_settings{default_params(), {}};
  });
}

penumbra_result penumbra_settings_clone(const penumbra_settings* settings, penumbra_settings** copy) {
  return run("penumbra_settings_clone", [&] {
    required(copy, "copy") = nullptr;
    *copy = new penumbra_settings(required(settings, "settings"));
  });
}

void penumbra_settings_destroy(penumbra_settings* settings) { delete settings; }

penumbra_result penumbra_settings_select(penumbra_settings* settings, const char* technique) {
  return run("penumbra_settings_select", [&] {
    penumbra::ParamSet changed = required(settings, "settings").params;
    penumbra::shadow::take_back(changed, penumbra::shadow::built_in_registry(), settings->preset);
    select_technique(changed, &required(technique, "technique"));
    settings->params = std::move(changed);
    settings->preset = technique;
  });
}

penumbra_result penumbra_settings_set(penumbra_settings* settings, const char* name, const char* value) {
  return run("penumbra_settings_set", [&] {
    penumbra::ParamSet& params = required(settings, "settings").params;
    checked(params, name);
    const std::string_view text = &required(value, "value");
    const std::span<const penumbra::shadow::Preset> presets = penumbra::shadow::built_in_registry().presets();
    if (std::string_view(name) == "technique" &&
        std::ranges::find(presets, text, &penumbra::shadow::Preset::name) != presets.end())
      penumbra::fail("'{}' is a preset, not a technique: penumbra_settings_select() chooses it", text);
    params.set_text(name, text);
  });
}

penumbra_result penumbra_settings_set_number(penumbra_settings* settings, const char* name, double value) {
  return run("penumbra_settings_set_number", [&] {
    penumbra::ParamSet& params = required(settings, "settings").params;
    const penumbra::Param& row = params.row(checked(params, name));
    params.set(name, value_of(row, value));
  });
}

penumbra_result penumbra_settings_reset(penumbra_settings* settings, const char* name) {
  return run("penumbra_settings_reset", [&] {
    penumbra::ParamSet& params = required(settings, "settings").params;
    if (name == nullptr) {
      params = default_params();
      settings->preset.clear();
    } else {
      params.reset(checked(params, name));
    }
  });
}

penumbra_result penumbra_settings_get(const penumbra_settings* settings, const char* name, char* text, size_t capacity,
                                      size_t* length) {
  return run("penumbra_settings_get", [&] {
    const penumbra::ParamSet& params = required(settings, "settings").params;
    write_text(penumbra::to_text(params.value(checked(params, name))), text, capacity, length);
  });
}

penumbra_result penumbra_settings_get_number(const penumbra_settings* settings, const char* name, double* value) {
  return run("penumbra_settings_get_number", [&] {
    const penumbra::ParamSet& params = required(settings, "settings").params;
    const penumbra::ParamValue& held = params.value(checked(params, name));
    double& out = required(value, "value");
    if (const auto* flag = std::get_if<bool>(&held)) {
      out = *flag ? 1 : 0;
    } else if (const auto* whole = std::get_if<int>(&held)) {
      out = *whole;
    } else if (const auto* real = std::get_if<float>(&held)) {
      out = static_cast<double>(*real);
    } else {
      penumbra::fail("parameter '{}' is a word, not a number", name);
    }
  });
}

penumbra_result penumbra_settings_read_preset(penumbra_settings* settings, const char* file, const char* text,
                                              size_t length) {
  return run("penumbra_settings_read_preset", [&] {
    penumbra::ParamSet& params = required(settings, "settings").params;
    const std::string name = &required(file, "file");
    if (text == nullptr && length > 0) fail_with(PENUMBRA_ERROR_ARGUMENT, "'text' is null and 'length' is not 0");
    if (length > penumbra::largest_preset) penumbra::fail("{}: a preset is at most 1 MiB", name);
    std::string chosen;
    penumbra::apply_preset(
        {text, length}, name, params,
        [&](penumbra::ParamSet& set, std::string_view technique) {
          select_technique(set, technique);
          chosen = technique;
        },
        is_of_program);
    if (!chosen.empty()) settings->preset = preset_of(params, chosen);
  });
}

penumbra_result penumbra_settings_write_preset(const penumbra_settings* settings, char* text, size_t capacity,
                                               size_t* length) {
  return run("penumbra_settings_write_preset",
             [&] { write_text(penumbra::preset_text(required(settings, "settings").params), text, capacity, length); });
}
