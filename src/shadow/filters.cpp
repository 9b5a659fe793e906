#include "filters.h"

#include <fmt/format.h>

#include <array>

namespace penumbra::shadow {

namespace {

constexpr std::string_view unpack_name = "unpack";

struct Step {
  const Filter& filter;
  int pass = 0;
  bool compute = false;
  bool to_mask = false;  // else to packed texels
};

// Shape of a group, by the tile of texels and depths that it shares.
struct Group {
  glm::ivec2 size;
  int tile_bytes = 0;
};

// The shape that loads the fewest texels for each filtered pixel.
Group group_for(const glm::ivec2& border) {
  constexpr std::array shapes{glm::ivec2(16, 16), glm::ivec2(64, 8), glm::ivec2(8, 64)};
  constexpr int bytes = sizeof(unsigned) + sizeof(float);
  const auto loads = [&](const glm::ivec2& shape) { return (shape.x + 2 * border.x) * (shape.y + 2 * border.y); };
  glm::ivec2 best = shapes[0];
  for (const glm::ivec2& shape : shapes) {
    if (loads(shape) * best.x * best.y < loads(best) * shape.x * shape.y) best = shape;
  }
  return {best, loads(best) * bytes};
}

// OpenGL 4.5 guarantees 32 KiB of shared memory for a work group.
bool has_compute_form(const Filter& filter) {
  if (filter.border.size() != static_cast<size_t>(filter.passes)) return false;
  for (const glm::ivec2& border : filter.border) {
    if (group_for(border).tile_bytes > 32768) return false;
  }
  return true;
}

LibraryProgram program_of(const Step& step) {
  LibraryProgram program{.desc = {.name = step.filter.name}, .before = step.filter.glsl};
  const auto define = [&](const char* name, int value) {
    program.desc.defines.push_back({name, std::to_string(value)});
  };
  define("FILTER_PASS", step.pass);
  define("TO_MASK", step.to_mask ? 1 : 0);
  if (step.compute) {
    const glm::ivec2 border = step.filter.border.at(static_cast<size_t>(step.pass));
    const Group group = group_for(border);
    define("GROUP_X", group.size.x);
    define("GROUP_Y", group.size.y);
    define("BORDER_X", border.x);
    define("BORDER_Y", border.y);
    program.desc.compute = "shadow/drivers/filter.comp";
  } else {
    program.desc.vertex = "shared/full_screen.vert";
    program.desc.fragment = "shadow/drivers/filter.frag";
  }
  return program;
}

// A row of timings; all visibility filters share one, so that they can be compared.
std::string_view pass_name(const Filter& filter) {
  const bool filters = filter.of == Filter::Of::visibility && filter.name != unpack_name;
  return filters ? std::string_view("filter") : filter.name;
}

// One pass, from texels to `target`: texels, or a layer of the mask. Notes are needed only for the mask.
void run_pass(const LightWork& work, const Step& step, const FilterInputs& source, const gl::Texture& texels,
              const gl::Texture& target) {
  const LightFrame& frame = work.frame;
  gl::PassDesc desc{.name = pass_name(step.filter)};
  if (!step.compute) desc.colors = {{.texture = &target, .layer = step.to_mask ? frame.layer : 0}};
  gl::Pass pass(work.device, desc);
  const gl::Program& program = pass.use(work.programs.ready(program_of(step)));
  bind_inputs(work, owner_of(*work.denoiser));
  for (const GLuint unit : {unit_texels, unit_notes}) work.device.sampler({}).bind(unit);
  texels.bind(unit_texels);
  source.notes.bind(unit_notes);
  if (step.compute) {
    if (step.to_mask) program.set("mask_layer", frame.layer);
    target.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch(frame.viewport.width, frame.viewport.height);
  } else {
    pass.set_viewport(frame.viewport.x, frame.viewport.y, frame.viewport.width, frame.viewport.height);
    pass.draw_full_screen();
  }
}

}  // namespace

const Filter& unfiltered() {
  static const Filter filter{.name = std::string(unpack_name),
                             .summary = "Leaves visibility as it is.",
                             .source = {},
                             .glsl = "shadow/filters/none.glsl",
                             .border = {{0, 0}}};
  return filter;
}

const gl::Texture& run_filter(const LightWork& work, const FilterInputs& inputs) {
  const Filter& filter = inputs.filter;
  const bool compute = work.params().get_word("driver") == "compute" && has_compute_form(filter);
  const gl::TextureDesc packed{.format = GL_R32UI, .width = work.mask.width(), .height = work.mask.height()};
  const gl::Texture* texels = &inputs.texels;
  for (int i = 0; i < filter.passes; ++i) {
    const bool to_mask = inputs.to_mask && i + 1 == filter.passes;
    const gl::Texture& target =
        to_mask ? work.mask
                : inputs.context.target(fmt::format("filter {} {} {}", inputs.number, filter.name, i), packed);
    run_pass(work, {.filter = filter, .pass = i, .compute = compute, .to_mask = to_mask}, inputs, *texels, target);
    texels = &target;
  }
  return *texels;
}

std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters) {
  std::vector<LibraryProgram> programs;
  const auto add = [&](const Step& step) {
    programs.push_back(program_of(step));
    Step compute = step;
    compute.compute = true;
    if (has_compute_form(step.filter)) programs.push_back(program_of(compute));
  };
  add({.filter = unfiltered(), .to_mask = true});
  for (const Filter& filter : filters) {
    for (int i = 0; i < filter.passes; ++i) add({.filter = filter, .pass = i, .to_mask = false});
    add({.filter = filter, .pass = filter.passes - 1, .to_mask = true});
  }
  return programs;
}

}  // namespace penumbra::shadow
