#include "shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <system_error>

#include "../core/error.h"
#include "../core/read_file.h"
#include "built_in_files.h"

namespace penumbra::gl {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// A name relative to glsl/ that stays inside of it.
bool is_inside(std::string_view name) {
  const std::filesystem::path path(name);
  return !name.empty() && !path.is_absolute() && std::ranges::find(path, "..") == path.end();
}

std::filesystem::path overlaid(const std::string& overlay, std::string_view name) {
  return std::filesystem::path(overlay) / name;
}

// nullopt if nothing has that name. A link that leads nowhere has it, and can't be read.
std::optional<std::string> read_disk(const std::filesystem::path& path) {
  constexpr std::size_t largest = 1 << 20;  // bytes
  std::error_code ignored;
  if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::not_found)
    return std::nullopt;
  try {
    const std::vector<std::byte> bytes = read_file(path, largest);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  } catch (const Error& error) {
    fail("cannot read the shader '{}': {}", path.string(), error.what());
  }
}

// How the loader treats a line of a shader file.
struct Line {
  enum class Kind { text, include, drop, malformed };
  Kind kind = Kind::text;
  std::string_view name = {};  // of an include
};

Line classify(std::string_view line) {
  std::string_view rest = trimmed(line);
  if (!rest.starts_with('#')) return {};
  rest = trimmed(rest.substr(1));
  if (rest.starts_with("pragma") && trimmed(rest.substr(6)) == "once") return {Line::Kind::drop};
  if (!rest.starts_with("include")) return {};
  rest = trimmed(rest.substr(7));
  if (rest.starts_with('<')) return {Line::Kind::drop};
  const std::size_t end = rest.find('"', 1);
  if (!rest.starts_with('"') || end == std::string_view::npos || end == 1) return {Line::Kind::malformed};
  return {Line::Kind::include, rest.substr(1, end - 1)};
}

class Loader {
 public:
  Loader(const ShaderFiles& files, ShaderSource& source) : files_(files), source_(source) {}

  // `asked_by` is the place of the include as messages begin with it, "glsl/file:line: "; empty for the root.
  void append(std::string_view name, const std::string& asked_by) {
    if (!is_inside(name)) fail("{}shader file '{}' is outside of glsl/", asked_by, name);
    const std::optional<std::string> text = files_.read(name);
    if (!text) fail("{}shader file 'glsl/{}' not found", asked_by, name);
    const std::size_t index = source_.files.size();
    if (index == most_shader_files) {
      fail("{}shader 'glsl/{}' includes more than {} files", asked_by, source_.files.front(), most_shader_files);
    }
    source_.files.emplace_back(name);
    source_.shown_names.push_back(files_.shown_name(name));
    std::string_view rest = *text;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    if (rest.empty()) append_line("", 1, index);  // so that messages about it name it
    for (int number = 1; !rest.empty(); ++number) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      append_line(rest.substr(0, end), number, index);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }

 private:
  void append_line(std::string_view line, int number, std::size_t index) {
    const Line what = classify(line);
    switch (what.kind) {
      case Line::Kind::text:
        source_.text += line;
        break;
      case Line::Kind::drop:
        break;
      case Line::Kind::malformed:
        fail("{}#include takes a name in quotes", place(index, number));
      case Line::Kind::include:
        if (std::ranges::find(source_.files, what.name) == source_.files.end()) {
          append(what.name, place(index, number));
          return;
        }
        break;
    }
    source_.text += '\n';
    source_.lines.push_back({index, number});
  }

  std::string place(std::size_t index, int number) const {
    return fmt::format("{}:{}: ", source_.shown_names[index], number);
  }

  const ShaderFiles& files_;
  ShaderSource& source_;
};

// Whether code has the name, also as a part of another one, but not in a comment to the end of a line.
bool mentions(std::string_view code, std::string_view name) {
  for (std::size_t at = code.find(name); at != std::string_view::npos; at = code.find(name, at + 1)) {
    const std::size_t line = code.rfind('\n', at) + 1;  // 0 if there is none before
    if (code.substr(line, at - line).find("//") == std::string_view::npos) return true;
  }
  return false;
}

