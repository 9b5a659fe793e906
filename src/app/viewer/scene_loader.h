#pragma once

#include <future>
#include <optional>
#include <string>

#include "studio/stage.h"

namespace penumbra::app {

// Reads scenes on a thread of its own, so that the window lives on.
class SceneLoader {
 public:
  // Begins to read; one that is being read is dropped.
  void start(studio::StageOptions options);
  // The scene once it is there, with the options that it was read with. Throws Error for one that can't be read.
  struct Loaded {
    studio::StageOptions options;
    studio::Stage stage;
  };
  std::optional<Loaded> finished();
  // The file that is being read; empty: none.
  const std::string& file() const { return options_.scene; }

 private:
  studio::StageOptions options_;
  std::future<studio::Stage> loading_;
};

}  // namespace penumbra::app
