// penumbra-variants FOLDER [PART/PARTS]: writes the stages of every program variant that any choice of parameters can
// build, with includes resolved, as FOLDER/<program>.vert, .geom, .frag or .comp, and has the driver compile and run
// each. With PART/PARTS, such as 1/2, it takes only every second one or so: several processes share the work.
// Compilation runs in child processes: if the driver crashes, the program is reported as failed and the check continues
// with the next.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#ifdef PENUMBRA_VIEWER
#include "viewer/present.h"
#endif
#include "core/error.h"
#include "gl/context.h"
#include "gl/pass.h"
#include "gl/shader_source.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

// A program variant and its unique name.
struct Variant {
  std::string name;
  gl::ProgramDesc program;
};

struct Stage {
  const char* extension;
  const std::string& file;
};

std::array<Stage, 4> stages_of(const gl::ProgramDesc& program) {
  return {Stage{"vert", program.vertex}, Stage{"geom", program.geometry}, Stage{"frag", program.fragment},
          Stage{"comp", program.compute}};
}

// The variants whose number, divided by `count`, leaves `index`.
struct Part {
  std::size_t index = 0, count = 1;
};

// Of "1/2", the first of two parts: index 0. Nothing: not such a text.
std::optional<Part> read_part(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto number = [](std::string_view digits) {
    std::size_t value = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return fault == std::errc() && end == digits.data() + digits.size() ? value : 0;
  };
  const std::size_t part = number(text.substr(0, slash)), count = number(text.substr(slash + 1));
  return part >= 1 && part <= count ? std::optional(Part{part - 1, count}) : std::nullopt;
}

std::vector<Variant> variants_of(gl::Device& device, const Part& part) {
  render::Renderer renderer(device, session::all_techniques());
  const ParamSet defaults(render::Renderer::params(renderer.registry()));
  std::vector<gl::ProgramDesc> programs = renderer.all_programs(defaults);
#ifdef PENUMBRA_VIEWER
  for (const bool two : {false, true})
    for (const bool tinted : {false, true}) programs.push_back(viewer::present_program(two, tinted));
  programs.push_back(viewer::smooth_edges_program());
#endif
  std::sort(programs.begin(), programs.end());
  programs.erase(std::unique(programs.begin(), programs.end()), programs.end());
  std::vector<Variant> variants;
  std::map<std::string, int> numbers;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    std::string name = programs[i].name;
    std::replace(name.begin(), name.end(), ' ', '_');
    name += fmt::format("-{}", ++numbers[name]);
    if (i % part.count == part.index) variants.push_back({std::move(name), std::move(programs[i])});
  }
  return variants;
}

void write_stages(const gl::ShaderFiles& files, const Variant& variant, const std::filesystem::path& folder) {
  for (const Stage& stage : stages_of(variant.program)) {
    if (stage.file.empty()) continue;
    const std::filesystem::path path = folder / (variant.name + "." + stage.extension);
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) fail("can't write '{}'", path.string());
    const std::string text = gl::load_shader_source(files, stage.file, variant.program.defines).text;
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    if (std::fclose(file) != 0 || !written) fail("can't write '{}'", path.string());
  }
}

// Drivers generate machine code only when a program first draws, so draw or dispatch it with nothing bound.
void run(gl::Device& device, const gl::ProgramDesc& program) {
  if (!program.compute.empty()) {
    gl::Pass pass(device, {.name = "variant"});
    pass.use(program);
    pass.dispatch(1, 1);
    return;
  }
  std::vector<gl::Attachment> colors;
  for (const char* name : {"0", "1", "2", "3", "4", "5"}) {
    if (!program.fragment.empty()) colors.push_back({.texture = &device.target(name, {.format = GL_RGBA16F})});
  }
  const gl::Texture& depth = device.target("depth", {.format = GL_DEPTH_COMPONENT32F});
  gl::Pass pass(device, {.name = "variant",
                         .colors = colors,
                         .depth = gl::Attachment{.texture = &depth},
                         .depth_test = gl::DepthTest::less_equal,
                         .depth_write = true});
  pass.use(program);
  pass.draw_full_screen();
}

// Runs in a child process: compiles variants from `first` on, and writes the number of each to the file descriptor
// `progress` before it starts. Returns how many variants the driver refused.
int compile_from(gl::Device& device, const std::vector<Variant>& variants, std::size_t first, int progress) {
  const std::unique_ptr<gl::Context> context = gl::make_context("auto", {});
  int refused = 0;
  for (std::size_t i = first; i < variants.size(); ++i) {
    if (write(progress, &i, sizeof(i)) != sizeof(i)) return 1;
    try {
      run(device, variants[i].program);
      gl::glFinish();
    } catch (const Error& error) {
      fmt::print(stderr, "{}: {}\n", variants[i].name, error.what());
      ++refused;
    }
  }
  return refused;
}

struct Outcome {
  std::size_t next;  // the first variant that is still to be compiled
  bool good;
};

// The work of one child process: all variants from `first` on, or up to the one at which the driver crashes.
Outcome compile_in_child(gl::Device& device, const std::vector<Variant>& variants, std::size_t first) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) fail("no pipe for the compiling process");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) fail("can't start the compiling process");
  if (child == 0) {
    close(ends[0]);
    int refused = 1;
    try {
      refused = compile_from(device, variants, first, ends[1]);
    } catch (const std::exception& error) {
      fmt::print(stderr, "error: {}\n", error.what());
    }
    std::fflush(nullptr);
    std::_Exit(refused == 0 ? 0 : 1);
  }
  close(ends[1]);
  std::size_t last = first;
  for (std::size_t index = 0; read(ends[0], &index, sizeof(index)) == sizeof(index);) last = index;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status)) return {variants.size(), WEXITSTATUS(status) == 0};
  fmt::print(stderr, "{}: the driver crashed (signal {})\n", variants[last].name, WTERMSIG(status));
  return {last + 1, false};
}

int check_variants(const std::filesystem::path& folder, const Part& part) {
  std::filesystem::create_directories(folder);
  gl::Device device(gl::ShaderFiles(), gl::Timers::Mode::off);
  const std::vector<Variant> variants = variants_of(device, part);
  for (const Variant& variant : variants) write_stages(device.shaders.files(), variant, folder);
  bool good = true;
  for (std::size_t next = 0; next < variants.size();) {
    const Outcome outcome = compile_in_child(device, variants, next);
    good = good && outcome.good;
    next = outcome.next;
  }
  fmt::print("{} program variants\n", variants.size());
  return good ? 0 : 1;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  const std::string_view usage = "usage: penumbra-variants FOLDER [PART/PARTS]\n";
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  const std::string_view folder = arguments.empty() ? "" : arguments[0];
  if (folder == "--help" || folder == "-h") {
    fmt::print("{}", usage);
    return 0;
  }
  const std::optional<penumbra::Part> part = penumbra::read_part(arguments.size() < 2 ? "1/1" : arguments[1]);
  // A folder whose name begins with a dash is written ./-name.
  if (folder.empty() || folder.starts_with('-') || arguments.size() > 2 || !part) {
    fmt::print(stderr, "{}", usage);
    return 2;
  }
  try {
    return penumbra::check_variants(folder, *part);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
