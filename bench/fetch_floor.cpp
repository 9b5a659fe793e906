// How near PCSS is to the machine's floor: its mask pass, early exits off, against a shader that only fetches the same
// texels of the same maps. Frames of both alternate in one run.
//   fetch_floor [SCENE.glb] [PAIRS]

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/error.h"
#include "gl/context.h"
#include "image/read.h"
#include "render/renderer.h"
#include "scene/gltf.h"

namespace penumbra {
namespace {

constexpr const char* floor_text = R"(
#include "shadow/search.glsl"

layout(binding = 5) uniform sampler2DArray kernels;  // mask of a PCSS frame: G is the filter's radius

float reach(Receiver receiver, Light light) { return search_reach(receiver, light); }

vec4 fetch(Receiver receiver, vec2 offset, Light light) {
  vec4 map = shadow.cascades[light.cascade].map;
  return textureGather(shadow_depth, vec3((receiver.position.xy + offset - map.xy) * map.z + 0.5, float(light.cascade)));
}

Visibility visibility(Receiver receiver, Light light) {
  float search = narrow_search(receiver, light, light.cascade, light.reach).radius;
  float radius = texelFetch(kernels, ivec3(receiver.pixel, 0), 0).y;
  vec4 sum = vec4(0.0);
  Scramble scramble = scramble_of(receiver, blocker_step);
  for (int i = 0; i < fetch_floor_blocker_taps; ++i) {
    sum += fetch(receiver, search * blocker_point(i, scramble, light), light);
  }
  if (radius > 0.0) {
    scramble = scramble_of(receiver, filter_step);
    for (int i = 0; i < fetch_floor_filter_taps; ++i) {
      sum += fetch(receiver, radius * filter_point(i, scramble, light), light);
    }
  }
  return Visibility(dot(sum, vec4(1e-3)), radius, 0.0, false);
}
)";

shadow::Technique fetch_floor(const gl::Texture& kernels) {
  using enum ParamBinding;
  return {.name = "fetch_floor",
          .summary = "Only the fetches of PCSS.",
          .glsl = "bench/fetch_floor.glsl",
          .needs = shadow::needs_shadow_map | shadow::needs_depth_pyramid,
          .params = {{"fetch_floor.blocker_taps", 16, 1, 256, "taps", "As pcss.blocker_taps.", compiled},
                     {"fetch_floor.filter_taps", 16, 1, 256, "taps", "As pcss.filter_taps.", compiled}},
          .prepare = [&kernels](const shadow::TechniqueFrame& work) {
            work.frame().products.push_back({.unit = shadow::first_product_unit, .texture = &kernels});
          }};
}

gl::Texture copy_of(const gl::Texture& texture) {
  const gl::TextureDesc& desc = texture.desc();
  gl::Texture copy("copy", desc);
  gl::glCopyImageSubData(texture.id(), desc.target, 0, 0, 0, 0, copy.id(), desc.target, 0, 0, 0, 0, desc.width,
                         desc.height, desc.layers);
  return copy;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

int run(const std::filesystem::path& path, int pairs) {
  const auto context = gl::make_context("auto");
  const shadow::Registry& built_in = shadow::built_in_registry();
  std::vector<shadow::Technique> techniques(built_in.techniques().begin(), built_in.techniques().end());
  gl::Texture kernels;
  techniques.push_back(fetch_floor(kernels));
  gl::ShaderFiles files;
  files.put("bench/fetch_floor.glsl", floor_text);
  const auto timing = gl::device_info().software ? gl::Timers::Mode::finish : gl::Timers::Mode::query;
  gl::Device device(std::move(files), timing);
  render::Renderer renderer(device, shadow::Registry(std::move(techniques), {}));
  ParamSet params(render::Renderer::params(renderer.registry()));
  params.set("pcss.early_exit", false);

  scene::Scene scene = scene::read_gltf(path, image::image_decoder());
  const scene::Pose pose = scene::pose_at(scene, 0);
  const render::Setup setup = render::choose_setup(scene, pose);
  if (setup.ground) render::add_ground(scene, scene::bounds_of(scene, pose));
  scene::GpuScene gpu_scene(device, scene);
  const render::FrameInputs frame{.camera = setup.camera, .last_camera = setup.camera, .sun = setup.sun};

  const auto draw = [&](const char* technique) -> const render::Frame& {
    params.set("technique", std::string(technique));
    return renderer.draw(gpu_scene, frame, params);
  };
  kernels = copy_of(*draw("pcss").mask.texture);
  draw("fetch_floor");
  constexpr size_t warm_up = 2;
  for (int i = 0; i < pairs; ++i) {
    draw("pcss");
    draw("fetch_floor");
  }
  std::vector<double> pcss;
  std::vector<double> floor;
  for (const gl::Timers::Row& row : device.timers.rows()) {
    if (row.name != "shadow mask") continue;
    for (size_t i = warm_up; i + 1 < row.milliseconds.size(); i += 2) {
      pcss.push_back(row.milliseconds[i]);
      floor.push_back(row.milliseconds[i + 1]);
    }
  }
  fmt::print("{}, {}x{}, {} cascades of {}x{}, 16/16 taps, early exits off, {}\n", path.filename().string(),
             frame.width, frame.height, params.get_int("cascades.count"), params.get_int("cascades.size"),
             params.get_int("cascades.size"), gl::device_info().renderer);
  fmt::print("pcss {:.3f} ms, its fetches alone {:.3f} ms, ratio {:.2f} (medians of {})\n", median(pcss), median(floor),
             median(pcss) / median(floor), pcss.size());
  return 0;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  try {
    return penumbra::run(argc > 1 ? argv[1] : PENUMBRA_ROOT "/scenes/courtyard.glb", argc > 2 ? std::atoi(argv[2]) : 9);
  } catch (const penumbra::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
