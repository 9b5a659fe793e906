#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf.h"

namespace penumbra::scene::gltf {

// Decodes percent escapes such as %20; anything that is not such an escape stays unchanged.
std::string percent_decoded(std::string_view text);

// The file below the folder that a relative URI names, also where there is none: percent-decoded as the standard says,
// or by the name as it is written, as many exporters mean it, if only that exists. nullopt for what load_uri() refuses
// to open whether it exists or not, and for a name that can't be looked up.
std::optional<std::filesystem::path> named_file(const std::filesystem::path& folder, std::string_view uri,
                                                bool follow_links);

// Decodes base64. Throws Error for a character outside the alphabet or a wrong length.
std::vector<std::byte> base64_decoded(std::string_view text);

bool is_data_uri(std::string_view uri);

// The data of a data URI (RFC 2397), in base64 or percent-encoded.
std::vector<std::byte> data_uri_bytes(std::string_view uri);

// A file's bytes. Throws Error if the file is larger than the limit.
std::vector<std::byte> load_file(const std::filesystem::path& file, const ReadLimits& limits);

// Reads parts of a file, on request. Throws Error if the file is larger than the limit.
ReadAt open_file(const std::filesystem::path& file, const ReadLimits& limits);

// The bytes that a URI of the scene refers to: a data URI's, or those of a file. A file must be regular and, after
// following links, lie inside `folder`, and other schemes are refused, so that a scene can't make the reader open
// anything else. With `follow_links` only the file's name must lie inside; links may lead anywhere.
std::vector<std::byte> load_uri(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options);
// The file that these bytes lie in, with links resolved, so that it is the same for all names of it; empty for a data
// URI.
std::filesystem::path file_of_uri(const std::filesystem::path& folder, std::string_view uri,
                                  const ReadOptions& options);
// The same as load_uri(), without reading the file before the result is called.
ReadAt open_uri(const std::filesystem::path& folder, std::string_view uri, const ReadOptions& options);

}  // namespace penumbra::scene::gltf
