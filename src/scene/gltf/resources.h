#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::scene::gltf {

// %20 and the like become bytes; anything that is not such an escape stays.
std::string percent_decoded(std::string_view text);

// Strict: throws Error on a character outside the alphabet or a wrong length.
std::vector<std::byte> base64_decoded(std::string_view text);

bool is_data_uri(std::string_view uri);

// What a URI of the scene stands for: a base64 data URI's bytes, or those of a file. Files must be regular and lie,
// links followed, inside `folder`; other schemes are refused: a scene can't make the reader touch anything else.
std::vector<std::byte> load_uri(const std::filesystem::path& folder, std::string_view uri, std::size_t limit);

}  // namespace penumbra::scene::gltf
