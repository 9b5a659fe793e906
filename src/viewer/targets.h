#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gl/pass.h"
#include "viewer/inspect.h"

namespace penumbra::viewer {

struct LoadedScene;

// The textures that passes draw to, for inspection: the intermediate results of a frame.

// Whether Inspection::what names one.
bool is_target(std::string_view what);
// The name that a texture of view 0 has in another view; other names stay as they are.
std::string target_of_view(std::string_view what, int view);
// Whether a texture is of a view, and not of view 0.
bool is_of_other_view(std::string_view name);

// One of the values of a texel: a field of a packed one, or a channel.
struct TargetPart {
  std::string name;
  ColorMapping mapping;
};
std::vector<TargetPart> parts_of(const gl::Device::NamedTarget& target);

// The name as it is listed: without the numbers of instances and views that there is only one of, and with the name of
// the light in place of its number, where several cast shadows. `scene`: absent until one is loaded.
std::string target_label(std::string_view name, const LoadedScene* scene);
// The inspected part's index.
std::size_t part_index(const std::vector<TargetPart>& parts, const Inspection& inspection);

// What a texture of the shadow library holds, in a sentence; empty for others.
std::string about_target(std::string_view name);

// The texture that Inspection::what names, if it exists.
std::optional<gl::Device::NamedTarget> inspected_target(const Inspection& inspection, const gl::Device& device);

// The title of the legend: "depth", "denoisers/history_and_filters/texels: visibility".
std::string title_of(const Inspection& inspection, const gl::Device& device, const LoadedScene* scene);

// Throws Error for an unknown name.
Values read_target(const Inspection& inspection, const gl::Device& device);

}  // namespace penumbra::viewer
