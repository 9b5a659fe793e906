#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/viewer/inspect.h"
#include "gl/pass.h"

namespace penumbra::app {

// The textures that passes draw to, as they can be looked at: what lies between two steps of a frame.

// What a texel says, of which one is looked at: fields of a packed one, or channels.
struct TargetPart {
  std::string name;
  Look look;
};
std::vector<TargetPart> parts_of(const gl::Device::NamedTarget& target);

// What a texture of the shadow library holds, in a sentence; empty for others, whose name says it.
std::string about_target(std::string_view name);

// The one that Inspection::what names, if there is one.
std::optional<gl::Device::NamedTarget> inspected_target(const Inspection& inspection, const gl::Device& device);

// Throws Error for names that there are none of.
Values read_target(const Inspection& inspection, const gl::Device& device);

}  // namespace penumbra::app
