#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::cli {

// The files of one command, from -o. A sequence numbers them: at "####" or "%04d" in the file's name, else "_0001"
// before the extension. A single picture has no number, so a name with a place for one is refused.
class OutputNames {
 public:
  // Throws UsageError for an extension other than .png and .exr and for a bad pattern.
  OutputNames(const std::string& output, bool sequence);

  bool is_exr() const { return extension_ == ".exr"; }
  std::filesystem::path picture(int frame) const;
  // The number in the name of a file, without its folder; absent where it can't be a frame's, 0 without numbers.
  std::optional<int> frame_of(std::string_view file) const;
  // "x.shadow.png" beside "x.png".
  std::filesystem::path aov(int frame, std::string_view name) const;

 private:
  std::string before_, after_, extension_;  // of the number
  int digits_ = -1;                         // -1: not numbered
};

// Where an option writes its text: "-" is standard output, "./-" a file of that name.
std::string text_output(const std::string& text);

// The folder that an option names. Throws UsageError for "-", which looks like standard output.
std::string output_folder(std::string_view option, const std::string& text);

}  // namespace penumbra::cli
