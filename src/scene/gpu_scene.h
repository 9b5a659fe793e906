#pragma once

#include <array>
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
#include "scene/surface_traits.h"

namespace penumbra::scene {

// Decides from an instance's world-space box whether the instance is drawn.
using BoxTest = std::function<bool(const Bounds&)>;

// How much of a world-space box a pass can show.
enum class Overlap { none, part, all };
using BoxOverlap = std::function<Overlap(const Bounds&)>;

// Makes the program that a pass has for such surfaces the current one.
using UseProgram = std::function<void(const SurfaceTraits&)>;
// Orders what is drawn; any unit.
using Distance = std::function<float(const Bounds&)>;

// Which casters a pass draws, and what it writes.
enum class CasterSubset {
  all,  // all casters, depth only
  // All casters. Also writes 1 to fragment output 0, which the caller has cleared, where the nearest caster moved since
  // the last frame.
  all_and_moved,
  moved_now,   // casters that moved, at their present position; writes 1 to output 0
  moved_last,  // casters that moved, at their last position; writes 1 to output 0
};

// Takes positions in the world, less an anchor, metres, to clip space.
struct CasterMatrix {
  glm::mat4 to_clip{1};
  glm::vec3 anchor{0};
};

// A scene on the GPU: one set of vertex buffers, one index buffer and one instance buffer for all primitives. `scene`
// must outlive this object and stay unchanged.
class GpuScene {
 public:
  GpuScene(gl::Device& device, const Scene& scene);
  ~GpuScene();
  GpuScene(const GpuScene&) = delete;
  GpuScene& operator=(const GpuScene&) = delete;

  // Uploads the poses of the last and the present frame: matrices, skins and morphs. Poses that are already on the GPU
  // are not computed again.
  void pose(gl::Device& device, double last_time, double time);

  // Sets which casters draw_casters(), the bounds of casters and posed_geometry() include from now on. Initially:
  // everything but skies, with both faces.
  void choose_casters(const CasterChoice& choice);

  // Draws the depth of opaque surfaces, and of masked ones where their alpha passes; each of them nearest first, so
  // that the depth test rejects most of what is hidden.
  void draw_depth(gl::Device& device, gl::Pass& pass, const glm::mat4& world_to_clip, const BoxTest& visible,
                  const Distance& distance);
  // Draws opaque and masked surfaces, with programs of glsl/scene/surface.vert, over their depth from draw_depth(): the
  // pass tests for equal depth. Of several at the same depth the last is seen; their order is always the same. The
  // caller has bound the view's uniform block.
  void draw_surfaces(gl::Device& device, gl::Pass& pass, const UseProgram& use, const BoxTest& visible);
  // Draws BLEND surfaces, those with the greatest distance first.
  void draw_blended(gl::Device& device, gl::Pass& pass, const UseProgram& use, const BoxTest& visible,
                    const Distance& distance);
  // Draws the shadow casters: opaque surfaces, and masked and blended ones where their alpha passes. Of a large mesh
  // that overlaps in part, `reaches` is asked for its parts too.
  void draw_casters(gl::Device& device, gl::Pass& pass, CasterSubset casters, const CasterMatrix& matrix,
                    const BoxOverlap& reaches);
  // Draws all casters, and writes their depths + `gap` to fragment output 0, for passes that keep what is behind a
  // first layer: of double-sided materials both faces, of others only the face towards the light, unless they were told
  // to cast from their back faces.
  void draw_casters_behind(gl::Device& device, gl::Pass& pass, float gap, const CasterMatrix& matrix,
                           const BoxOverlap& reaches);
  // Draws the triangles of opaque and masked casters with caster_geometry_programs(stages), without the alpha test of
  // masked surfaces. Where only one face casts, a triangle whose other face is towards the light has all corners in one
  // place. `light`: homogeneous world coordinates, with w = 0 for a direction to the light, else 1.
  void draw_caster_geometry(gl::Device& device, gl::Pass& pass, const gl::ProgramDesc& stages,
                            const glm::mat4& world_to_clip, const glm::vec4& light, const BoxTest& reaches);

  const Scene& scene() const;
  // Unique among all scenes of this process, destroyed ones included; never 0.
  std::uint64_t id() const;
  bool has_blended() const;
  bool has_emissive() const;  // whether any other surface emits light
  bool moved() const;         // whether anything moved between the two poses
  Bounds casters() const;     // world bounds in the present pose
  Bounds receivers() const;
  Bounds blended_receivers() const;  // of blended surfaces alone; empty if there are none
  Bounds moved_bounds() const;  // of the casters that moved between the two poses, in both poses; empty if none did
  bool lit_by_file() const;     // the file has a light, so its emission is in matching units

  // The triangles of the present pose as shaders read them. Refers to the scene; waits for the GPU.
  PosedGeometry posed_geometry() const;

  // The programs that a program of geometry and fragment shaders becomes with the casters' vertex shaders, which write
  // only gl_Position: for surfaces of which both faces cast shadows, and for those of which one does.
  static std::array<gl::ProgramDesc, 2> caster_geometry_programs(const gl::ProgramDesc& stages);

  // Every program that draw_depth(), draw_casters() and pose() use.
  static std::vector<gl::ProgramDesc> programs();

  // For tests: the deformed positions of all skinned and morphed instances after the last pose().
  std::vector<glm::vec3> read_deformed() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace penumbra::scene
