#pragma once

#include <future>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "session/prepared_scene.h"

namespace penumbra::viewer {

// Reads scenes on threads of their own, so that the window lives on.
class SceneLoader {
 public:
  SceneLoader() = default;
  // Waits for what is being read, which ends at its next image.
  ~SceneLoader();
  SceneLoader(const SceneLoader&) = delete;
  SceneLoader& operator=(const SceneLoader&) = delete;

  // Begins to read; one that is being read is dropped. Waits for nothing.
  void start(cli::SceneOptions options);
  // The scene once it is there, with the options that it was read with. Throws Error for one that can't be read.
  struct Loaded {
    cli::SceneOptions options;
    session::PreparedScene prepared;
  };
  std::optional<Loaded> finished();
  // What was started last, whatever came of it.
  const cli::SceneOptions& asked() const { return options_; }
  // The file that is being read; empty: none.
  std::string file() const { return loading_.valid() ? options_.scene : ""; }

 private:
  cli::SceneOptions options_;
  std::stop_source dropped_;  // of what is being read
  std::future<session::PreparedScene> loading_;
  std::vector<std::future<session::PreparedScene>> ending_;  // dropped, and not at their next image yet
};

}  // namespace penumbra::viewer
