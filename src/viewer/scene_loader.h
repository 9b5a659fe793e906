#pragma once

#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "session/prepared_scene.h"

namespace penumbra::viewer {

// Reads scenes on background threads, so that the window stays responsive.
class SceneLoader {
 public:
  SceneLoader() = default;
  // Waits for threads that are still reading; they stop at their next image.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  // Starts to read a scene, and cancels the one that is being read. Never waits. Throws Error where no thread can be
  // started.
  void start(cli::SceneOptions options);
  // The scene once it is read, with its options. Throws Error if it can't be read.
  struct Loaded {
    cli::SceneOptions options;
    session::PreparedScene prepared;
  };
  std::optional<Loaded> finished();
  // The scene that was read is not shown.
  void forget() { options_ = {}; }
  // The options of the last start(), also if reading failed.
  const cli::SceneOptions& asked() const { return options_; }
  // The file that is being read, or empty.
  std::string file() const { return loading_.valid() ? options_.scene : ""; }

 private:
  cli::SceneOptions options_;
  std::stop_source cancelled_;  // of the scene that is being read
  std::future<session::PreparedScene> loading_;
  std::vector<std::future<session::PreparedScene>> ending_;  // cancelled, but not at their next image yet
};

}  // namespace penumbra::viewer
