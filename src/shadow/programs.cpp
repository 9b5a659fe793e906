#include "programs.h"

#include <fmt/format.h>

#include <array>

#include "copies.h"
#include "depth_normals.h"
#include "filters.h"
#include "left_out.h"
#include "light_work.h"
#include "mask_scale.h"
#include "movement_map.h"
#include "outputs.h"
#include "tiles.h"
#include "visible_receivers.h"
#include "warm_up.h"

namespace penumbra::shadow {

namespace {

// Parameter sets that together produce every variant of the programs of a technique, recipe or denoiser with these
// parameters.
std::vector<ParamSet> compiled_variants(const std::vector<Param>& own, const ParamSet& defaults) {
  std::vector<ParamSet> variants{defaults};
  for (const Param& param : own) {
    if (param.binding != ParamBinding::compiled) continue;
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

std::vector<Programs::MaskForm> mask_forms(const Programs::Compiled& compiled, bool decides_tiles, bool second_layer) {
  std::vector<Programs::MaskForm> forms;
  forms.push_back({.compiled = compiled, .compute = true, .listed_pixels = true});
  for (Programs::MaskForm form{.compiled = compiled}; const bool compute : {false, true}) {
    form.compute = compute;
    for (const bool scaled : {false, true}) {
      if (scaled && !decides_tiles) continue;
      form.scaled = scaled;
      for (const bool tiles : {false, true}) {
        form.tiles = tiles;
        for (const bool packed : {false, true}) {
          form.packed = packed;
          form.history = false;
          forms.push_back(form);
          form.history = true;
          if (packed) forms.push_back(form);
        }
      }
    }
  }
  if (!compiled.lamp && !second_layer) return forms;
  const std::vector<Programs::MaskForm> others = forms;
  for (Programs::MaskForm form : others) {
    form.reads_all = true;
    forms.push_back(form);
  }
  return forms;
}

std::string unit_defines(const std::vector<std::string>& needs) {
  std::string text;
  unsigned unit = first_product_unit;
  for (const std::string& need : needs) {
    if (!is_base_map(need)) text += fmt::format("#define UNIT_{} {}\n", need, unit++);
  }
  return text;
}

// All that the generated files of a registry depend on: registries for which this text is equal share the files.
std::string declarations(const Registry& registry, const ParamSet& params) {
  std::string text;
  for (const Technique& technique : registry.techniques()) {
    text += fmt::format("// {}: {}: {}\n", technique.name, technique.glsl, fmt::join(technique.needs, ", "));
    for (const SampleSet& set : technique.samples) {
      text += fmt::format("//   {}: step {}, up to {} points\n", set.name, static_cast<int>(set.step),
                          params.row(set.count_parameter).max);
    }
  }
  for (const Denoiser& denoiser : registry.denoisers()) {
    text += fmt::format("// {}: {}\n", denoiser.name, fmt::join(denoiser.needs, ", "));
  }
  for (const Recipe& recipe : registry.recipes()) {
    text += fmt::format("// {}: {}\n", recipe.name, fmt::join(recipe.needs, ", "));
  }
  return text + glsl_declarations(params, block_params);
}

std::vector<gl::Define> compiled_defines(const std::vector<Param>& own, const ParamSet& params) {
  std::vector<gl::Define> defines;
  for (GlslConstant& constant : compiled_constants(params, own)) {
    defines.push_back({std::move(constant.name), std::move(constant.value)});
  }
  return defines;
}

// The parameters of a technique, recipe or denoiser, and those of the recipes that it needs.
std::vector<Param> params_of(const std::vector<Param>& own, const std::vector<std::string>& needs,
                             const Registry& registry) {
  std::vector<Param> rows = own;
  for (const std::string& need : needs) {
    if (is_base_map(need)) continue;
    const std::vector<Param>& more = registry.find_recipe(need).params;
    rows.insert(rows.end(), more.begin(), more.end());
  }
  return rows;
}

}  // namespace

Programs::Programs(gl::Device& device, const Registry& registry) : device_(device), registry_(registry) {
  gl::ShaderFiles& files = device_.shaders.files();
  const ParamSet params(registry.params());
  const std::string text = declarations(registry, params);
  for (int number = 0;; ++number) {
    folder_ = fmt::format("generated/registry{}", number);
    const std::string file = folder_ + "/params.glsl";
    const std::optional<std::string> present = files.read(file);
    if (present && *present != text) continue;
    files.put(file, text);
    break;
  }
  for (const Technique& technique : registry_.techniques()) {
    put_preamble(owner_of(technique), params);
    if (technique.glsl.empty()) continue;
    // Drivers are the same for all techniques: a generated file includes the technique's GLSL in front of the driver.
    for (const char* driver : {"mask.frag", "mask.comp", "forward.glsl"}) {
      files.put(driver_file(technique, driver),
                fmt::format("#include \"{}/preamble.glsl\"\n#include \"{}\"\n#include \"shadow/drivers/{}\"\n",
                            folder_of(owner_of(technique)), technique.glsl, driver));
    }
  }
  for (const Recipe& recipe : registry_.recipes()) put_preamble(owner_of(recipe), params);
  for (const Denoiser& denoiser : registry_.denoisers()) put_preamble(owner_of(denoiser), params);
}

bool Programs::draws_tiles() const {
  if (!draws_tiles_) {
    GLint storage_blocks = 0;
    std::array<GLfloat, 2> point_sizes{};
    gl::glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &storage_blocks);
    gl::glGetFloatv(GL_POINT_SIZE_RANGE, point_sizes.data());
    draws_tiles_ = storage_blocks > 0 && point_sizes[1] >= Tiles::size;
  }
  return *draws_tiles_;
}

std::string Programs::folder_of(const PassOwner& owner) const {
  switch (owner.kind) {
    case PassOwner::Kind::recipe:
      return fmt::format("{}/products/{}", folder_, owner.name);
    case PassOwner::Kind::denoiser:
      return fmt::format("{}/denoisers/{}", folder_, owner.name);
    case PassOwner::Kind::technique:
      break;
  }
  return fmt::format("{}/techniques/{}", folder_, owner.name);
}

void Programs::put_preamble(const PassOwner& owner, const ParamSet& params) {
  std::string text = fmt::format("#include \"{}/params.glsl\"\n", folder_) + unit_defines(owner.needs);
  if (owner.technique != nullptr) {
    text += fmt::format("#define CHOOSES_LAYER {}\n", owner.needs.empty() ? 0 : 1);
    text += sample_declarations(*owner.technique, params);
  }
  device_.shaders.files().put(folder_of(owner) + "/preamble.glsl", std::move(text));
}

std::string Programs::driver_file(const Technique& technique, std::string_view driver) const {
  return fmt::format("{}/{}", folder_of(owner_of(technique)), driver);
}

std::string Programs::including(const std::string& folder, const std::vector<std::string>& files) const {
  std::string name = folder;
  for (size_t i = 1; i < files.size(); ++i) name += "/" + files[i];
  if (!put_.insert(name).second) return name;
  std::string text;
  for (const std::string& file : files) text += fmt::format("#include \"{}\"\n", file);
  device_.shaders.files().put(name, std::move(text));
  return name;
}

Programs::Compiled Programs::compiled_for(const Technique& technique, const ParamSet& params, const LightShape& shape) {
  return {.scramble = scramble_of(technique, params, shape), .lamp = shape.lamp};
}

std::vector<Programs::Compiled> Programs::all_compiled(const Technique& technique) {
  std::vector<Compiled> all;
  for (const Scramble scramble : scrambles_of(technique)) {
    all.push_back({.scramble = scramble});
    if (!technique.suns_only) all.push_back({.scramble = scramble, .lamp = true});
  }
  return all;
}

std::vector<gl::Define> Programs::defines(const Technique& technique, const ParamSet& params,
                                          const Compiled& compiled) const {
  std::vector<gl::Define> defines = compiled_defines(params_of(technique.params, technique.needs, registry_), params);
  defines.insert(defines.begin(), {{"SAMPLE_SCRAMBLE", fmt::format("{}", static_cast<int>(compiled.scramble))},
                                   {"LAMP", compiled.lamp ? "1" : "0"}});
  return defines;
}

gl::ProgramDesc Programs::mask(const Technique& technique, const ParamSet& params, const MaskForm& form) const {
  gl::ProgramDesc program{.name = technique.name, .defines = defines(technique, params, form.compiled)};
  program.defines.push_back({"PACKED", form.packed ? "1" : "0"});
  program.defines.push_back({"HISTORY", form.history ? "1" : "0"});
  program.defines.push_back({"TILES", form.tiles ? "1" : "0"});
  program.defines.push_back({"SCALED", form.scaled ? "1" : "0"});
  program.defines.push_back({"READS_ALL", form.reads_all ? "1" : "0"});
  program.defines.push_back({"LISTED_APART", form.reads_all && !form.listed_pixels ? "1" : "0"});
  if (form.compute) {
    program.compute = driver_file(technique, "mask.comp");
    program.defines.push_back({"LISTED_PIXELS", form.listed_pixels ? "1" : "0"});
  } else {
    program.vertex = form.tiles ? "shadow/drivers/tile.vert" : "shared/full_screen.vert";
    program.fragment = driver_file(technique, "mask.frag");
    if (form.tiles) program.defines.push_back({"DECIDED", "0"});
  }
  return program;
}

gl::ProgramDesc Programs::decide_tiles(const Technique& technique, const DecideForm& form) const {
  const std::string folder = folder_of(owner_of(technique));
  return {
      .name = "decide tiles",
      .compute = including(folder, {folder + "/preamble.glsl", "shadow/drivers/decide_tiles.comp"}),
      // SCRAMBLE_NONE: its uniform block of sample points may be larger than the tables that are bound.
      .defines = {
          {"SAMPLE_SCRAMBLE", "3"}, {"LAMP", form.lamp ? "1" : "0"}, {"maps_layers", form.second_layer ? "2" : "1"}}};
}

gl::ProgramDesc Programs::decided(const MaskForm& form) const {
  return ready({.desc = {.name = "decided tiles",
                         .vertex = "shadow/drivers/tile.vert",
                         .fragment = "shadow/drivers/decided.frag",
                         .defines = {{"DECIDED", "1"},
                                     {"PACKED", form.packed ? "1" : "0"},
                                     {"HISTORY", form.history ? "1" : "0"},
                                     {"SCALED", form.scaled ? "1" : "0"},
                                     {"DETAILS", form.details || form.history ? "1" : "0"}}}});
}

gl::ProgramDesc Programs::filter_tiles(bool keeps_narrow) const {
  return ready({.desc = {.name = "filter tiles",
                         .compute = "shadow/drivers/filter_tiles.comp",
                         .defines = {{"KEEPS_NARROW", keeps_narrow ? "1" : "0"}}}});
}

gl::ProgramDesc Programs::upsample(UpsampledTiles tiles, bool details) const {
  return ready({.desc = {.name = "upsample mask",
                         .compute = "shadow/drivers/upsample.comp",
                         .defines = {{"TILES", tiles == UpsampledTiles::all ? "0" : "1"},
                                     {"LISTED_APART", tiles == UpsampledTiles::listed_apart ? "1" : "0"},
                                     {"DETAILS", details ? "1" : "0"}}}});
}

gl::ProgramDesc Programs::filter_noisy(bool stores) const {
  return ready({.desc = {.name = "filter missing pixels",
                         .compute = "shadow/drivers/filter_noisy.comp",
                         .defines = {{"FILTER_PASS", "0"}, {"STORES", stores ? "1" : "0"}}}});
}

gl::ProgramDesc Programs::pack(bool history) const {
  return ready({.desc = {.name = "pack mask",
                         .vertex = "shared/full_screen.vert",
                         .fragment = "shadow/drivers/pack.frag",
                         .defines = {{"HISTORY", history ? "1" : "0"}}}});
}

gl::ProgramDesc Programs::ready(const LibraryProgram& program) const {
  gl::ProgramDesc desc = program.desc;
  for (std::string* file : {&desc.fragment, &desc.compute}) {
    if (file->empty()) continue;
    std::vector<std::string> files{folder_ + "/params.glsl"};
    if (!program.before.empty()) files.push_back(program.before);
    files.push_back(*file);
    *file = including(folder_, files);
  }
  return desc;
}

std::string Programs::forward_file(const Technique& technique) const { return driver_file(technique, "forward.glsl"); }

std::string Programs::own_name(const PassOwner& owner, std::string_view program) {
  return fmt::format("{}: {}", owner.name, program);
}

std::vector<gl::ProgramDesc> Programs::own(const PassOwner& owner, const ParamSet& params,
                                           const Compiled& compiled) const {
  if (!owner.programs) return {};
  std::vector<gl::ProgramDesc> programs = owner.programs(params);
  const std::vector<gl::Define> constants =
      owner.technique != nullptr ? defines(*owner.technique, params, compiled)
                                 : compiled_defines(params_of(owner.params, owner.needs, registry_), params);
  const std::string folder = folder_of(owner);
  for (gl::ProgramDesc& program : programs) {
    program.name = own_name(owner, program.name);
    for (std::string* file : {&program.vertex, &program.geometry, &program.fragment, &program.compute}) {
      if (!file->empty()) *file = including(folder, {folder + "/preamble.glsl", *file});
    }
    program.defines.insert(program.defines.begin(), constants.begin(), constants.end());
  }
  return programs;
}

std::vector<std::vector<gl::Define>> Programs::all_defines(const Technique& technique, const ParamSet& defaults) const {
  std::vector<std::vector<gl::Define>> all;
  for (const ParamSet& params : compiled_variants(params_of(technique.params, technique.needs, registry_), defaults)) {
    for (const Compiled& compiled : all_compiled(technique)) all.push_back(defines(technique, params, compiled));
  }
  return all;
}

void Programs::add_own(std::vector<gl::ProgramDesc>& programs, const PassOwner& owner, const ParamSet& defaults) const {
  for (const ParamSet& params : compiled_variants(params_of(owner.params, owner.needs, registry_), defaults)) {
    for (const Compiled& compiled :
         owner.technique != nullptr ? all_compiled(*owner.technique) : std::vector{Compiled{}}) {
      for (gl::ProgramDesc& program : own(owner, params, compiled)) programs.push_back(std::move(program));
    }
  }
}

std::vector<gl::ProgramDesc> Programs::all(const ParamSet& defaults) const {
  std::vector<gl::ProgramDesc> programs{pack(true),
                                        pack(false),
                                        filter_tiles(false),
                                        filter_tiles(true),
                                        filter_noisy(false),
                                        filter_noisy(true),
                                        output_program(),
                                        mark_frame_program(),
                                        scaled_receivers_program(),
                                        scaled_tiles_program(),
                                        ready(depth_normals_program(false)),
                                        ready(depth_normals_program(true)),
                                        warm_up_caster_program()};
  for (gl::ProgramDesc& program : copy_programs()) programs.push_back(std::move(program));
  for (gl::ProgramDesc& program : visible_receivers_programs()) programs.push_back(std::move(program));
  for (const MaskForm& form : {MaskForm{},
                               {.details = true},
                               {.packed = true},
                               {.packed = true, .details = true},
                               {.packed = true, .history = true}}) {
    for (const bool scaled : {false, true}) {
      MaskForm decided_form = form;
      decided_form.scaled = scaled;
      programs.push_back(decided(decided_form));
    }
  }
  for (const UpsampledTiles tiles : {UpsampledTiles::all, UpsampledTiles::listed, UpsampledTiles::listed_apart}) {
    for (const bool details : {false, true}) programs.push_back(upsample(tiles, details));
  }
  for (const MovementForm form : {MovementForm::average, MovementForm::maximum}) {
    for (const bool any_size : {false, true}) programs.push_back(movement_pyramid_program(form, any_size));
  }
  for (const LibraryProgram& program : filter_programs(registry_.filters())) programs.push_back(ready(program));
  for (const Recipe& recipe : registry_.recipes()) add_own(programs, owner_of(recipe), defaults);
  for (const Denoiser& denoiser : registry_.denoisers()) add_own(programs, owner_of(denoiser), defaults);
  for (const Technique& technique : registry_.techniques()) {
    for (const ParamSet& params :
         compiled_variants(params_of(technique.params, technique.needs, registry_), defaults)) {
      for (const Compiled& compiled : all_compiled(technique)) {
        for (const MaskForm& form :
             mask_forms(compiled, technique.decides_tiles, reads_second_layer(technique, params))) {
          const bool runs = form.listed_pixels ? !technique.resolve : !form.tiles || technique.decides_tiles;
          if (technique.glsl.empty() || !runs) continue;
          programs.push_back(mask(technique, params, form));
        }
      }
    }
    add_own(programs, owner_of(technique), defaults);
    if (!technique.decides_tiles) continue;
    for (const bool second_layer : {false, true}) {
      if (second_layer && !needs_second_layer(technique)) continue;
      programs.push_back(decide_tiles(technique, {.second_layer = second_layer}));
      if (!technique.suns_only)
        programs.push_back(decide_tiles(technique, {.lamp = true, .second_layer = second_layer}));
    }
  }
  return programs;
}

}  // namespace penumbra::shadow
