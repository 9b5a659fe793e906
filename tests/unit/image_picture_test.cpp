// Reading PNG and EXR files as values: layers, alpha, and damaged files.

#include "image/picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "image/write.h"
#include "support/gltf_files.h"

namespace penumbra::image {
namespace {

namespace fs = std::filesystem;
using test::error_of;

class ImagePicture : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("image_picture_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path exr(const std::vector<Layer>& layers) const {
    write_exr(folder_ / "x.exr", 2, 1, layers);
    return folder_ / "x.exr";
  }
  fs::path png(int channels, const std::vector<std::uint8_t>& pixels) const {
    write_png(folder_ / "x.png", 2, 1, channels, pixels);
    return folder_ / "x.png";
  }
  fs::path file(const std::string& bytes) const {
    std::ofstream(folder_ / "file", std::ios::binary) << bytes;
    return folder_ / "file";
  }
  fs::path folder_;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

using Floats = std::vector<float>;
using Names = std::vector<std::string>;

TEST_F(ImagePicture, ReadsTheLayersOfAnExr) {
  const Floats color{0.1f, 2.0f, 1e6f, -1.0f, 0.0f, std::numeric_limits<float>::infinity()}, shadow{0.25f, 0.5f};
  const fs::path path =
      exr({{"", {"R", "G", "B"}, color}, {"shadow", {"V"}, shadow}, {"a.b", {"X", "Y"}, {1, 2, 3, 4}}});
  const Picture unnamed = read_picture(path);
  EXPECT_EQ(unnamed.pixels, color);
  EXPECT_EQ(unnamed.channels, (Names{"R", "G", "B"}));
  EXPECT_FALSE(unnamed.display);
  EXPECT_EQ(unnamed.width, 2);
  EXPECT_EQ(unnamed.height, 1);
  EXPECT_EQ(read_picture(path, "shadow").pixels, shadow);
  EXPECT_EQ(read_picture(path, "a.b").pixels, (Floats{1, 2, 3, 4}));
  EXPECT_EQ(error_of([&] { read_picture(path, "shadwo"); }),
            "cannot read '" + path.string() + "': unknown layer 'shadwo'; did you mean 'shadow'?");
}

TEST_F(ImagePicture, TakesTheOnlyLayerAndAsksWhichOfMany) {
  EXPECT_EQ(read_picture(exr({{"truth", {"V"}, {0.5f, 1}}})).layer, "truth");
  const fs::path two = exr({{"a", {"V"}, {0.5f, 1}}, {"b", {"V"}, {0.5f, 1}}});
  EXPECT_TRUE(error_of([&] { read_picture(two); }).ends_with("name one of its layers: a, b"));
}

TEST_F(ImagePicture, TakesTheColourOfColourAndDepth) {
  const fs::path path = exr({{"", {"R", "G", "B", "Z"}, {1, 2, 3, 40, 5, 6, 7, 80}}});
  EXPECT_EQ(read_picture(path).pixels, (Floats{1, 2, 3, 5, 6, 7}));
}

TEST_F(ImagePicture, DropsAlphaWhereItIsOneAndRefusesItElse) {
  EXPECT_EQ(read_picture(png(4, {10, 20, 30, 255, 40, 50, 60, 255})).channels, (Names{"R", "G", "B"}));
  const std::string refusal = "it is not opaque: alpha is not 1 everywhere";
  EXPECT_TRUE(error_of([&] { read_picture(png(4, {10, 20, 30, 255, 40, 50, 60, 254})); }).ends_with(refusal));
  EXPECT_EQ(read_picture(exr({{"s", {"A", "V"}, {1, 0.5f, 1, 0.25f}}})).pixels, (Floats{0.5f, 0.25f}));
  EXPECT_TRUE(error_of([&] { read_picture(exr({{"s", {"A", "V"}, {0, 0.5f, 1, 0.25f}}})); }).ends_with(refusal));
}

TEST_F(ImagePicture, ReadsPngsAsDisplayValues) {
  const Picture grey = read_picture(png(1, {51, 255}));
  EXPECT_TRUE(grey.display);
  ASSERT_EQ(grey.pixels.size(), 2u);
  EXPECT_FLOAT_EQ(grey.pixels[0], 0.2f);
  EXPECT_FLOAT_EQ(grey.pixels[1], 1.0f);
  EXPECT_EQ(read_picture(png(3, {1, 2, 3, 4, 5, 6})).pixels.size(), 6u);
  EXPECT_TRUE(error_of([&] {
                read_picture(png(1, {1, 2}), "shadow");
              }).ends_with("a PNG has no layers, so no 'shadow'"));
}

TEST_F(ImagePicture, RefusesMorePixelsThanTheLimit) {
  for (const fs::path& path : {png(1, {1, 2}), exr({{"", {"Y"}, {1, 2}}})}) {
    EXPECT_NO_THROW(read_picture(path, "", 2));
    EXPECT_TRUE(error_of([&] { read_picture(path, "", 1); }).ends_with("2 x 1 pixels, over the limit of 1")) << path;
  }
}

TEST_F(ImagePicture, RefusesWhatIsNoPicture) {
  EXPECT_TRUE(error_of([&] { read_picture(folder_ / "no.png"); }).ends_with("file not found"));
  EXPECT_TRUE(error_of([&] { read_picture(folder_); }).ends_with("not a regular file"));
  EXPECT_TRUE(error_of([&] { read_picture(file("")); }).ends_with("the file is empty"));
  EXPECT_TRUE(error_of([&] { read_picture(file("\xff\xd8\xff\xe0")); }).ends_with("neither PNG nor EXR"));
}

TEST_F(ImagePicture, SurvivesDamage) {
  const std::string shadow = bytes_of(exr({{"", {"R", "G", "B"}, {1, 2, 3, 4, 5, 6}}, {"shadow", {"V"}, {0.5f, 1}}}));
  for (const std::string& whole : {shadow, bytes_of(png(3, {1, 2, 3, 4, 5, 6}))}) {
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_THROW(read_picture(file(whole.substr(0, size))), Error) << size;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      for (const char flip : {'\x01', '\x10', '\x7f', '\xff'}) {
        std::string flipped = whole;
        flipped[i] = static_cast<char>(flipped[i] ^ flip);
        try {
          read_picture(file(flipped));
        } catch (const Error& error) {
          EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::image
