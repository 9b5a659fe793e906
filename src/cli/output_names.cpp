#include "cli/output_names.h"

#include <algorithm>
#include <charconv>
#include <regex>
#include <vector>

#include "cli/usage.h"
#include "core/names.h"

namespace penumbra::cli {

namespace {

// Where in a file's stem the number goes.
struct Place {
  std::size_t begin, end;
  int digits;
};

std::vector<Place> places_in(const std::string& stem) {
  // Each number sign alone: std::regex takes stack for each character of a run.
  static const std::regex pattern("#|%(?:0([1-9]))?d");
  std::vector<Place> places;
  for (std::sregex_iterator match(stem.begin(), stem.end(), pattern), none; match != none; ++match) {
    const auto begin = static_cast<std::size_t>(match->position());
    const std::size_t end = begin + static_cast<std::size_t>(match->length());
    const bool is_hash = stem[begin] == '#';
    if (is_hash && !places.empty() && places.back().end == begin && stem[places.back().begin] == '#') {
      places.back().end = end;
      ++places.back().digits;
      continue;
    }
    const int digits = is_hash || !(*match)[1].matched ? 1 : stem[begin + 2] - '0';
    places.push_back({begin, end, digits});
  }
  return places;
}

}  // namespace

OutputNames::OutputNames(const std::string& output, bool sequence) {
  const std::filesystem::path path(output);
  extension_ = lower_case(path.extension().string());
  if (extension_ != ".png" && extension_ != ".exr")
    fail_usage("'{}' is not a kind of picture that can be written: use .png or .exr", output);
  const std::string stem = path.stem().string();
  const std::string folder = (path.parent_path() / "").string();
  after_ = path.extension().string();
  before_ = folder + stem;

  const std::vector<Place> places = places_in(stem);
  if (!sequence) {
    // A single # may belong to the name.
    if (std::ranges::any_of(places, [&](const Place& at) { return stem[at.begin] == '%' || at.digits > 1; }))
      fail_usage("-o '{}' has a place for a frame's number, which needs --frames", output);
    return;
  }
  if (places.empty() && stem.find('%') == std::string::npos) {
    digits_ = 4;
    before_ += "_";
    return;
  }
  if (places.size() != 1 || std::ranges::count(stem, '%') > (stem[places[0].begin] == '%' ? 1 : 0))
    fail_usage("-o '{}' is no file pattern: the frame's number goes to one place, #### or %04d", output);
  digits_ = places[0].digits;
  before_ = folder + stem.substr(0, places[0].begin);
  after_ = stem.substr(places[0].end) + after_;
}

std::filesystem::path OutputNames::picture(int frame) const {
  if (digits_ < 0) return before_ + after_;
  return fmt::format("{}{:0{}}{}", before_, frame, digits_, after_);
}

std::optional<int> OutputNames::frame_of(std::string_view file) const {
  if (digits_ < 0) return 0;
  const std::string before = std::filesystem::path(before_).filename().string();
  if (!file.starts_with(before)) return {};
  file.remove_prefix(before.size());
  int frame = 0;
  const auto [end, error] = std::from_chars(file.data(), file.data() + file.size(), frame);
  if (error != std::errc() || frame < 0) return {};
  return frame;
}

std::filesystem::path OutputNames::aov(int frame, std::string_view name) const {
  std::filesystem::path path = picture(frame);
  const std::string extension = path.extension().string();
  return path.replace_extension(fmt::format(".{}{}", name, extension));
}

std::string text_output(const std::string& text) { return text == "-" ? "/dev/stdout" : text; }

std::string output_folder(std::string_view option, const std::string& text) {
  if (text == "-") fail_usage("{}: '-' would be standard output, not a folder; './-' is a folder of that name", option);
  return text;
}

}  // namespace penumbra::cli
