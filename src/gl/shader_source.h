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

// Shader files by name, names relative to glsl/ ("lib/kernel.glsl"). Built-in ones are embedded in the library; a
// directory given by the user overlays them.
class ShaderFiles {
 public:
  ShaderFiles() = default;  // built-in only
  explicit ShaderFiles(std::string overlay_directory);

  // The text of a file: generated, else the overlay's, else built in. nullopt when none has it, or when the name is
  // absolute or leaves the folder.
  std::optional<std::string> read(std::string_view name) const;
  // Adds or replaces an in-memory file (generated declarations: "generated/registry0/params.glsl").
  void put(std::string name, std::string text);
  // What messages call a file: where the user can open it if it is the overlay's, else "glsl/lib/kernel.glsl".
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

// One stage's text, ready for the driver: #version 450 core, defines, then the file with every #include "name" resolved
// once (include-once). Includes are resolved before the preprocessor runs: conditions around them do not count.
// #include <…> and #pragma once, which C++ needs in shared headers, are dropped. There are no #line directives: Mesa
// loses the file's number in messages about types.
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
  std::vector<std::string> shown_names = {};  // one a file, for messages; empty: "glsl/" and the name
};

// Files that one stage may be made of, so that a chain of includes ends.
constexpr std::size_t most_shader_files = 1000;

// Throws Error naming file and line when a file is missing, an include is malformed, or there are more files than that.
// Cycles can't happen: each file is included once.
ShaderSource load_shader_source(const ShaderFiles& files, std::string_view root, const std::vector<Define>& defines);

// Rewrites "0(56)", "0:56(5)" and "0:56:" of a driver's log into "glsl/lib/kernel.glsl:12:", one message a line, told
// once where a driver repeats itself. Under the last message about a line stands that line itself, indented.
std::string translate_log(std::string_view driver_log, const ShaderSource& source);

}  // namespace penumbra::gl
