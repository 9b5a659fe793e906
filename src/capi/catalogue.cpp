// The lists of parameters and of techniques.
#include <vector>

#include "../core/params.h"
#include "../shadow/registry.h"
#include "call.h"
#include "settings.h"
#include "structs.h"

namespace penumbra::capi {

namespace {

struct Row {
  const Param& param;
  std::string default_value;
  std::vector<const char*> choices;
};

int32_t type_of(const ParamValue& value) {
  if (std::holds_alternative<bool>(value)) return PENUMBRA_TYPE_SWITCH;
  if (std::holds_alternative<int>(value)) return PENUMBRA_TYPE_INTEGER;
  return std::holds_alternative<float>(value) ? PENUMBRA_TYPE_REAL : PENUMBRA_TYPE_WORD;
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    std::vector<Row> made;
    for (const Param& param : default_params().rows()) {
      Row row{.param = param, .default_value = to_text(param.default_value), .choices = {}};
      for (const std::string& choice : param.choices) row.choices.push_back(choice.c_str());
      made.push_back(std::move(row));
    }
    return made;
  }();
  return all;
}

penumbra_param describe(const Row& row) {
  penumbra_param param{};
  param.name = row.param.name.c_str();
  param.help = row.param.help.c_str();
  param.unit = row.param.unit.c_str();
  param.default_value = row.default_value.c_str();
  param.type = type_of(row.param.default_value);
  param.choice_count = static_cast<uint32_t>(row.choices.size());
  param.choices = row.choices.empty() ? nullptr : row.choices.data();
  if (param.type == PENUMBRA_TYPE_INTEGER || param.type == PENUMBRA_TYPE_REAL) {
    param.least = row.param.min;
    param.greatest = row.param.max;
  }
  return param;
}

penumbra_technique describe_technique(size_t index) {
  const shadow::Registry& registry = shadow::built_in_registry();
  penumbra_technique technique{};
  const size_t own = registry.techniques().size();
  const shadow::Technique* runs = nullptr;
  if (index < own) {
    runs = &registry.techniques()[index];
    technique.name = runs->name.c_str();
    technique.summary = runs->summary.c_str();
  } else {
    const shadow::Preset& preset = registry.presets()[index - own];
    runs = &registry.find(preset.technique);
    technique.name = preset.name.c_str();
    technique.summary = preset.summary.c_str();
    technique.is_preset = 1;
  }
  technique.suns_only = runs->suns_only ? 1 : 0;
  return technique;
}

void check_index(size_t index, size_t count) {
  if (index >= count) fail_with(PENUMBRA_ERROR_ARGUMENT, "'index' is {} and there are {}", index, count);
}

}  // namespace

}  // namespace penumbra::capi

using namespace penumbra::capi;

size_t penumbra_param_count(void) {
  size_t count = 0;
  run("penumbra_param_count", [&] { count = rows().size(); });
  return count;
}

penumbra_result penumbra_param_info(size_t index, penumbra_param* param) {
  return run("penumbra_param_info", [&] {
    required(param, "param");
    check_index(index, rows().size());
    write_struct(param, describe(rows()[index]));
  });
}

size_t penumbra_technique_count(void) {
  size_t count = 0;
  run("penumbra_technique_count", [&] {
    const penumbra::shadow::Registry& registry = penumbra::shadow::built_in_registry();
    count = registry.techniques().size() + registry.presets().size();
  });
  return count;
}

penumbra_result penumbra_technique_info(size_t index, penumbra_technique* technique) {
  return run("penumbra_technique_info", [&] {
    required(technique, "technique");
    check_index(index, penumbra_technique_count());
    write_struct(technique, describe_technique(index));
  });
}
