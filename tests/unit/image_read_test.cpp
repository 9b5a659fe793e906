// Decoding of PNGs from memory, every pixel kind, and what is refused. (JPEGs come with the public scenes.)

#include <gtest/gtest.h>

#include "image/read.h"
#include "scene/gltf/resources.h"
#include "support/gltf_files.h"

namespace penumbra::test {
namespace {

const std::string rgba_1x2 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAACCAYAAACZgbYnAAAAEklEQVR42mM4kWLUwPD//38GABeHBNxbft1fAAAAAElFTkSuQmCC";
const std::string grey_2x1 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mNg/wUAAQsBAlT5jMQAAAAASUVORK5CYII=";
const std::string grey_alpha =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mOIkgMAANUAedmTmoIAAAAASUVORK5CYII=";
const std::string rgb_16_bit =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAIAAADA54+dAAAAD0lEQVR42mP4/7+hgZERAA5/AwEbKTRVAAAAAElFTkSuQmCC";
const std::string palette_2x1 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAMAAADD/I+4AAAABlBMVEUKFB4oMjzVG7TpAAAAAnRSTlP/Te3aDWcAAAALSURBVHjaY2BgBAAABAAC"
    "LN5IrQAAAABJRU5ErkJggg==";
const std::string grey_with_profile =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAABGdBTUEAAYagMeiWXwAAAA5pQ0NQeAAAanVua3Byb2ZpbGWBFjkDAAAADElEQVR4"
    "2mNISUkBAAJcAS1l5vf0AAAAAElFTkSuQmCC";

using Rgba = std::vector<uint8_t>;

scene::Image decode(std::vector<std::byte> bytes, std::size_t max_pixels = 100) {
  return image::read_image(bytes, "test.png", max_pixels);
}

scene::Image decode(const std::string& base64_text, std::size_t max_pixels = 100) {
  return decode(scene::gltf::base64_decoded(base64_text), max_pixels);
}

TEST(ImageRead, KeepsStraightAlphaAndRowsTopDown) {
  const scene::Image image = decode(rgba_1x2);
  EXPECT_EQ(image.width, 1);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.rgba, (Rgba{200, 100, 50, 128, 255, 255, 255, 0}));
}

TEST(ImageRead, WidensGreyAndPalettes) {
  EXPECT_EQ(decode(grey_2x1).rgba, (Rgba{7, 7, 7, 255, 250, 250, 250, 255}));
  EXPECT_EQ(decode(grey_alpha).rgba, (Rgba{90, 90, 90, 30}));
  EXPECT_EQ(decode(palette_2x1).rgba, (Rgba{10, 20, 30, 255, 40, 50, 60, 77}));
}

TEST(ImageRead, Reduces16Bits) { EXPECT_EQ(decode(rgb_16_bit).rgba, (Rgba{255, 128, 1, 255})); }

TEST(ImageRead, IgnoresColourSpaces) { EXPECT_EQ(decode(grey_with_profile).rgba, (Rgba{100, 100, 100, 255})); }

TEST(ImageRead, RefusesMorePixelsThanTheLimit) {
  EXPECT_NO_THROW(decode(rgba_1x2, 2));
  EXPECT_EQ(error_of([] { decode(rgba_1x2, 1); }), "1 x 2 pixels, over the limit of 1");
}

TEST(ImageRead, RefusesAHugeHeaderBeforeAllocating) {
  auto bytes = scene::gltf::base64_decoded(rgba_1x2);
  bytes[16] = bytes[20] = std::byte{0x7F};  // 2 billion pixels a side; the checksum gives it away first
  EXPECT_EQ(error_of([&] { decode(bytes); }), "PNG chunk IHDR is damaged");
}

TEST(ImageRead, RefusesDamage) {
  const auto whole = scene::gltf::base64_decoded(rgba_1x2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(decode(cut), Error) << size;
  }
  for (std::size_t i = 0; i < whole.size(); ++i) {
    auto flipped = whole;
    flipped[i] ^= std::byte{0x10};
    EXPECT_THROW(decode(flipped), Error) << i;
  }
}

TEST(ImageRead, RefusesOtherFormats) {
  EXPECT_EQ(error_of([] { decode(base64("GIF89a, and so on")); }), "neither PNG nor JPEG");
}

}  // namespace
}  // namespace penumbra::test
