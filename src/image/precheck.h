#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// Throws Error for a picture of more than `max_pixels`. Sides are at least 1.
void check_pixels(std::int64_t width, std::int64_t height, std::size_t max_pixels);

// A PNG without the chunks that don't carry pixels: text and profiles are of no use to a texture, and may be compressed
// data that expand without bound. Throws Error when a chunk's length or checksum is wrong.
std::vector<std::byte> pixel_chunks_of_png(std::span<const std::byte> encoded);

// A JPEG without the segments that don't carry pixels: EXIF, IPTC, profiles, thumbnails and comments are of no use to a
// texture, and parsers of metadata read hostile ones past their end. What follows the image's end goes too. Throws
// Error when the file ends inside a segment, and past a generous number of scans: a progressive JPEG decodes the whole
// picture once a scan, so many are a way to stall a reader.
std::vector<std::byte> pixel_segments_of_jpeg(std::span<const std::byte> encoded);

// What an EXR says of itself before anything is allocated for it. Throws Error for a header that is cut or contradicts
// itself; for more than `max_pixels`, 16 times as many values, 32768 pixels a side or 2^20 values a line; and for kinds
// that are not read: several parts, deep data, and channels of fewer pixels than the picture.
void check_exr_header(std::span<const std::byte> encoded, std::size_t max_pixels);

}  // namespace penumbra::image
