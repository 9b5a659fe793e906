#include "app/output_names.h"

#include <algorithm>
#include <cctype>

#include "app/usage.h"

namespace penumbra::app {

namespace {

// Where in a file's stem the number goes.
struct Pattern {
  std::size_t begin = std::string::npos, end = std::string::npos;
  int digits = 4;
  bool found() const { return begin != std::string::npos; }
};

Pattern find_hashes(const std::string& stem) {
  Pattern pattern;
  pattern.begin = stem.find('#');
  if (!pattern.found()) return pattern;
  pattern.end = std::min(stem.find_first_not_of('#', pattern.begin), stem.size());
  pattern.digits = static_cast<int>(pattern.end - pattern.begin);
  return pattern;
}

Pattern find_percent(const std::string& stem) {
  Pattern pattern;
  pattern.begin = stem.find('%');
  if (!pattern.found()) return pattern;
  pattern.digits = 1;
  std::size_t at = pattern.begin + 1;
  if (at + 1 < stem.size() && stem[at] == '0' && std::isdigit(static_cast<unsigned char>(stem[at + 1])) != 0) {
    pattern.digits = stem[at + 1] - '0';
    at += 2;
  }
  if (at >= stem.size() || stem[at] != 'd' || stem.find('%', at) != std::string::npos)
    fail_usage("'{}' is no file pattern: it takes one %d or %04d", stem);
  pattern.end = at + 1;
  return pattern;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace

OutputNames::OutputNames(const std::string& output, bool sequence) {
  const std::filesystem::path path(output);
  extension_ = lower(path.extension().string());
  if (extension_ != ".png" && extension_ != ".exr")
    fail_usage("'{}' is not a kind of picture that can be written: use .png or .exr", output);
  const std::string stem = path.stem().string();
  const std::string folder = (path.parent_path() / "").string();
  after_ = path.extension().string();
  before_ = folder + stem;
  if (!sequence) return;

  Pattern pattern = find_percent(stem);
  if (!pattern.found()) pattern = find_hashes(stem);
  digits_ = pattern.digits;
  if (!pattern.found()) {
    before_ += "_";
    return;
  }
  before_ = folder + stem.substr(0, pattern.begin);
  after_ = stem.substr(pattern.end) + after_;
}

std::filesystem::path OutputNames::picture(int frame) const {
  if (digits_ < 0) return before_ + after_;
  return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::filesystem::path OutputNames::aov(int frame, std::string_view name) const {
  std::filesystem::path path = picture(frame);
  const std::string extension = path.extension().string();
  return path.replace_extension("." + std::string(name) + extension);
}

}  // namespace penumbra::app