// Takes a number from the front of `text`.
std::optional<std::size_t> take_number(std::string_view& text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

bool take(std::string_view& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return false;
  text.remove_prefix(prefix.size());
  return true;
}

struct Message {
  std::size_t line;  // of the whole text, from 1
  std::string text;
};

// "0(12) : error C1008: …" (NVIDIA), "0:12(5): error: …" (Mesa), "ERROR: 0:12: …" (glslang, AMD, Intel).
std::optional<Message> parse_message(std::string_view rest) {
  const char* severity = take(rest, "ERROR: ") ? "error: " : take(rest, "WARNING: ") ? "warning: " : "";
  if (!take_number(rest)) return std::nullopt;  // the driver's number for the whole text
  const bool line_in_brackets = take(rest, "(");
  if (!line_in_brackets && !take(rest, ":")) return std::nullopt;
  const auto line = take_number(rest);
  if (!line) return std::nullopt;
  if (line_in_brackets || take(rest, "(")) {
    if (!line_in_brackets) take_number(rest);  // Mesa's column
    if (!take(rest, ")")) return std::nullopt;
  }
  rest = trimmed(rest);
  if (!take(rest, ":")) return std::nullopt;
  return Message{*line, fmt::format("{}{}", severity, trimmed(rest))};
}

std::string shown_name(const ShaderSource& source, std::size_t file) {
  return file < source.shown_names.size() ? source.shown_names[file] : "glsl/" + source.files[file];
}

// A line of the whole text, counted from 1, as it follows a message; empty if the line is.
std::string quoted_line(const ShaderSource& source, std::size_t number) {
  std::string_view text = source.text;
  for (; number > 1 && !text.empty(); --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  const std::string_view line = trimmed(text.substr(0, text.find('\n')));
  return line.empty() ? "" : fmt::format("\n    {}", line);
}

}  // namespace

ShaderFiles::ShaderFiles(std::string overlay_directory) : overlay_(std::move(overlay_directory)) {}

std::optional<std::string> ShaderFiles::read(std::string_view name) const {
  if (!is_inside(name)) return std::nullopt;
  if (const auto found = generated_.find(name); found != generated_.end()) return found->second;
  if (!overlay_.empty()) {
    if (auto text = read_disk(overlaid(overlay_, name))) return text;
  }
  const auto files = built_in_files();
  const auto found = std::ranges::find(files, name, &BuiltInFile::name);
  if (found == files.end()) return std::nullopt;
  return std::string(found->text);
}

std::string ShaderFiles::shown_name(std::string_view name) const {
  std::error_code ignored;
  const bool from_overlay = !overlay_.empty() && is_inside(name) && !generated_.contains(name) &&
                            std::filesystem::is_regular_file(overlaid(overlay_, name), ignored);
  return from_overlay ? overlaid(overlay_, name).string() : fmt::format("glsl/{}", name);
}

void ShaderFiles::put(std::string name, std::string text) {
  generated_.insert_or_assign(std::move(name), std::move(text));
}

std::vector<std::string> ShaderFiles::built_in_names() {
  std::vector<std::string> names;
  for (const BuiltInFile& file : built_in_files()) names.emplace_back(file.name);
  return names;
}

ShaderSource load_shader_source(const ShaderFiles& files, std::string_view root, const std::vector<Define>& defines) {
  ShaderSource source;
  Loader(files, source).append(root, "");
  std::string head = "#version 450 core\n";
  std::size_t lines = 1;
  for (const Define& define : defines) {
    // Programs that differ in what another stage defines have a stage in common, which drivers' caches then find.
    if (!mentions(source.text, define.name)) continue;
    head += fmt::format("#define {} {}\n", define.name, define.value);
    ++lines;
  }
  source.text.insert(0, head);
  source.lines.insert(source.lines.begin(), lines, ShaderSource::Line());
  return source;
}

std::string translate_log(std::string_view driver_log, const ShaderSource& source) {
  std::string result, last, quote;  // `quote` is to follow the last message
  while (!driver_log.empty()) {
    const std::size_t end = std::min(driver_log.find('\n'), driver_log.size());
    const std::string_view line = trimmed(driver_log.substr(0, end));
    driver_log.remove_prefix(std::min(end + 1, driver_log.size()));
    if (line.empty() || line.front() == '\0') continue;
    const std::optional<Message> message = parse_message(line);
    const bool known = message && message->line >= 1 && message->line <= source.lines.size();
    const ShaderSource::Line place = known ? source.lines[message->line - 1] : ShaderSource::Line();
    const bool in_file = place.file != ShaderSource::no_file;
    std::string told = in_file ? fmt::format("{}:{}: {}", shown_name(source, place.file), place.number, message->text)
                               : std::string(line);
    if (told == last) continue;
    std::string next_quote = in_file ? quoted_line(source, message->line) : "";
    if (next_quote != quote) result += quote;
    quote = std::move(next_quote);
    if (!result.empty()) result += '\n';
    last = std::move(told);
    result += last;
  }
  return result + quote;
}

}  // namespace penumbra::gl
