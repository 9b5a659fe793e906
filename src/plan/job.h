#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/given.h"
#include "plan/plan.h"
#include "plan/results.h"
#include "plan/scene_facts.h"

namespace penumbra::plan {

// The work of one command line, divided into items that depend on no other. Drawing an item and writing the report are
// two steps: the command itself does both, `work` the first, and `merge` the second from what `work` kept.
class Job {
 public:
  Job() = default;
  virtual ~Job() = default;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  // The number of items. The same arguments always give the same items, except those of a bench, which depend on the
  // device that plans.
  virtual std::size_t count() const = 0;
  // The scenes' files, as the user gave them; one that is empty for a scene that the command makes itself.
  virtual std::vector<std::string> scenes() const = 0;
  virtual std::size_t scene_of(std::size_t item) const = 0;
  // For messages: "courtyard.glb, pcss".
  virtual std::string name(std::size_t item) const = 0;
  // All that an item's result depends on, except the program and the content of the files.
  virtual io::Json depends(std::size_t item) const = 0;
  // What an item is, for readers of the plan: frames, technique, parameters.
  virtual io::Json what(std::size_t item) const = 0;

  // Reads a scene, without its images. Throws Error, also for a camera that it lacks.
  virtual SceneFacts facts(std::size_t scene) const = 0;
  virtual Estimate estimate(std::size_t item, const SceneFacts& facts) const = 0;

  // Warns of what the user should know who makes the plan.
  virtual void warn() const = 0;

  // Draws an item. Throws Error.
  virtual Result work(std::size_t item) const = 0;

  // All files that merge() may write into a folder.
  virtual std::vector<std::filesystem::path> outputs(const std::filesystem::path& folder) const = 0;

  // Gives the result of an item, as often as it is asked for. Throws Error if it is damaged.
  using Read = std::function<Result(std::size_t item)>;
  // Writes what the whole command would write into a folder. Returns the files. Throws Error.
  virtual std::vector<std::filesystem::path> merge(const Read& read, const std::filesystem::path& folder) const = 0;
};

// The options of a command line that an item depends on, but for those of these names.
io::Json json_of(const std::vector<cli::GivenOption>& options, std::initializer_list<std::string_view> except);

// Tells, in one warning, that not all results of a plan were drawn by the same device.
class DeviceCheck {
 public:
  void add(const std::string& device);
  void warn() const;

 private:
  std::string first_, other_;
  std::size_t count_ = 0, others_ = 0;
};

// The key of an item: a hash of the program, of all that the item depends on, and of what its scene's files hold. Of
// shaders also the names, which say what they replace.
io::Key key_of(const Program& program, const std::string& command, const io::Json& depends, const PlannedScene& scene);

}  // namespace penumbra::plan
