#include "image/write.h"

#include <gtest/gtest.h>
#include <unistd.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "image/picture.h"

namespace {

namespace fs = std::filesystem;

class ImageWrite : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / ("image_write_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_F(ImageWrite, PngHoldsTheBytesAsTheyAre) {
  std::vector<std::uint8_t> pixels(3 * 2 * 3);
  std::iota(pixels.begin(), pixels.end(), std::uint8_t{100});
  penumbra::image::write_png(folder_ / "x.png", 3, 2, 3, pixels);
  int width = 0, height = 0, channels = 0;
  stbi_uc* read = stbi_load((folder_ / "x.png").c_str(), &width, &height, &channels, 0);
  ASSERT_NE(read, nullptr) << stbi_failure_reason();
  EXPECT_EQ((std::vector<int>{width, height, channels}), (std::vector<int>{3, 2, 3}));
  EXPECT_EQ(std::vector<std::uint8_t>(read, read + pixels.size()), pixels);
  stbi_image_free(read);
}

// tEXt is Latin-1, iTXt is UTF-8: name, no compression, no language, no translated name, value.
TEST_F(ImageWrite, TextsOfAPngAreUtf8OnlyWhereTheFormatHasIt) {
  using namespace std::string_literals;
  const std::vector<std::uint8_t> pixel{7};
  penumbra::image::write_png(folder_ / "x.png", 1, 1, 1, pixel, {{"scene", "a.glb"}, {"light", "L\u00e1mpara"}});
  const std::string bytes = bytes_of(folder_ / "x.png");
  EXPECT_NE(bytes.find("tEXtscene\0a.glb"s), std::string::npos);
  EXPECT_NE(bytes.find("iTXtlight\0\0\0\0\0L\xc3\xa1mpara"s), std::string::npos);
}

TEST_F(ImageWrite, APngInMemoryIsTheFile) {
  const std::vector<std::uint8_t> pixels{1, 2, 3, 250, 251, 252};
  penumbra::image::write_png(folder_ / "x.png", 2, 1, 3, pixels);
  const std::vector<std::byte> encoded = penumbra::image::encode_png(2, 1, 3, pixels);
  const std::string file = bytes_of(folder_ / "x.png");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(encoded.data()), encoded.size()), file);
}

TEST_F(ImageWrite, ExrHoldsFloatsAsTheyAreInNamedLayers) {
  const std::vector<float> color{0.1f, 2.0f, 1e6f, -1.0f, 0.0f, 65536.0f};
  const std::vector<float> shadow{0.25f, 1.0f / 3.0f};
  const std::vector<penumbra::image::Layer> layers{{"", {"R", "G", "B"}, color}, {"shadow", {"V"}, shadow}};
  penumbra::image::write_exr(folder_ / "x.exr", 2, 1, layers, {{"penumbra:technique", "pcss"}});
  EXPECT_EQ(penumbra::image::read_picture(folder_ / "x.exr").pixels, color);
  EXPECT_EQ(penumbra::image::read_picture(folder_ / "x.exr", "shadow").pixels, shadow);
  // As an attribute has it: name, type, size, value.
  using namespace std::string_literals;
  EXPECT_NE(bytes_of(folder_ / "x.exr").find("penumbra:technique\0string\0\4\0\0\0pcss"s), std::string::npos);
}

TEST_F(ImageWrite, FilesHoldNoTime) {
  const std::vector<penumbra::image::Layer> layers{{"", {"R", "G", "B"}, {1, 2, 3}}};
  penumbra::image::write_exr(folder_ / "a.exr", 1, 1, layers);
  penumbra::image::write_png(folder_ / "a.png", 1, 1, 1, std::vector<std::uint8_t>{7});
  sleep(1);  // a time stamp counts whole seconds
  penumbra::image::write_exr(folder_ / "b.exr", 1, 1, layers);
  penumbra::image::write_png(folder_ / "b.png", 1, 1, 1, std::vector<std::uint8_t>{7});
  EXPECT_EQ(bytes_of(folder_ / "a.exr"), bytes_of(folder_ / "b.exr"));
  EXPECT_EQ(bytes_of(folder_ / "a.png"), bytes_of(folder_ / "b.png"));
}

TEST_F(ImageWrite, MakesMissingFolders) {
  penumbra::image::write_png(folder_ / "a/b/x.png", 1, 1, 1, std::vector<std::uint8_t>{7});
  EXPECT_TRUE(fs::exists(folder_ / "a/b/x.png"));
}

}  // namespace
