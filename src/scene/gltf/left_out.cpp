#include "scene/gltf/left_out.h"

#include "core/error.h"
#include "core/log.h"
#include "scene/one_line.h"

namespace penumbra::scene::gltf {
namespace {

constexpr std::size_t most_warnings = 8;

std::string place_of(std::string_view array, std::size_t index) {
  return fmt::format("{}[{}]", array == lights_array ? "lights" : array, index);
}

}  // namespace

bool LeftOut::holds(std::string_view array, std::size_t index) const {
  return !elements_.empty() && elements_.contains(std::pair(std::string(array), index));
}

void LeftOut::add(std::string_view array, std::size_t index, std::string_view cause) {
  if (holds(array, index)) return;
  // Messages of the schema already begin with the place.
  const bool placed = cause.starts_with(fmt::format("{}[{}]", array, index));
  add_part(placed ? "" : place_of(array, index), used_.holds(array, index), cause);
  elements_.emplace(array, index);
}

void LeftOut::add_part(const std::string& place, bool used, std::string_view cause) {
  const std::string fault = fmt::format("{}{}{}", place, place.empty() ? "" : ": ", cause);
  if (used) fail("{}", fault);
  if (count_++ < most_warnings)
    warn("{}: {}", file_, one_line(fault + "; left out, since nothing that is drawn uses it"));
}

void LeftOut::finish() {
  if (count_ > most_warnings)
    warn("{}: {} more parts are left out for their faults, since nothing that is drawn uses them", file_,
         count_ - most_warnings);
  count_ = 0;
}

}  // namespace penumbra::scene::gltf
