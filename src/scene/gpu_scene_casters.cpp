// Draws the depth of shadow casters.
#include <glm/glm.hpp>
#include <string>

#include "gl/api.h"
#include "scene/gpu_scene.h"
#include "scene/gpu_scene_boxes.h"
#include "scene/gpu_scene_state.h"

namespace penumbra::scene {

namespace {

// Whether triangles that are counter-clockwise as seen from the light are clockwise in its map. A map with x to the
// right, y up and depth growing away from the light is left-handed, so a matrix that keeps their order has a negative
// determinant.
bool turns_round(const glm::mat4& to_clip) { return glm::determinant(to_clip) > 0; }

// Behind the first layer only one face of single-sided materials casts: a closed object's underside would hide what
// lies below it.
CasterFaces faces_of(const Instance& instance, bool behind) {
  const bool one_face = behind && *instance.faces == CasterFaces::both && !instance.double_sided;
  return one_face ? CasterFaces::front : *instance.faces;
}

// All casters of both faces without a material share one draw. Where only one face casts, the other face is culled like
// back faces.
Batch caster_batch(const Instance& instance, CasterFaces faces, bool masked, bool flips) {
  Batch batch{.deformed = instance.job >= 0,
              .double_sided = true,
              .material = masked ? instance.material : -1,
              .alpha_only = masked,
              .traits = depth_traits(instance, masked)};
  if (faces == CasterFaces::both) return batch;
  batch.double_sided = false;
  batch.mirrored = (instance.mirrored != flips) != (faces == CasterFaces::back);
  return batch;
}

}  // namespace

SurfaceTraits depth_traits(const Instance& instance, bool masked) {
  if (!masked) return {};
  constexpr unsigned base_color = 1u << TEXTURE_BASE_COLOR;
  return {.textures = instance.traits.textures & base_color,
          .transforms = instance.traits.transforms & base_color,
          .masked = true};
}

gl::ProgramDesc caster_program(const CasterDraw& which, const SurfaceTraits& traits) {
  const bool behind = which.behind.has_value();
  gl::ProgramDesc program{.name = traits.masked ? "alpha caster" : "caster",
                          .vertex = "scene/caster.vert",
                          .defines = {{"LAST_POSE", which.last_pose ? "1" : "0"},
                                      {"MASKED", traits.masked ? "1" : "0"},
                                      {"TEXTURES", std::to_string(traits.textures)},
                                      {"TRANSFORMS", std::to_string(traits.transforms)},
                                      {"MARKS_MOVED", which.marks ? "1" : "0"},
                                      {"BEHIND", behind ? "1" : "0"},
                                      {"ANCHORED", which.anchored ? "1" : "0"}}};
  if (traits.masked || which.marks || behind) program.fragment = "scene/caster.frag";
  return program;
}

void GpuScene::State::draw_casters(gl::Device& device, gl::Pass& pass, const CasterDraw& which,
                                   const CasterMatrix& matrix, const BoxOverlap& reaches) const {
  const bool flips = turns_round(matrix.to_clip);
  for (const bool masked : {false, true}) {
    DrawList list;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
      const Instance& instance = instances[i];
      if (!instance.faces || instance.casts != (masked ? CastMode::by_alpha : CastMode::always)) continue;
      if (!(instance.moved ? which.moved : which.still)) continue;
      const Overlap overlap = reaches(which.last_pose ? instance.last_box : instance.box);
      if (overlap == Overlap::none) continue;
      const Batch batch = caster_batch(instance, faces_of(instance, which.behind.has_value()), masked, flips);
      if (overlap == Overlap::all || instance.parts == nullptr || which.last_pose) {
        list.add(instance, i, batch);
        continue;
      }
      for (const MeshPart& part : *instance.parts) {
        if (reaches(transformed(part.box, instance.world)) != Overlap::none) list.add_part(instance, i, batch, part);
      }
    }
    const auto use = [&](const SurfaceTraits& traits) {
      const gl::Program& program = pass.use(caster_program(which, traits));
      program.set("anchored_to_clip", matrix.to_clip);
      program.set("anchor", matrix.anchor);
      if (which.behind) program.set("gap", *which.behind);
    };
    draw(device, pass, list, use);
  }
}

void GpuScene::draw_casters(gl::Device& device, gl::Pass& pass, CasterSubset casters, const CasterMatrix& matrix,
                            const BoxOverlap& reaches) {
  const auto draw = [&](const CasterDraw& which) { state_->draw_casters(device, pass, which, matrix, reaches); };
  switch (casters) {
    case CasterSubset::all:
      draw({.still = true, .moved = true});
      break;
    case CasterSubset::all_and_moved:
      // Casters that did not move only occlude, so they need no fragment stage: they are drawn first and write no mark.
      gl::glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      draw({.still = true});
      gl::glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      draw({.moved = true, .marks = true});
      break;
    case CasterSubset::moved_now:
      draw({.moved = true, .marks = true});
      break;
    case CasterSubset::moved_last:
      draw({.moved = true, .marks = true, .last_pose = true});
      break;
  }
}

void GpuScene::draw_casters_behind(gl::Device& device, gl::Pass& pass, float gap, const CasterMatrix& matrix,
                                   const BoxOverlap& reaches) {
  state_->draw_casters(device, pass, {.still = true, .moved = true, .behind = gap}, matrix, reaches);
}

}  // namespace penumbra::scene
