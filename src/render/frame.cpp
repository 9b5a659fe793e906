// The steps of a frame, in order.
#include "render/frame.h"

#include "render/aov_sums.h"

namespace penumbra::render {

namespace {

// Every pass that draws geometry or casts rays reads this block.
void bind_view(gl::Device& device, const glsl::ViewBlock& view) {
  const gl::Buffer& block = device.scratch("view", sizeof(glsl::ViewBlock));
  gl::write_value(block, view);
  block.bind_uniform(view_binding);
}

// What every sample of a frame is drawn and shaded with.
struct ShadingInputs {
  shadow::SoftShadows& soft_shadows;
  scene::GpuScene& scene;
  const FrameInputs& frame;
  const shadow::Mask& mask;
  const Sky& sky;
  const scene::Bounds& bounds;
  std::span<const shadow::Light> lights;
  const ParamSet& params;
};

// What is shaded: one sample of each pixel.
struct SampleSurfaces {
  const glsl::ViewBlock& view;
  const GBuffer& gbuffer;
  Sample sample = Sample::first;
  const FirstSample* first = nullptr;  // see LightingInputs
};

// The colours of one sample of each pixel.
const gl::Texture& shade(gl::Device& device, const ShadingInputs& in, const SampleSurfaces& seen) {
  const FrameInputs& frame = in.frame;
  const gl::Texture& lit = light_surfaces(device, {.gbuffer = seen.gbuffer,
                                                   .mask = in.mask,
                                                   .first = seen.first,
                                                   .sky = in.sky,
                                                   .bounds = in.bounds,
                                                   .ground_color = frame.ground_color,
                                                   .lights = frame.lights,
                                                   .on_ground = frame.on_ground,
                                                   .view = seen.view,
                                                   .emission_in_nits = in.scene.lit_by_file(),
                                                   .sample = seen.sample,
                                                   .params = in.params});
  draw_blended(device, {.soft_shadows = in.soft_shadows,
                        .scene = in.scene,
                        .camera = frame.camera,
                        .view = seen.view,
                        .gbuffer = seen.gbuffer,
                        .mask = in.mask,
                        .params = in.params,
                        .lit = lit,
                        .first = in.lights.front(),
                        .lamps = has_lamps(frame.lights),
                        .sample = seen.sample});
  return lit;
}

// Deletes a view's maps, masks and histories at the end of the scope.
class DroppedView {
 public:
  DroppedView(shadow::SoftShadows& soft_shadows, int id) : soft_shadows_(soft_shadows), id_(id) {}
  ~DroppedView() { soft_shadows_.forget_view(id_); }
  DroppedView(const DroppedView&) = delete;
  DroppedView& operator=(const DroppedView&) = delete;

