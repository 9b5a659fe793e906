#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf.h"

namespace penumbra::scene::gltf {

// %20 and the like become bytes; anything that is not such an escape stays.
std::string percent_decoded(std::string_view text);

// Strict: throws Error on a character outside the alphabet or a wrong length.
std::vector<std::byte> base64_decoded(std::string_view text);

bool is_data_uri(std::string_view uri);

// The data of a data URI (RFC 2397), in base64 or percent-encoded.
std::vector<std::byte> data_uri_bytes(std::string_view uri);

// A file's bytes. Throws Error for more than the limit of files.
std::vector<std::byte> load_file(const std::filesystem::path& file, const ReadLimits& limits);

// What a URI of the scene stands for: a data URI's bytes, or those of a file. Files must be regular and lie, links
// followed, inside `folder`; other schemes are refused: a scene can't make the reader touch anything else. With
// `follow_links` a file's name must lie inside, and links lead where they lead.
std::vector<std::byte> load_uri(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options);

}  // namespace penumbra::scene::gltf
