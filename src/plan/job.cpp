#include "plan/job.h"

#include <algorithm>

#include "core/log.h"

namespace penumbra::plan {

io::Json json_of(const std::vector<cli::GivenOption>& options, std::initializer_list<std::string_view> except) {
  io::Json json = io::Json::object();
  for (const cli::GivenOption& option : options) {
    if (std::ranges::find(except, option.name) == except.end()) json[option.name] = option.values;
  }
  return json;
}

void DeviceCheck::add(const std::string& device) {
  if (count_++ == 0) first_ = device;
  if (device == first_) return;
  if (others_++ == 0) other_ = device;
}

void DeviceCheck::warn() const {
  if (others_ == 0) return;
  penumbra::warn(
      "{} of {} results were drawn by other devices than the first ('{}'), such as '{}': pictures of "
      "different devices can differ",
      others_, count_, first_, other_);
}

io::Key key_of(const Program& program, const std::string& command, const io::Json& depends, const PlannedScene& scene) {
  io::Hasher hasher;
  const auto add = [&hasher](const std::string& text) {
    hasher.add(std::to_string(text.size()) + ":");  // so that no two lists of texts are the same bytes
    hasher.add(text);
  };
  add(program.build.text());
  add(command);
  add(depends.dump(-1, ' ', false, io::Json::error_handler_t::replace));
  for (const PlannedFile& file : scene.files) {
    add(file.hash.text());
    add(file.shader);
  }
  return hasher.key();
}

}  // namespace penumbra::plan
