#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::gl {

// Shader files by name, names relative to glsl/ ("lib/kernel.glsl"). Built-in ones are embedded in the library; files
// in a directory given by the user replace them.
class ShaderFiles {
 public:
  ShaderFiles() = default;  // built-in only
  explicit ShaderFiles(std::string overlay_directory);

  // The text of a file: generated, else the overlay's, else built in. nullopt when none has it, or when the name is
  // absolute or leaves the folder. Throws Error for a name of the overlay that can't be read: no regular file, one of
  // more than 1 MiB, or a link that leads nowhere.
  std::optional<std::string> read(std::string_view name) const;
  // Adds or replaces an in-memory file (generated declarations: "generated/registry0/params.glsl").
  void put(std::string name, std::string text);
  bool has_generated(std::string_view name) const { return generated_.contains(name); }
  // A file's name in messages: its path on disk if it is the overlay's, else "glsl/lib/kernel.glsl".
  std::string shown_name(std::string_view name) const;
  const std::string& overlay_directory() const { return overlay_; }
  static std::vector<std::string> built_in_names();

 private:
  std::string overlay_;
  std::map<std::string, std::string, std::less<>> generated_;
};

struct Define {
  std::string name, value;
  auto operator<=>(const Define&) const = default;
};

// One stage's text, ready for the driver: #version 450 core, the defines that its code mentions, then the file, with
// every #include "name" resolved once (include-once). Includes are resolved before the preprocessor runs: conditions
// around them have no effect. #include <…> and #pragma once, which C++ needs in shared headers, are dropped. There are
// no #line directives: Mesa loses the file's number in messages about types.
struct ShaderSource {
  struct Line {
    std::size_t file = no_file;  // index into `files`
    int number = 0;              // from 1
    bool operator==(const Line&) const = default;
  };
  static constexpr std::size_t no_file = static_cast<std::size_t>(-1);  // the version and the defines

  std::string text;
  std::vector<std::string> files;             // [0] is the root
  std::vector<Line> lines;                    // where each line of `text` comes from
  std::vector<std::string> shown_names = {};  // one per file, for messages; empty: "glsl/" and the name
};

// The most files that a stage may be made of: a limit for includes that never end.
constexpr std::size_t most_shader_files = 1000;

// Throws Error naming file and line when a file is missing, an include is malformed, or there are more files than that.
// Cycles can't happen: each file is included once.
ShaderSource load_shader_source(const ShaderFiles& files, std::string_view root, const std::vector<Define>& defines);

// Rewrites "0(56)", "0:56(5)" and "0:56:" of a driver's log into "glsl/lib/kernel.glsl:12:", one message a line,
// without repetitions. After the last message about a source line follows that line itself, indented.
std::string translate_log(std::string_view driver_log, const ShaderSource& source);

}  // namespace penumbra::gl
