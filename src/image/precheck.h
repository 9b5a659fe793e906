#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// Throws Error for a picture of more than `max_pixels`. Sides are at least 1.
void check_pixels(std::int64_t width, std::int64_t height, std::size_t max_pixels);

// A copy of a PNG without the chunks that do not affect pixels: textures don't need text and profiles, which may be
// compressed data that expand without bound. Throws Error if a chunk's length or checksum is wrong.
std::vector<std::byte> pixel_chunks_of_png(std::span<const std::byte> encoded);

// A copy of a JPEG without the segments that do not affect pixels: textures don't need EXIF, IPTC, profiles, thumbnails
// and comments, and metadata parsers have read past the end of malicious ones. Data after the image's end is removed
// too. Throws Error if the file ends before its end marker, or has more than a generous number of scans: a progressive
// JPEG is decoded completely once per scan, so a malicious file could stall a reader with many scans.
std::vector<std::byte> pixel_segments_of_jpeg(std::span<const std::byte> encoded);

// Checks the header of an EXR before anything is allocated for it. Throws Error for a header that is truncated or
// contradicts itself; for more than `max_pixels`, 16 times as many values, 32768 pixels a side or 2^20 values a line;
// for tiles of more than 2^24 values that are larger than the picture; and for unsupported kinds: several parts, deep
// data, and subsampled channels.
void check_exr_header(std::span<const std::byte> encoded, std::size_t max_pixels);

}  // namespace penumbra::image
