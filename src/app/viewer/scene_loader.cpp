#include "app/viewer/scene_loader.h"

#include <chrono>
#include <utility>

#include "image/read.h"

namespace penumbra::app {

void SceneLoader::start(studio::StageOptions options) {
  options_ = std::move(options);
  // Waits for the one before: a file that is read can't be let go half-way.
  loading_ = std::async(std::launch::async,
                        [options = options_] { return studio::load_stage(options, image::image_decoder()); });
}

std::optional<SceneLoader::Loaded> SceneLoader::finished() {
  if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
  const studio::StageOptions options = std::exchange(options_, {});
  return Loaded{options, loading_.get()};
}

}  // namespace penumbra::app
