#include "viewer/scene_loader.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "image/read.h"
#include "io/output_file.h"

namespace penumbra::viewer {

namespace {

// Images take most of the time, so a cancelled scene ends at its next image.
scene::ImageDecoder decoder_until(std::stop_token cancelled, const scene::ReadLimits& limits) {
  const scene::ImageDecoder decode = image::image_decoder(limits);
  return {[cancelled = std::move(cancelled), decode](std::span<const std::byte> encoded, const std::string& name) {
            if (cancelled.stop_requested()) fail("{}: cancelled", name);
            return decode(encoded, name);
          },
          decode.probe()};
}

bool is_ready(const std::future<session::PreparedScene>& loading) {
  return loading.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

SceneLoader::~SceneLoader() { cancelled_.request_stop(); }

void SceneLoader::start(cli::SceneOptions options) {
  cancelled_.request_stop();
  if (loading_.valid()) ending_.push_back(std::move(loading_));
  options_ = std::move(options);
  cancelled_ = {};
  try {
    loading_ = std::async(std::launch::async, [options = options_, cancelled = cancelled_.get_token()] {
      return session::load_scene(options, decoder_until(cancelled, cli::limits_of(options.reading)));
    });
  } catch (const std::system_error& error) {
    fail("{}: no thread to read it: {}", io::quoted(options_.scene), error.code().message());
  }
}

std::optional<SceneLoader::Loaded> SceneLoader::finished() {
  std::erase_if(ending_, is_ready);
  if (!loading_.valid() || !is_ready(loading_)) return {};
  return Loaded{options_, loading_.get()};
}

}  // namespace penumbra::viewer
