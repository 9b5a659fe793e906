#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "program.h"

namespace penumbra::gl {

// Compiles programs on first use and keeps them. When a file changes, changed() marks the programs that depend on it,
// and reload(), or the next get(), compiles them again in the same way as the first time. As long as that fails, get()
// returns the last program that compiled. Each value of a compiled-in parameter needs a separate program. If the caller
// counts frames with next_frame(), programs not used for more than `idle_after` frames are idle: reload() skips them,
// their next get() compiles them, and if there are more than keep_idle() says, the least recently used are deleted.
class ShaderLibrary {
 public:
  static constexpr std::size_t usual_idle = 64;   // programs
  static constexpr std::uint64_t idle_after = 8;  // frames

  explicit ShaderLibrary(ShaderFiles files) : files_(std::move(files)) {}

  // Throws Error when the program fails to compile and there is no earlier good one; the next call tries again. The
  // reference stays valid through reloads, and for this frame and the next where frames are counted.
  const Program& get(const ProgramDesc& desc);
  // To be called when a frame begins. Deletes idle programs beyond usual_idle, or what keep_idle() was told last.
  void next_frame();
  // For callers that draw more kinds of frames in turn than have room among usual_idle.
  void keep_idle(std::size_t most) { most_idle_ = most; }

  // To be called when a file's text changed or it was added or deleted: marks the programs that include it, and those
  // whose last rebuild failed, to be rebuilt. `file` is relative to glsl/.
  void changed(std::string_view file);
  // How often that was called: while it stays the same, all programs draw the same.
  std::uint64_t changes() const { return changes_; }
  struct Reload {
    std::size_t rebuilt = 0, failed = 0;
  };
  // Rebuilds the marked programs that are not idle.
  Reload reload();
  // The messages, without duplicates, of programs whose last good version is used because their rebuild failed; empty
  // if there are none. An idle program's message is listed after its next get().
  std::vector<std::string> errors() const;
  // Whether a get() since the last call of this returned a last good version because the rebuild failed.
  bool take_outdated() { return std::exchange(outdated_, false); }

  ShaderFiles& files() { return files_; }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::unique_ptr<Program> program;
    std::uint64_t used = 0;  // the last frame that used it
    bool stale = false;
    std::string error;
  };
  void rebuild(const ProgramDesc& desc, Entry& entry);
  bool is_idle(const Entry& entry) const { return entry.used + idle_after < frame_; }

  ShaderFiles files_;
  std::map<ProgramDesc, Entry> entries_;
  std::size_t most_idle_ = usual_idle;
  std::uint64_t frame_ = 0, changes_ = 0;
  bool outdated_ = false;
};

}  // namespace penumbra::gl
