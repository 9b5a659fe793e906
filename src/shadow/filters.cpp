#include "filters.h"

#include <fmt/format.h>

#include <array>

#include "denoise_context.h"
#include "tiles.h"

namespace penumbra::shadow {

namespace {

constexpr std::string_view unpack_name = "unpack";

// What a pass covers: the viewport, or the tiles that the filter can change.
enum class Over { all, changing };

// How a pass is computed. `shared`: work groups load what they read into shared memory, for all pixels.
enum class Form { fragment, compute, shared };

struct Step {
  const Filter& filter;
  int pass = 0;
  Form form = Form::fragment;
  bool to_mask = false;  // else to packed texels
  Over over = Over::all;
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
bool has_shared_form(const Filter& filter) {
  if (filter.border.size() != static_cast<size_t>(filter.passes)) return false;
  for (const glm::ivec2& border : filter.border) {
    if (group_for(border).tile_bytes > 32768) return false;
  }
  return true;
}

Form form_of(const LightWork& work, const Filter& filter) {
  if (work.params().get_word("driver") != "compute") return Form::fragment;
  return has_shared_form(filter) ? Form::shared : Form::compute;
}

LibraryProgram program_of(const Step& step) {
  LibraryProgram program{.desc = {.name = step.filter.name}, .before = step.filter.glsl};
  const auto define = [&](const char* name, int value) {
    program.desc.defines.push_back({name, std::to_string(value)});
  };
  define("FILTER_PASS", step.pass);
  define("TO_MASK", step.to_mask ? 1 : 0);
  const bool tiles = step.over != Over::all;
  if (step.form == Form::shared) {
    const glm::ivec2 border = step.filter.border.at(static_cast<size_t>(step.pass));
    const Group group = group_for(border);
    define("GROUP_X", group.size.x);
    define("GROUP_Y", group.size.y);
    define("BORDER_X", border.x);
    define("BORDER_Y", border.y);
    program.desc.compute = "shadow/drivers/filter_shared.comp";
  } else if (step.form == Form::compute) {
    define("TILES", tiles ? 1 : 0);
    program.desc.compute = "shadow/drivers/filter.comp";
  } else {
    define("TILES", tiles ? 1 : 0);
    if (tiles) define("DECIDED", 0);
    program.desc.vertex = tiles ? "shadow/drivers/tile.vert" : "shared/full_screen.vert";
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
struct PassInputs {
  const FilterInputs& source;
  const gl::Texture& texels;
  const gl::Texture& target;
};

const gl::Program& use(gl::Pass& pass, const LightWork& work, const Step& step, const PassInputs& inputs) {
  const gl::Program& program = pass.use(work.programs.ready(program_of(step)));
  bind_inputs(work, owner_of(*work.denoiser));
  for (const GLuint unit : {unit_texels, unit_notes}) work.device.sampler({}).bind(unit);
  inputs.texels.bind(unit_texels);
  inputs.source.notes.bind(unit_notes);
  program.set("mask_scale", work.frame.scale);
  return program;
}

void run_in_compute(gl::Pass& pass, const LightWork& work, const Step& step, const PassInputs& inputs) {
  const gl::Program& program = use(pass, work, step, inputs);
  if (step.to_mask) program.set("mask_layer", work.frame.layer);
  inputs.target.bind_image(0, GL_WRITE_ONLY);
  if (step.over == Over::all) {
    pass.dispatch(work.frame.viewport.width, work.frame.viewport.height);
  } else {
    inputs.source.tiles->bind_storage(tile_list_binding);
    pass.dispatch_indirect(*inputs.source.tiles, listed_dispatch_offset);
  }
}

void run_in_fragments(gl::Pass& pass, const LightWork& work, const Step& step, const PassInputs& inputs) {
  use(pass, work, step, inputs);
  if (step.over == Over::all) {
    pass.draw_full_screen();
  } else {
    draw_tiles(pass, *inputs.source.tiles, listed_draw_offset);
  }
}

gl::PassDesc pass_of(const LightWork& work, const Step& step, const PassInputs& inputs, bool draws) {
  gl::PassDesc desc{.name = pass_name(step.filter)};
  if (draws) desc.colors = {{.texture = &inputs.target, .layer = step.to_mask ? work.frame.layer : 0}};
  return desc;
}

void set_viewport(gl::Pass& pass, const LightWork& work) {
  const Rect& viewport = work.frame.viewport;
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
}

// Fills the tiles that the filter leaves as they are, with the texels or what they are in the mask. The others are
// filled as well, because a draw of tiles costs more.
void keep_tiles(const LightWork& work, const Step& step, const PassInputs& inputs) {
  gl::Pass pass(work.device, pass_of(work, step, inputs, /*draws=*/step.to_mask));
  // Compute shaders write the same texture as an image.
  const auto barrier = [&] {
    if (step.form != Form::fragment) pass.barrier();
  };
  if (step.to_mask) {
    set_viewport(pass, work);
    use(pass, work, {.filter = unfiltered(), .to_mask = true}, inputs);
    pass.draw_full_screen();
    return barrier();
  }
  const Rect& part = work.frame.viewport;
  gl::glCopyImageSubData(inputs.texels.id(), GL_TEXTURE_2D, 0, part.x, part.y, 0, inputs.target.id(), GL_TEXTURE_2D, 0,
                         part.x, part.y, 0, part.width, part.height, 1);
  barrier();
}

void run_pass(const LightWork& work, Step step, const PassInputs& inputs) {
  if (inputs.source.tiles != nullptr) {
    keep_tiles(work, step, inputs);
    step.over = Over::changing;
  }
  const bool fragments = step.form == Form::fragment;
  gl::Pass pass(work.device, pass_of(work, step, inputs, /*draws=*/fragments));
  if (!fragments) return run_in_compute(pass, work, step, inputs);
  set_viewport(pass, work);
  run_in_fragments(pass, work, step, inputs);
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

bool filters_all_pixels(const LightWork& work, const Filter& filter) {
  return form_of(work, filter) == Form::shared || filter.keeps == Filter::Keeps::nothing;
}

const gl::Texture& run_filter(const LightWork& work, const FilterInputs& inputs) {
  const Filter& filter = inputs.filter;
  const Form form = form_of(work, filter);
  const gl::TextureDesc packed{.format = packed_format, .width = work.mask.width(), .height = work.mask.height()};
  const gl::Texture* texels = &inputs.texels;
  for (int i = 0; i < filter.passes; ++i) {
    const bool to_mask = inputs.to_mask && i + 1 == filter.passes;
    const gl::Texture& target =
        to_mask ? work.mask
                : inputs.context.target(fmt::format("filter {} {} {}", inputs.number, filter.name, i), packed);
    run_pass(work, {.filter = filter, .pass = i, .form = form, .to_mask = to_mask}, {inputs, *texels, target});
    texels = &target;
  }
  return *texels;
}

std::vector<LibraryProgram> filter_programs(std::span<const Filter> filters) {
  std::vector<LibraryProgram> programs;
  const auto add = [&](Step step) {
    const bool tiles = step.filter.keeps != Filter::Keeps::nothing, shared = has_shared_form(step.filter);
    for (const Form form : {Form::fragment, shared ? Form::shared : Form::compute}) {
      step.form = form;
      step.over = Over::all;
      programs.push_back(program_of(step));
      step.over = Over::changing;
      if (tiles && form != Form::shared) programs.push_back(program_of(step));
    }
  };
  add({.filter = unfiltered(), .to_mask = true});
  for (const Filter& filter : filters) {
    for (int i = 0; i < filter.passes; ++i) add({.filter = filter, .pass = i, .to_mask = false});
    add({.filter = filter, .pass = filter.passes - 1, .to_mask = true});
  }
  return programs;
}

}  // namespace penumbra::shadow
