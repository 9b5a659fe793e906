#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "scene/casting.h"
#include "scene/pose.h"
#include "scene/posed_geometry.h"
#include "scene/scene.h"

namespace penumbra::scene {

// Decides by an instance's world box whether it is drawn.
using BoxTest = std::function<bool(const Bounds&)>;

// Which surfaces a pass draws.
enum class Surfaces { opaque, masked };

enum class Casters {
  all,            // depth only
  all_and_moved,  // and 1 in fragment output 0, which was clear, where those that moved since the last frame are
                  // nearest
  moved_now,      // those that moved, where they are; output 0 is 1
  moved_last,     // those that moved, where they were; output 0 is 1
};

// A scene on the GPU: one set of vertex buffers, one of indices, one of instances. `scene` must outlive it unchanged.
class GpuScene {
 public:
  GpuScene(gl::Device& device, const Scene& scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  // Takes the poses of the last and the present frame: matrices, skins and morphs. Work that is already done is kept.
  void pose(gl::Device& device, double last_time, double time);

  // Which casters draw_casters(), the bounds of casters and posed_geometry() have from now on. At first: all, of both
  // faces, but skies.
  void choose_casters(const CasterChoice& choice);

  // Draws surfaces with a program that includes glsl/scene/surface.vert; the view's uniform block is bound.
  void draw_surfaces(gl::Device& device, gl::Pass& pass, Surfaces surfaces, const gl::ProgramDesc& program,
                     const BoxTest& visible);
  // Draws BLEND surfaces from back to front as seen from `eye`.
  void draw_blended(gl::Device& device, gl::Pass& pass, const gl::ProgramDesc& program, const glm::vec3& eye,
                    const BoxTest& visible);
  // Draws what casts shadows: opaque surfaces, and of the others what their alpha leaves.
  void draw_casters(gl::Device& device, gl::Pass& pass, Casters casters, const glm::mat4& world_to_clip,
                    const BoxTest& reaches);
  // Draws the triangles of opaque and masked casters, the latter whole, both faces of each, with
  // with_caster_vertices(stages).
  void draw_caster_geometry(gl::Device& device, gl::Pass& pass, const gl::ProgramDesc& stages,
                            const glm::mat4& world_to_clip, const BoxTest& reaches);

  const Scene& scene() const;
  // Unlike that of any other scene of this process, those that are gone included; never 0.
  std::uint64_t id() const;
  bool has_blended() const;
  bool moved() const;      // anything, between the two poses
  Bounds casters() const;  // world bounds in the present pose
  Bounds receivers() const;
  Bounds moved_bounds() const;  // of the casters that moved between the two poses, in both; empty: none did
  bool lit_by_file() const;     // it brings a directional light, so its emission is in the same units

  // The present pose's triangles as shaders get them. Refers to the scene; waits for the GPU.
  PosedGeometry posed_geometry() const;

  // A program of geometry and fragment shaders with the vertex shader of casters, which writes gl_Position alone.
  static gl::ProgramDesc with_caster_vertices(gl::ProgramDesc stages);

  // Every program that draw_casters() and pose() use.
  static std::vector<gl::ProgramDesc> programs();

  // Deformed positions as the last pose() left them, for tests: all vertices of skinned and morphed instances.
  std::vector<glm::vec3> read_deformed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::scene
