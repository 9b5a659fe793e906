// Decoding PNGs and JPEGs from memory: every kind of pixels, refused files, and sizes from headers alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "image/bytes.h"
#include "image/precheck.h"
#include "image/probe.h"
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
  bytes[16] = bytes[20] = std::byte{0x7F};  // 2 billion pixels a side; the wrong checksum is found first
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

// A JPEG of 8 x 8 grey pixels, made of flat blocks, with `segments` after its first marker.
std::string jpeg_8x8(const std::string& segments = {}) {
  using namespace std::string_literals;
  std::string jpeg = "\xff\xd8"s;
  const auto add = [&jpeg](int marker, const std::string& head, const std::string& rest) {
    const std::size_t size = head.size() + rest.size() + 2;
    jpeg.append({'\xff', static_cast<char>(marker), static_cast<char>(size >> 8), static_cast<char>(size)});
    jpeg.append(head).append(rest);
  };
  std::string table(17, '\0');
  table[0] = 1;  // one code, of one bit, for the symbol 0
  jpeg.append(segments);
  add(0xDB, "\0"s, std::string(64, '\1'));
  add(0xC0, "\x08\0\x08\0\x08\1\1\x11\0"s, {});
  add(0xC4, "\0"s, table);
  add(0xC4, "\x10"s, table);
  add(0xDA, "\1\1\0\0\x3f\0"s, {});
  return jpeg.append("\x3f\xff\xd9"s);
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

TEST(ImageRead, ReadsJpegs) {
  const scene::Image image = decode(bytes_of(jpeg_8x8()));
  EXPECT_EQ(image.width, 8);
  EXPECT_EQ(image.height, 8);
  Rgba grey;
  for (int i = 0; i < 64; ++i) grey.insert(grey.end(), {128, 128, 128, 255});
  EXPECT_EQ(image.rgba, grey);
}

TEST(ImageRead, RefusesATruncatedJpeg) {
  const std::string whole = jpeg_8x8();
  for (const std::size_t cut : {1, 2, 3}) {  // the end marker, half of it, and the pixels
    EXPECT_EQ(error_of([&] { decode(bytes_of(whole.substr(0, whole.size() - cut))); }),
              "JPEG is truncated: it ends without an end marker")
        << cut;
  }
}

TEST(ImageRead, ReadsNoMetadataOfAJpeg) {
  using namespace std::string_literals;
  // Photoshop's resource 0x0404, IPTC, whose record claims to hold 64 KiB although the segment ends there: IPTC parsers
  // have read beyond it (found by the address sanitizer).
  const std::string record = "\x1c\x02\x78\x7f\xff"s;
  const std::string payload = "Photoshop 3.0\0008BIM\x04\x04\0\0\0\0\0\x05"s + record;
  const std::string hostile = "\xff\xed\0"s + static_cast<char>(payload.size() + 2) + payload;
  const auto whole = bytes_of(jpeg_8x8());
  const std::string comment = "\xff\xfe\0\x06text"s, exif =
                                                         "\xff\xe1\0\x0a"
                                                         "Exif\0\0MM"s;
  EXPECT_EQ(image::pixel_segments_of_jpeg(bytes_of(jpeg_8x8(hostile + comment + exif) + hostile)), whole);
  EXPECT_EQ(image::pixel_segments_of_jpeg(whole), whole);
  EXPECT_EQ(decode(bytes_of(jpeg_8x8(hostile))).rgba, decode(whole).rgba);
}

TEST(ImageRead, RefusesTooManyScans) {
  std::string many = jpeg_8x8();
  const std::size_t scan = many.find("\xff\xda");
  const std::string one = many.substr(scan, many.size() - 2 - scan);
  for (int i = 0; i < 100; ++i) many.insert(scan, one);
  EXPECT_EQ(error_of([&] { decode(bytes_of(many)); }), "JPEG of more than 100 scans");
}

TEST(ImageProbe, TellsSizesWithoutDecoding) {
  const auto probed = [](std::vector<std::byte> bytes, std::size_t size) {
    bytes.resize(size);  // the header alone
    const scene::ImageHeader header = image::probe(bytes);
    return std::vector<std::size_t>{static_cast<std::size_t>(header.width), static_cast<std::size_t>(header.height),
                                    static_cast<std::size_t>(header.channels), header.decoded_bytes};
  };
  EXPECT_EQ(probed(scene::gltf::base64_decoded(rgba_1x2), 33), (std::vector<std::size_t>{1, 2, 4, 8}));
  EXPECT_EQ(probed(scene::gltf::base64_decoded(grey_alpha), 33), (std::vector<std::size_t>{1, 1, 2, 4}));
  EXPECT_EQ(probed(scene::gltf::base64_decoded(palette_2x1), 33), (std::vector<std::size_t>{2, 1, 3, 8}));
  const std::string jpeg = jpeg_8x8();
  EXPECT_EQ(probed(bytes_of(jpeg), jpeg.find("\xff\xc4")), (std::vector<std::size_t>{8, 8, 1, 256}));
}

TEST(ImageProbe, RefusesWhatHasNoSize) {
  const auto png = scene::gltf::base64_decoded(rgba_1x2), jpeg = bytes_of(jpeg_8x8());
  const auto header_end = static_cast<std::ptrdiff_t>(jpeg_8x8().find("\xff\xc4"));
  for (std::ptrdiff_t size = 0; size < 33; ++size)
    EXPECT_THROW(image::probe(std::vector<std::byte>(png.begin(), png.begin() + size)), Error) << size;
  for (std::ptrdiff_t size = 0; size < header_end; ++size)
    EXPECT_THROW(image::probe(std::vector<std::byte>(jpeg.begin(), jpeg.begin() + size)), Error) << size;
  auto flat = png;
  flat[19] = std::byte{0};
  EXPECT_EQ(error_of([&] { image::probe(flat); }), "an image without pixels");
  EXPECT_EQ(error_of([] { image::probe(bytes_of("GIF89a, and so on")); }), "neither PNG nor JPEG");
}

// A JPEG with so many segments of 64 KiB before its header, whose contents no memory holds; counts the bytes that are
// read of it.
struct SegmentedJpeg {
  std::size_t segments = 0;
  std::size_t read = 0;

  scene::ReadAt reader() {
    return [this](std::size_t offset, std::span<std::byte> to) {
      const std::string frame = jpeg_8x8().substr(jpeg_8x8().find("\xff\xc0"));
      const std::size_t end = 2 + segments * 65537 + frame.size();
      const std::size_t count = std::min(to.size(), end - std::min(offset, end));
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::byte>(at(offset + i, frame));
      read += count;
      return count;
    };
  }
  char at(std::size_t i, const std::string& frame) const {
    if (i < 2) return "\xff\xd8"[i];
    const std::size_t in_segments = i - 2;
    if (in_segments >= segments * 65537) return frame[in_segments - segments * 65537];
    constexpr std::string_view head = "\xff\xe2\xff\xff";
    return in_segments % 65537 < head.size() ? head[in_segments % 65537] : 'x';
  }
};

TEST(ImageProbe, SkipsWhatLiesBeforeAJpegsHeader) {
  SegmentedJpeg jpeg{.segments = 10'000};  // 625 MiB
  const scene::ImageHeader header = image::probe(jpeg.reader());
  EXPECT_EQ(header.width, 8);
  EXPECT_EQ(header.height, 8);
  EXPECT_LT(jpeg.read, 8u << 20);
}

TEST(ImageProbe, GivesUpOnAHeaderThatIsTooFarAway) {
  SegmentedJpeg segments{.segments = 1 << 20};
  EXPECT_EQ(error_of([&] { image::probe(segments.reader()); }), "JPEG has too much before its header");
  EXPECT_LT(segments.read, 33u << 20);
  std::size_t read = 0;
  const scene::ReadAt endless = [&](std::size_t offset, std::span<std::byte> to) {
    std::ranges::fill(to, std::byte{0});
    if (offset == 0) std::ranges::copy(bytes_of("\xff\xd8\xff"), to.begin());
    read += to.size();
    return to.size();
  };
  EXPECT_EQ(error_of([&] { image::probe(endless); }), "JPEG has too much before its header");
  EXPECT_LT(read, 33u << 20);
}

// The checksum of a PNG's chunk, bit by bit (PNG specification, annex D).
std::uint32_t checksum(std::span<const std::byte> bytes) {
  std::uint32_t crc = ~0u;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xEDB88320u ^ crc >> 1 : crc >> 1;
  }
  return ~crc;
}

// Corrects every chunk's checksum, so that the damage reaches the decoder.
void mend_checksums(std::vector<std::byte>& png) {
  const auto number = [&](std::size_t at) { return image::big_endian(png, at, 4); };
  for (std::size_t at = 8; at + 12 <= png.size() && number(at) <= png.size() - at - 12; at += number(at) + 12) {
    const std::size_t end = at + 8 + number(at);
    const std::uint32_t crc = checksum(std::span(png).subspan(at + 4, end - at - 4));
    for (std::size_t i = 0; i < 4; ++i) png[end + i] = static_cast<std::byte>(crc >> (24 - 8 * i) & 0xFF);
  }
}

TEST(ImageRead, PrintsNothingAboutDamage) {
  std::size_t refused = 0;
  const auto try_to_decode = [&](std::vector<std::byte> bytes) {
    if (image::starts_with(bytes, image::png_signature)) mend_checksums(bytes);
    try {
      decode(std::move(bytes));
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  };
  testing::internal::CaptureStderr();  // of the whole process, libraries included
  for (const std::vector<std::byte>& whole :
       {scene::gltf::base64_decoded(rgba_1x2), scene::gltf::base64_decoded(palette_2x1),
        scene::gltf::base64_decoded(rgb_16_bit), bytes_of(jpeg_8x8())}) {
    for (std::size_t i = 8; i < whole.size(); ++i) {
      for (const std::byte flip : {std::byte{0x01}, std::byte{0x10}, std::byte{0xff}}) {
        std::vector<std::byte> flipped = whole;
        flipped[i] ^= flip;
        try_to_decode(flipped);
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(refused, 100u);
}

TEST(ImageRead, RefusesOtherFormats) {
  EXPECT_EQ(error_of([] { decode(base64("GIF89a, and so on")); }), "neither PNG nor JPEG");
}

}  // namespace
}  // namespace penumbra::test
