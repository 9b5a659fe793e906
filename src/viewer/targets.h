#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gl/pass.h"
#include "viewer/inspect.h"

namespace penumbra::viewer {

// The textures that passes draw to, as they can be looked at: what lies between two steps of a frame.

// Whether Inspection::what names one.
bool is_target(std::string_view what);
// The list names textures of the first view: that of another one which is the same there.
std::string target_of_view(std::string_view what, int view);

// What a texel says, of which one is looked at: fields of a packed one, or channels.
struct TargetPart {
  std::string name;
  Look look;
};
std::vector<TargetPart> parts_of(const gl::Device::NamedTarget& target);

// Its name as it is listed: without the library's own numbers of what is there once.
std::string target_label(std::string_view name);
// The one that is looked at.
std::size_t part_index(const std::vector<TargetPart>& parts, const Inspection& inspection);

// What a texture of the shadow library holds, in a sentence; empty for others, whose name says it.
std::string about_target(std::string_view name);

// The one that Inspection::what names, if there is one.
std::optional<gl::Device::NamedTarget> inspected_target(const Inspection& inspection, const gl::Device& device);

// What is inspected, for a legend: "depth", "denoise/texels: visibility".
std::string title_of(const Inspection& inspection, const gl::Device& device);

// Throws Error for names that there are none of.
Values read_target(const Inspection& inspection, const gl::Device& device);

}  // namespace penumbra::viewer
