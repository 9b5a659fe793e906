#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "program.h"

namespace penumbra::gl {

// Compiles programs on first use and keeps them. Reload is first load: changed() drops what depends on a file, and the
// next get() compiles it again by the same path; while that fails the last good program keeps serving.
class ShaderLibrary {
 public:
  explicit ShaderLibrary(ShaderFiles files) : files_(std::move(files)) {}

  // Throws Error when the program fails to compile and there is no earlier good one.
  const Program& get(const ProgramDesc& desc);

  // A file's text changed: programs that include it are rebuilt on their next get().
  void changed(std::string_view file);
  // Messages of programs whose rebuild failed and that draw with their last good version; empty when all is well.
  std::vector<std::string> errors() const;

  ShaderFiles& files() { return files_; }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    std::unique_ptr<Program> program;
    bool stale = false;
    std::string error;
  };
  ShaderFiles files_;
  std::map<ProgramDesc, Entry> entries_;
};

}  // namespace penumbra::gl
