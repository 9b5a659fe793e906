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

// Compiles programs on first use and keeps them. Reload is first load: changed() marks what depends on a file, and
// reload(), or the next get(), compiles it again by the same path; while that fails the last good program keeps
// serving. A parameter that is compiled in makes a program of each of its values: where frames are counted, those that
// no frame uses any more are idle. A save compiles them no more, but their next get() does; past `most_idle` of them
// the oldest are let go.
class ShaderLibrary {
 public:
  static constexpr std::size_t most_idle = 64;
  static constexpr std::uint64_t idle_after = 8;  // frames

  explicit ShaderLibrary(ShaderFiles files) : files_(std::move(files)) {}

  // Throws Error when the program fails to compile and there is no earlier good one; the next call tries again. The
  // reference stays valid through reloads, and for this frame and the next where frames are counted.
  const Program& get(const ProgramDesc& desc);
  // A frame begins: what was not used for some of them is idle.
  void next_frame();

  // A file's text changed, or it came or went: programs that include it, and those whose last rebuild failed, are to be
  // rebuilt. `file` is relative to glsl/.
  void changed(std::string_view file);
  struct Reload {
    std::size_t rebuilt = 0, failed = 0;
  };
  // Rebuilds now what is to be rebuilt, but for idle programs.
  Reload reload();
  // Messages of programs whose rebuild failed and that draw with their last good version, each once; empty when all is
  // well. An idle program's fault is told from its next get() on.
  std::vector<std::string> errors() const;
  // Whether any get() since the last call gave a last good version because the rebuild failed.
  bool take_outdated() { return std::exchange(outdated_, false); }

  ShaderFiles& files() { return files_; }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::unique_ptr<Program> program;
    std::uint64_t used = 0;  // in this frame, last
    bool stale = false;
    std::string error;
  };
  void rebuild(const ProgramDesc& desc, Entry& entry);
  bool is_idle(const Entry& entry) const { return entry.used + idle_after < frame_; }

  ShaderFiles files_;
  std::map<ProgramDesc, Entry> entries_;
  std::uint64_t frame_ = 0;
  bool outdated_ = false;
};

}  // namespace penumbra::gl
