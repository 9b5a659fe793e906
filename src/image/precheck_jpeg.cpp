#include <cstdint>

#include "core/error.h"
#include "image/bytes.h"
#include "image/jpeg_segments.h"
#include "image/precheck.h"

namespace penumbra::image {
namespace {

constexpr std::size_t most_scans = 100;

// Whether a segment is needed to decode pixels: tables, frame headers and scans, and the two application segments that
// define how colours are stored, JFIF's and Adobe's. All other application segments are metadata: EXIF, IPTC, profiles,
// thumbnails, comments.
bool carries_pixels(const JpegSegment& segment) {
  switch (segment.marker) {
    case jpeg::start_of_image:
    case jpeg::end_of_image:
    case jpeg::start_of_scan:
    case jpeg::quantization:
    case jpeg::huffman:
    case jpeg::arithmetic:
    case jpeg::restart_interval:
      return true;
    case jpeg::app0:
      return starts_with(segment.payload, "JFIF");
    case jpeg::app14:
      return starts_with(segment.payload, "Adobe");
    default:
      return jpeg::is_frame_header(segment.marker);
  }
}

}  // namespace

std::vector<std::byte> pixel_segments_of_jpeg(std::span<const std::byte> encoded) {
  std::vector<std::byte> kept;
  kept.reserve(encoded.size());
  JpegSegments segments(encoded);
  std::size_t scans = 0;
  bool ended = false;
  for (JpegSegment segment = segments.next(); !segment.bytes.empty(); segment = segments.next()) {
    if (carries_pixels(segment)) kept.insert(kept.end(), segment.bytes.begin(), segment.bytes.end());
    ended = segment.marker == jpeg::end_of_image;
    if (ended) break;
    if (segment.marker != jpeg::start_of_scan) continue;
    if (++scans > most_scans) fail("JPEG of more than {} scans", most_scans);
    const std::span<const std::byte> data = segments.scan_data();
    kept.insert(kept.end(), data.begin(), data.end());
  }
  // OpenImageIO would fill the missing part with grey.
  if (!ended) fail("JPEG is truncated: it ends without an end marker");
  return kept;
}

}  // namespace penumbra::image