 private:
  shadow::SoftShadows& soft_shadows_;
  int id_;
};

// The values with which a further sample computes shadows of its own.
ParamSet params_of_sample(const ParamSet& params, int index) {
  ParamSet own = params;
  own.set("history.reuse", false);
  for (const Param& row : params.rows()) {
    if (!row.name.ends_with(".seed")) continue;
    const auto seeds = static_cast<std::int64_t>(row.max) + 1;
    own.set(row.name, static_cast<int>((params.get_int(row.name) + index) % seeds));
  }
  return own;
}

// A further sample of each pixel.
struct FurtherSample {
  int index;         // from 1 on
  glm::vec2 offset;  // from the first, pixels
  const glsl::ViewBlock& view;
  const GBuffer& gbuffer;
};

struct ShadedSample {
  const gl::Texture* color;
  shadow::Mask mask;  // for AOVs, if they read it
};

ShadedSample shade_by_first(gl::Device& device, const ShadingInputs& shading, const FrameParts& first,
                            const FurtherSample& sample, bool read_mask) {
  const FirstSample of_first{.gbuffer = first.gbuffer,
                             .view = first.view,
                             .offset = sample.offset,
                             .pixel_size = pixel_size(shading.frame.camera, shading.frame.height)};
  const gl::Texture& color = shade(
      device, shading, {.view = sample.view, .gbuffer = sample.gbuffer, .sample = Sample::further, .first = &of_first});
  if (!read_mask) return {&color, shading.mask};
  return {&color,
          draw_sample_mask(device,
                           {.mask = shading.mask, .first = of_first, .gbuffer = sample.gbuffer, .view = sample.view})};
}

// The maps of the further sample before it are kept, unless they are fitted to what is visible or moved (maps.jitter).
ShadedSample shade_alone(gl::Device& device, const ShadingInputs& shading, const FurtherSample& sample,
                         bool read_mask) {
  const FrameInputs& frame = shading.frame;
  const ParamSet params = params_of_sample(shading.params, sample.index);
  const shadow::Mask mask =
      draw_shadow_mask(device, {.soft_shadows = shading.soft_shadows,
                                .scene = shading.scene,
                                .camera = frame.camera,
                                .last_camera = frame.camera,
                                .view = sample.view,
                                .jitter = -2.0f * sample.offset / glm::vec2(frame.width, frame.height),
                                .view_id = further_view(frame.view),
                                .time = frame.time,
                                .cut = sample.index == 1,
                                .mask_details = frame.mask_details && read_mask,
                                .moved = Moved::nothing,
                                .lights = shading.lights,
                                .frame_lights = frame.lights,
                                .on_ground = frame.on_ground,
                                .gbuffer = sample.gbuffer,
                                .params = params});
  const ShadingInputs own{.soft_shadows = shading.soft_shadows,
                          .scene = shading.scene,
                          .frame = frame,
                          .mask = mask,
                          .sky = shading.sky,
                          .bounds = shading.bounds,
                          .lights = shading.lights,
                          .params = params};
  return {&shade(device, own, {.view = sample.view, .gbuffer = sample.gbuffer, .sample = Sample::further}), mask};
}

// What AOVs show of a further sample.
FrameParts parts_of_sample(const FrameParts& first, const FurtherSample& sample, const shadow::Mask& mask) {
  FrameParts parts = first;
  parts.view = sample.view;
  parts.gbuffer = sample.gbuffer;
  parts.mask = mask;
  return parts;
}

// Draws the further samples of each pixel with the first one's exposure, and returns the mean of all. Where AOVs are
// averaged, too, their means are added to `parts`, the first sample's.
SampleMean average_samples(gl::Device& device, const ShadingInputs& shading, FrameParts& parts) {
  const FrameInputs& frame = shading.frame;
  const FrameParts& first = parts;
  const std::vector<glm::vec2> offsets = sample_offsets(frame.samples);
  const DroppedView further(shading.soft_shadows, further_view(frame.view));
  AovSums sums(frame.averaged_aovs, first.mask.lights.size());
  sums.add(first);
  SampleMean mean =
      add_sample(device, {.lit = *first.color, .exposure = *first.exposure, .index = 0, .count = frame.samples});
  for (int i = 1; i < frame.samples; ++i) {
    const glm::vec2 offset = offsets[static_cast<std::size_t>(i)];
    const glsl::ViewBlock view = view_block(frame.camera, frame.last_camera, frame.width, frame.height, offset);
    bind_view(device, view);
    const GBuffer gbuffer = draw_gbuffer(device, {.scene = shading.scene, .view = view, .sample = Sample::further});
    const FurtherSample sample{.index = i, .offset = offset, .view = view, .gbuffer = gbuffer};
    const ShadedSample shaded = frame.own_shadows ? shade_alone(device, shading, sample, sums.read_mask())
                                                  : shade_by_first(device, shading, first, sample, sums.read_mask());
    mean = add_sample(device, {.lit = *shaded.color, .exposure = *first.exposure, .index = i, .count = frame.samples});
    if (!sums.empty()) sums.add(parts_of_sample(first, sample, shaded.mask));
  }
  parts.means = sums.means();
  return mean;
}

}  // namespace

FrameParts draw_frame(gl::Device& device, shadow::SoftShadows& soft_shadows, scene::GpuScene& scene,
                      const FrameInputs& inputs, bool knows_moved, const ParamSet& params, const Sky& sky,
                      const gl::Texture& noise) {
  const Camera& camera = inputs.camera;
  const Camera& last_camera = inputs.last_camera;
  const glsl::ViewBlock view = view_block(camera, last_camera, inputs.width, inputs.height);
  bind_view(device, view);

  scene.choose_casters(caster_choice(params, inputs.lights, soft_shadows.registry()));
  scene.pose(device, inputs.last_time, inputs.time);

  const std::vector<shadow::Light> lights = shadow_lights(inputs.lights, inputs.light_ids);

  const GBuffer gbuffer =
      draw_gbuffer(device, {.scene = scene, .view = view, .motion = soft_shadows.reads_motion(params, lights)});

  const shadow::Mask mask = draw_shadow_mask(device, {.soft_shadows = soft_shadows,
                                                      .scene = scene,
                                                      .camera = camera,
                                                      .last_camera = last_camera,
                                                      .view = view,
                                                      .view_id = inputs.view,
                                                      .time = inputs.time,
                                                      .cut = inputs.cut,
                                                      .restart = inputs.restart,
                                                      .mask_details = inputs.mask_details,
                                                      .moved = knows_moved ? Moved::of_scene : Moved::unknown,
                                                      .lights = lights,
                                                      .frame_lights = inputs.lights,
                                                      .on_ground = inputs.on_ground,
                                                      .gbuffer = gbuffer,
                                                      .params = params});

  const scene::Bounds bounds = scene.receivers();
  const ShadingInputs shading{.soft_shadows = soft_shadows,
                              .scene = scene,
                              .frame = inputs,
                              .mask = mask,
                              .sky = sky,
                              .bounds = bounds,
                              .lights = lights,
                              .params = params};
  const gl::Texture& lit = shade(device, shading, {.view = view, .gbuffer = gbuffer});

  const gl::Buffer& exposure = measure_exposure(device, {.gbuffer = gbuffer, .lit = lit, .params = params});

  FrameParts parts{.scene = &scene,
                   .last_time = inputs.last_time,
                   .time = inputs.time,
                   .view = view,
                   .camera = camera,
                   .gbuffer = gbuffer,
                   .mask = mask,
                   .color = &lit,
                   .exposure = &exposure};
  if (inputs.samples == 1) {
    parts.display = &tone_map(device, {.lit = lit, .exposure = exposure, .noise = noise, .params = params});
  } else {
    if (inputs.show_first) {
      device.aside([&] {
        inputs.show_first(tone_map(device, {.lit = lit, .exposure = exposure, .noise = noise, .params = params}));
      });
    }
    const SampleMean mean = average_samples(device, shading, parts);
    parts.color = mean.color;
    parts.display = &encode_mean(device, {.display = *mean.display, .noise = noise, .params = params});
  }
  return parts;
}

void add_motion(gl::Device& device, FrameParts& frame) {
  if (frame.gbuffer.motion != nullptr) return;
  bind_view(device, frame.view);
  frame.scene->pose(device, frame.last_time, frame.time);
  frame.gbuffer = draw_gbuffer(device, {.scene = *frame.scene, .view = frame.view, .motion = true});
}

}  // namespace penumbra::render
