#include "metrics/image_view.h"

#include <cmath>

#include "core/error.h"

namespace penumbra::metrics {

float signed_error(float test, float reference) {
  if (std::isfinite(test)) return test - reference;
  return reference <= 0.5f ? 1.0f : -1.0f;
}

void check(const ImageView& test, const ImageView& reference, Receivers receivers) {
  if (test.width != reference.width || test.height != reference.height)
    fail("the pictures differ in size: {} x {} and {} x {} pixels", test.width, test.height, reference.width,
         reference.height);
  if (test.channels != reference.channels)
    fail("the pictures differ in channels: {} and {}", test.channels, reference.channels);
  const std::size_t pixels = reference.pixel_count(), channels = static_cast<std::size_t>(reference.channels);
  for (const ImageView& picture : {test, reference}) {
    if (picture.pixels.size() != pixels * channels)
      fail("a picture of {} x {} pixels with {} channels has {} values", picture.width, picture.height,
           picture.channels, picture.pixels.size());
  }
  if (!receivers.empty() && receivers.size() != pixels)
    fail("{} receivers for a picture of {} x {} pixels", receivers.size(), reference.width, reference.height);
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    if (std::isfinite(reference.pixels[i]) || !is_receiver(receivers, i / channels)) continue;
    const std::size_t pixel = i / channels, width = static_cast<std::size_t>(reference.width);
    fail("the reference is not finite at pixel {},{}", pixel % width, pixel / width);
  }
}

}  // namespace penumbra::metrics
