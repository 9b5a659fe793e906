// The folder of results that many processes share, and what lies in it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "core/error.h"
#include "image/packed.h"
#include "io/key.h"
#include "plan/json_reader.h"
#include "plan/results.h"
#include "support/temp_folder.h"

namespace penumbra::test {
namespace {

namespace fs = std::filesystem;
using plan::Result;
using plan::Results;

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

class PlanResults : public testing::Test {
 protected:
  static Result result() {
    return {.data = {{"third", 1.0 / 3}, {"none", io::json_number(NAN)}, {"far", io::json_number(INFINITY)}},
            .files = {{"empty", {}}, {"lines", bytes_of("a\n{}\n\0b")}}};
  }

  test::TempFolder temp_;
  Results results_{temp_.path() / "results", "compare"};
  io::Key key_{0x12, 0x34};
};

TEST_F(PlanResults, AreGivenBackExactly) {
  EXPECT_FALSE(results_.has(key_));
  EXPECT_FALSE(results_.find(key_));
  results_.keep(key_, result());
  const auto found = results_.find(key_);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->data.at("third").get<double>(), 1.0 / 3);
  EXPECT_TRUE(std::isnan(plan::any_number_in(found->data, "none")));
  EXPECT_EQ(plan::any_number_in(found->data, "far"), std::numeric_limits<double>::infinity());
  ASSERT_EQ(found->files.size(), 2u);
  EXPECT_TRUE(found->file("empty").bytes.empty());
  EXPECT_EQ(found->file("lines").bytes, result().files[1].bytes);
  EXPECT_THROW(found->file("other"), Error);
}

TEST_F(PlanResults, ADamagedByteMakesTheFileAbsent) {
  results_.keep(key_, result());
  const fs::path file = results_.file_of(key_);
  std::string good(fs::file_size(file), ' ');
  std::ifstream(file, std::ios::binary).read(good.data(), static_cast<std::streamsize>(good.size()));
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    std::ofstream(file, std::ios::binary) << bad;
    EXPECT_FALSE(results_.find(key_)) << "byte " << at;
    EXPECT_TRUE(results_.has(key_));
  }
  for (std::size_t length = 0; length < good.size(); ++length) {
    std::ofstream(file, std::ios::binary) << good.substr(0, length);
    EXPECT_FALSE(results_.find(key_)) << length << " bytes";
  }
}

// Of the right checksum, so somebody meant it: nlohmann would copy the values by a call for each level.
TEST_F(PlanResults, OfTooDeepNestingAreAbsent) {
  const fs::path file = results_.file_of(key_);
  fs::create_directories(file.parent_path());
  const auto found = [&](std::size_t depth) {
    const std::string data = std::string(depth, '[') + std::string(depth, ']');
    const std::string body = R"({"format":"penumbra.result/1","key":")" + key_.text() +
                             R"(","command":"compare","data":)" + data + R"(,"files":[]})" + "\n";
    io::Hasher hasher;
    hasher.add(body);
    std::ofstream(file, std::ios::binary) << body << hasher.key().text() << "\n";
    return results_.find(key_).has_value();
  };
  EXPECT_TRUE(found(63));
  EXPECT_FALSE(found(64));
  EXPECT_FALSE(found(300'000));
}

TEST_F(PlanResults, BelongToTheirKeyAndCommand) {
  results_.keep(key_, result());
  const io::Key other{0x12, 0x35};
  fs::create_directories(results_.file_of(other).parent_path());
  fs::copy_file(results_.file_of(key_), results_.file_of(other));
  EXPECT_FALSE(results_.find(other));
  EXPECT_FALSE(Results(results_.folder(), "render").find(key_));
  EXPECT_TRUE(results_.find(key_));
}

TEST_F(PlanResults, AFailureIsToldUntilThereIsAResult) {
  EXPECT_EQ(results_.failure(key_), "");
  results_.keep_failure(key_, "no light");
  EXPECT_EQ(results_.failure(key_), "no light");
  EXPECT_FALSE(results_.has(key_));
  results_.keep(key_, result());
  EXPECT_EQ(results_.failure(key_), "");
}

TEST(IoKey, IsReadAsItIsWritten) {
  const io::Key key{0x0123456789abcdef, 0xfedcba9876543210};
  EXPECT_EQ(key.text(), "0123456789abcdeffedcba9876543210");
  EXPECT_EQ(io::key_from(key.text()), key);
  for (const char* bad : {"", "0", "0123456789ABCDEFfedcba9876543210", "../23456789abcdeffedcba9876543210",
                          "0123456789abcdeffedcba98765432100", "+123456789abcdeffedcba9876543210"})
    EXPECT_FALSE(io::key_from(bad)) << bad;
}

TEST(IoKey, IsOfTheBytesHoweverTheyAreDivided) {
  io::Hasher whole, parts;
  whole.add(std::string_view("abcdef"));
  parts.add(std::string_view("ab"));
  parts.add(std::string_view("cdef"));
  EXPECT_EQ(whole.key(), parts.key());
  test::TempFolder folder;
  const fs::path file = folder.path() / "file";
  std::ofstream(file) << "abcdef";
  EXPECT_EQ(io::key_of_file(file), whole.key());
  EXPECT_THROW(io::key_of_file("/proc/self/mem"), Error) << "a fault of reading is not the end of the file";
  // As the reference implementation gives it for no bytes at all (xxhsum -H2 of an empty file).
  EXPECT_EQ(io::Hasher().key().text(), "99aa06d3014798d86001c324468d497f");
}

TEST(PackedFloats, AreGivenBackBitByBit) {
  std::vector<float> values{0.0f,
                            -0.0f,
                            1.0f / 3,
                            std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::denorm_min(),
                            std::numeric_limits<float>::quiet_NaN()};
  values.resize(5000, 0.25f);
  const std::vector<std::byte> packed = image::pack_floats(values);
  EXPECT_LT(packed.size(), values.size());
  const std::vector<float> again = image::unpack_floats(packed, values.size());
  ASSERT_EQ(again.size(), values.size());
  EXPECT_EQ(std::memcmp(again.data(), values.data(), values.size() * sizeof(float)), 0);
  EXPECT_THROW(image::unpack_floats(packed, values.size() - 1), Error);
  EXPECT_THROW(image::unpack_floats(packed, values.size() + 1), Error);
  EXPECT_THROW(image::unpack_floats(std::span(packed).first(packed.size() / 2), values.size()), Error);
  EXPECT_TRUE(image::unpack_floats(image::pack_floats({}), 0).empty());
}

}  // namespace
}  // namespace penumbra::test
