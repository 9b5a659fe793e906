#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "session/prepared_scene.h"
#include "viewer/detail.h"
#include "viewer/document.h"

namespace penumbra::viewer {

// The scene that is shown, on the CPU and on the GPU.
struct LoadedScene {
  LoadedScene(gl::Device& device, session::PreparedScene loaded)
      : prepared(std::move(loaded)), gpu(device, prepared.scene) {}

  session::PreparedScene prepared;
  scene::GpuScene gpu;
  std::vector<std::string> cameras = render::camera_names(prepared.scene);
  std::vector<std::string> lights = render::light_names(prepared.scene);
  std::vector<std::size_t> light_nodes = render::light_nodes(prepared.scene);
};

// The shadow maps of a light in a drawing.
struct DrawnMaps {
  int layers = 0;  // cascades, or maps of a lamp; 0: none were needed
  int size = 0;    // texels along a side of each
};

// Ends a drawing that is no longer wanted, from gl::Device::before_pass.
struct GivenUp {};

// Draws one of the two pictures, A or B, and keeps what it drew last.
class PictureRenderer {
 public:
  // `view`: 0 for A, 1 for B, which share a renderer (FrameInputs::view). Frames whose detail makes the maps smaller
  // have a view of their own, so that those of full size need not be allocated and drawn again after them.
  PictureRenderer(gl::Device& device, render::Renderer& renderer, int view);

  // Whether the last drawing is of this document, at full size or a smaller one.
  bool shows(const Document& document) const;
  // Whether it has these parameters, whatever else has changed.
  bool has_params_of(const Document& document) const;
  // Draws the document in that detail, with the motion since the last drawing. `refined`: all samples of a pixel have
  // shadows of their own; only of documents that refines() names. Where each pixel has several samples, `first_drawn`
  // is called as soon as picture() has the first of them. Throws Error. Where it throws GivenUp, it still has a
  // picture, and the next drawing is the first of its own picture; where only the refined drawing was given up, the
  // picture before it stays and counts.
  void draw(LoadedScene& scene, const Document& document, const Detail& detail, bool refined,
            const std::function<void()>& first_drawn = {});
  // The next drawing has nothing to do with the last one: after another scene or other shaders.
  void cut() {
    cut_.fill(true);
    frames_ = 0;
    drawn_.clear();
  }
  // The next drawing starts without history; shadow maps in which nothing moved are kept.
  void restart() {
    restart_ = true;
    frames_ = 0;
  }
  // Whether the last drawing began a history: after a cut or a restart, or with other parameters, lights or sizes.
  bool began_history() const { return began_history_; }
  // The picture has to be drawn again: what it shows was not finished.
  void again() { frames_ = 0; }

  // Frees the picture, and its maps, masks and histories.
  void forget();

  // Frames drawn in full detail since the document changed.
  int frames() const { return detail_.is_full() ? frames_ : 0; }
  double milliseconds() const { return milliseconds_; }

  // The last drawing, tone mapped, RGBA8; valid until the next draw().
  const gl::Texture& picture() const { return *picture_; }
  // Whether it has one sample of each pixel although the document asks for several.
  bool is_rough() const { return rough_; }
  // The same with smooth edges if it is rough: what a user is shown.
  const gl::Texture& smoothed_picture() const { return smooth_ != nullptr ? *smooth_ : *picture_; }
  // Goes up whenever either has other content.
  std::uint64_t version() const { return version_; }
  bool has_picture() const { return picture_ != nullptr; }
  // The maps of each light in the last drawing.
  const std::vector<DrawnMaps>& maps() const { return maps_; }
  // The view in which the last drawing's maps and masks are.
  int view() const { return small_maps_ ? view_of_small_maps(view_) : view_; }

 private:
  static constexpr int view_of_small_maps(int view) { return view + 2; }  // beside those of A and B

  void keep(const gl::Texture& display, bool rough);

  gl::Device& device_;
  render::Renderer& renderer_;
  int view_;
  const gl::Texture* picture_ = nullptr;
  const gl::Texture* smooth_ = nullptr;  // of a rough picture
  std::string drawn_;                    // the document drawn last, as its command line
  ParamSet params_;                      // its parameters, in full detail
  std::vector<std::string> lights_;      // the options that choose its lights
  Detail detail_;
  std::vector<DrawnMaps> maps_;
  int frames_ = 0;
  double milliseconds_ = 0, last_time_ = 0;
  render::Camera last_camera_;
  std::array<bool, 2> cut_{true, true};  // of the view with maps of full size, and of that with smaller ones
  glm::ivec2 size_{0};                   // of the last document
  std::uint64_t version_ = 0;
  bool restart_ = false, small_maps_ = false, rough_ = false, began_history_ = false;
};

}  // namespace penumbra::viewer
