#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "compare/comparison.h"
#include "gl/context.h"
#include "session/prepared_scene.h"
#include "session/render_device.h"
#include "truth/technique.h"

namespace penumbra::compare {

// A part of a comparison that is drawn by itself: some of the contenders on one scene, against the reference.
struct Part {
  std::size_t scene = 0;
  std::size_t first = 0, count = 0;  // of the contenders
};

// Draws and measures parts of a comparison, one after the other. A part's result does not depend on the others.
class Drawing {
 public:
  // Opens the context; the scene of `first` is read meanwhile. Both arguments must outlive this object. Throws Error.
  Drawing(const CompareOptions& options, const ComparedValues& values, std::size_t first_scene);

  // Throws Error for a camera that a scene lacks, except the first one's, and for techniques that do not take its
  // lights; warns of settings for lights that none has. Reads the scenes without their images.
  void check_scenes() const;

  // `drawn` is called after each picture of the reference and of each contender.
  ComparedScene draw(const Part& part, const std::function<void()>& drawn);

  DrawnBy drawn_by() const;

 private:
  CompareOptions of_scene(std::size_t scene) const;
  void check_techniques(const Part& part, const session::PreparedScene& prepared) const;

  const CompareOptions& options_;
  const ComparedValues& values_;
  std::optional<std::size_t> prepared_scene_;
  std::unique_ptr<gl::Context> context_;
  truth::TruthTechnique truth_;
  shadow::Registry techniques_;
  std::optional<session::RenderDevice> device_;
  std::optional<session::PreparedScene> prepared_;
};

// Reads the scene that the options name, ready to be drawn. `decode` reads its images. Throws Error, which names it.
session::PreparedScene load_scene(const CompareOptions& options, const scene::ImageDecoder& decode);

}  // namespace penumbra::compare
