#include "filters.h"

#include <fmt/format.h>

#include <array>

#include "../core/error.h"

namespace penumbra::shadow {

namespace {

// What "none" is where texels have to become a mask all the same.
const Filter& unfiltered() {
  static const Filter filter{.name = "unpack",
                             .summary = "Leaves visibility as it is.",
                             .source = {},
                             .glsl = "shadow/filters/none.glsl",
                             .reach = {{0, 0}}};
  return filter;
}

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

// The shape with the least to load for each pixel.
Group group_for(const glm::ivec2& reach) {
  constexpr std::array shapes{glm::ivec2(16, 16), glm::ivec2(64, 8), glm::ivec2(8, 64)};
  constexpr int bytes = sizeof(unsigned) + sizeof(float);
  const auto loads = [&](const glm::ivec2& shape) { return (shape.x + 2 * reach.x) * (shape.y + 2 * reach.y); };
  glm::ivec2 best = shapes[0];
  for (const glm::ivec2& shape : shapes) {
    if (loads(shape) * best.x * best.y < loads(best) * shape.x * shape.y) best = shape;
  }
  return {best, loads(best) * bytes};
}

// OpenGL 4.5 promises groups 32 KiB.
bool has_compute_form(const Filter& filter) {
  if (filter.reach.size() != static_cast<size_t>(filter.passes)) return false;
  for (const glm::ivec2& reach : filter.reach) {
    if (group_for(reach).tile_bytes > 32768) return false;
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
  define("SAMPLE_ROTATE", 1);  // light.glsl asks for one or the other
  if (step.compute) {
    const glm::ivec2 reach = step.filter.reach.at(static_cast<size_t>(step.pass));
    const Group group = group_for(reach);
    define("GROUP_X", group.size.x);
    define("GROUP_Y", group.size.y);
    define("REACH_X", reach.x);
    define("REACH_Y", reach.y);
    program.desc.compute = "shadow/drivers/filter.comp";
  } else {
    program.desc.vertex = "shared/full_screen.vert";
    program.desc.fragment = "shadow/drivers/filter.frag";
  }
  return program;
}

const Filter& filter_named(const Registry& registry, const std::string& name) {
  if (name == "none") return unfiltered();
  for (const Filter& filter : registry.filters()) {
    if (filter.name == name) return filter;
  }
  fail("there is no filter '{}'", name);
}

// A row of timings; all visibility filters share one, so that they can be compared.
std::string_view pass_name(const Filter& filter) {
  const bool filters = filter.of == Filter::Of::visibility && &filter != &unfiltered();
  return filters ? std::string_view("filter") : filter.name;
}

// One pass, from texels to `target`: texels, or a layer of the mask. Notes are for the latter alone.
void run(const LibraryFrame& work, const Step& step, const PackedMask& source, const gl::Texture& target) {
  const LightFrame& frame = work.frame();
  gl::PassDesc desc{.name = pass_name(step.filter)};
  if (!step.compute) desc.colors = {{.texture = &target, .layer = step.to_mask ? frame.layer : 0}};
  gl::Pass pass(work.device(), desc);
  const gl::Program& program = work.use_library(pass, program_of(step));
  for (const GLuint unit : {unit_texels, unit_notes}) work.device().sampler({}).bind(unit);
  source.texels.bind(unit_texels);
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

// All passes of a filter. `to_mask`: the last one fills the mask, which is returned; else texels.
const gl::Texture& run_all(const LibraryFrame& work, const Filter& filter, const PackedMask& source, bool to_mask) {
  const bool compute = work.uses_compute() && has_compute_form(filter);
  const gl::Texture* texels = &source.texels;
  for (int i = 0; i < filter.passes; ++i) {
    const Step step{filter, i, compute, to_mask && i + 1 == filter.passes};
    const gl::Texture& target =
        step.to_mask ? work.mask()
                     : work.target(fmt::format("denoise/{} {}", filter.name, i),
                                   {.format = GL_R32UI, .width = work.mask().width(), .height = work.mask().height()});
    run(work, step, {*texels, source.notes}, target);
    texels = &target;
  }
  return *texels;
}

}  // namespace

const gl::Texture& filter_penumbra(const LibraryFrame& work, const Registry& registry, const gl::Texture& source) {
  const std::string& name = work.params().get_word("filter.penumbra");
  if (name == "none") return source;
  // No pass of it reads notes.
  return run_all(work, filter_named(registry, name), {source, source}, /*to_mask=*/false);
}

void filter_visibility(const LibraryFrame& work, const Registry& registry, const PackedMask& packed) {
  run_all(work, filter_named(registry, work.params().get_word("filter.visibility")), packed, /*to_mask=*/true);
}

std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters) {
  std::vector<LibraryProgram> programs;
  const auto add = [&](const Filter& filter) {
    for (int i = 0; i < filter.passes; ++i) {
      const bool to_mask = filter.of == Filter::Of::visibility && i + 1 == filter.passes;
      programs.push_back(program_of({filter, i, /*compute=*/false, to_mask}));
      if (has_compute_form(filter)) programs.push_back(program_of({filter, i, /*compute=*/true, to_mask}));
    }
  };
  add(unfiltered());
  for (const Filter& filter : filters) add(filter);
  return programs;
}

}  // namespace penumbra::shadow
