#include "programs.h"

#include <fmt/format.h>

#include "denoise.h"
#include "movement_map.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

// Parameters that between them build every variant of a technique's programs.
std::vector<ParamSet> compiled_variants(const Technique& technique, const ParamSet& defaults) {
  std::vector<ParamSet> variants{defaults};
  for (const Param& param : defaults.rows()) {
    if (param.binding != ParamBinding::compiled || !param.name.starts_with(technique.name + ".")) continue;
    std::vector<ParamSet> grown;
    for (const ParamSet& variant : variants) {
      for (const ParamValue& value : representative_values(param)) {
        grown.push_back(variant);
        grown.back().set(param.name, value);
      }
    }
    variants = std::move(grown);
  }
  return variants;
}

std::vector<Programs::MaskForm> mask_forms(bool rotated) {
  std::vector<Programs::MaskForm> forms;
  for (const bool compute : {false, true}) {
    forms.push_back({rotated, compute, /*packed=*/false, /*history=*/false});
    forms.push_back({rotated, compute, /*packed=*/true, /*history=*/false});
    forms.push_back({rotated, compute, /*packed=*/true, /*history=*/true});
  }
  return forms;
}

// What the generated files of a registry are made from.
std::string declarations(const Registry& registry) {
  std::string text;
  for (const Technique& technique : registry.techniques()) text += fmt::format("// {}\n", technique.glsl);
  return text + glsl_declarations(ParamSet(registry.params()), block_params);
}

}  // namespace

Programs::Programs(gl::Device& device, const Registry& registry) : device_(device), registry_(registry) {
  gl::ShaderFiles& files = device_.shaders.files();
  const std::string text = declarations(registry);
  for (int number = 0;; ++number) {
    folder_ = fmt::format("generated/registry{}", number);
    const std::string file = folder_ + "/params.glsl";
    const std::optional<std::string> present = files.read(file);
    if (present && *present != text) continue;
    files.put(file, text);
    break;
  }
  // Drivers know no technique: a generated file puts a technique's function before each.
  for (const Technique& technique : registry_.techniques()) {
    if (technique.glsl.empty()) continue;
    for (const char* driver : {"mask.frag", "mask.comp", "forward.glsl"}) {
      files.put(driver_file(technique, driver),
                fmt::format("#include \"{}/params.glsl\"\n#include \"{}\"\n#include \"shadow/drivers/{}\"\n", folder_,
                            technique.glsl, driver));
    }
  }
}

std::string Programs::driver_file(const Technique& technique, std::string_view driver) const {
  return fmt::format("{}/{}/{}", folder_, technique.name, driver);
}

std::string Programs::with_params(const std::string& file, const std::string& before) const {
  if (file.empty()) return {};
  std::string name = fmt::format("{}/{}{}{}", folder_, before, before.empty() ? "" : "/", file);
  std::string text = fmt::format("#include \"{}/params.glsl\"\n", folder_);
  for (const std::string& included : {before, file}) {
    if (!included.empty()) text += fmt::format("#include \"{}\"\n", included);
  }
  device_.shaders.files().put(name, std::move(text));
  return name;
}

std::vector<gl::Define> Programs::defines(const Technique& technique, const ParamSet& params, bool rotated) {
  std::vector<gl::Define> defines{{"SAMPLE_ROTATE", rotated ? "1" : "0"}};
  for (GlslConstant& constant : compiled_constants(params, technique.name + ".")) {
    defines.push_back({std::move(constant.name), std::move(constant.value)});
  }
  return defines;
}

gl::ProgramDesc Programs::mask(const Technique& technique, const ParamSet& params, const MaskForm& form) const {
  gl::ProgramDesc program{.name = technique.name, .defines = defines(technique, params, form.rotated)};
  program.defines.push_back({"PACKED", form.packed ? "1" : "0"});
  program.defines.push_back({"HISTORY", form.history ? "1" : "0"});
  if (form.compute) {
    program.compute = driver_file(technique, "mask.comp");
  } else {
    program.vertex = "shared/full_screen.vert";
    program.fragment = driver_file(technique, "mask.frag");
  }
  return program;
}

gl::ProgramDesc Programs::ready(const LibraryProgram& program) const {
  gl::ProgramDesc desc = program.desc;
  desc.fragment = with_params(desc.fragment, program.before);
  desc.compute = with_params(desc.compute, program.before);
  return desc;
}

std::string Programs::forward_file(const Technique& technique) const { return driver_file(technique, "forward.glsl"); }

std::string Programs::own_name(const Technique& technique, std::string_view program) {
  return fmt::format("{}: {}", technique.name, program);
}

std::vector<gl::ProgramDesc> Programs::own(const Technique& technique, const ParamSet& params, bool rotated) const {
  if (!technique.programs) return {};
  std::vector<gl::ProgramDesc> programs = technique.programs(params);
  for (gl::ProgramDesc& program : programs) {
    program.name = own_name(technique, program.name);
    for (std::string* file : {&program.vertex, &program.geometry, &program.fragment, &program.compute})
      *file = with_params(*file);
    const std::vector<gl::Define> constants = defines(technique, params, rotated);
    program.defines.insert(program.defines.begin(), constants.begin(), constants.end());
  }
  return programs;
}

std::vector<std::vector<gl::Define>> Programs::all_defines(const Technique& technique, const ParamSet& defaults) const {
  std::vector<std::vector<gl::Define>> all;
  for (const ParamSet& params : compiled_variants(technique, defaults)) {
    for (const bool rotated : {true, false}) all.push_back(defines(technique, params, rotated));
  }
  return all;
}

std::vector<gl::ProgramDesc> Programs::all(const ParamSet& defaults) const {
  std::vector<gl::ProgramDesc> programs{depth_pyramid_program(true), depth_pyramid_program(false)};
  for (const MovementForm form : {MovementForm::average, MovementForm::maximum}) {
    for (const bool any_size : {false, true}) programs.push_back(movement_pyramid_program(form, any_size));
  }
  for (const LibraryProgram& program : denoise_programs(registry_)) programs.push_back(ready(program));
  for (const Technique& technique : registry_.techniques()) {
    for (const ParamSet& params : compiled_variants(technique, defaults)) {
      for (const bool rotated : {true, false}) {
        for (const MaskForm& form : mask_forms(rotated)) {
          if (!technique.glsl.empty()) programs.push_back(mask(technique, params, form));
        }
        for (gl::ProgramDesc& program : own(technique, params, rotated)) programs.push_back(std::move(program));
      }
    }
  }
  return programs;
}

}  // namespace penumbra::shadow
