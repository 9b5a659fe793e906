#include "io/presets.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/names.h"

namespace {

using penumbra::Error;
using penumbra::Param;
using penumbra::ParamSet;

ParamSet rows() {
  return ParamSet({Param{"technique", std::string("hard"), 0, 0, "", "", {}, {"hard", "pcss"}},
                   Param{"exposure", 1.5f, -20, 20, "EV", ""}, Param{"pcss.filter_taps", 16, 1, 256, "taps", ""},
                   Param{"pcss.early_exit", true, 0, 1, "", ""}, Param{"sun.angle", 0.53f, 0, 20, "deg", ""},
                   Param{"sun.shape", std::string("disc"), 0, 0, "", "", {}, {"disc", "square"}}});
}

// As a registry's select(): "pcss_wide" is a preset of this test.
void select(ParamSet& params, std::string_view name) {
  if (name == "pcss_wide") {
    params.assign("technique=pcss");
    params.assign("pcss.filter_taps=64");
  } else if (name == "pcss" || name == "hard") {
    params.set_text("technique", name);
  } else {
    penumbra::fail_unknown("technique", name, std::vector<std::string>{"hard", "pcss", "pcss_wide"});
  }
}

class Presets : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("presets_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ParamSet read(const std::string& text) {
    std::ofstream(path()) << text;
    ParamSet params = rows();
    penumbra::io::read_preset(path(), params, select);
    return params;
  }
  // The text of the error, with the folder removed from the file name.
  std::string fault(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path().string())) << message;
      return message.substr(folder_.string().size() + 1);
    }
    return "none";
  }
  std::filesystem::path path() const { return folder_ / "p.toml"; }

 private:
  std::filesystem::path folder_;
};

TEST_F(Presets, SetValuesByTableAndByDottedKey) {
  const ParamSet params = read("technique = \"pcss\"\nsun.angle = 2.5\n[pcss]\nfilter_taps = 32\nearly_exit = false\n");
  EXPECT_EQ(params.get_word("technique"), "pcss");
  EXPECT_EQ(params.get_float("sun.angle"), 2.5f);
  EXPECT_EQ(params.get_int("pcss.filter_taps"), 32);
  EXPECT_FALSE(params.get_bool("pcss.early_exit"));
  EXPECT_EQ(params.get_word("sun.shape"), "disc");
}

TEST_F(Presets, AcceptAWholeNumberForAQuantity) { EXPECT_EQ(read("exposure = 2").get_float("exposure"), 2.0f); }

TEST_F(Presets, PutTheirOwnValuesOverAnAliases) {
  EXPECT_EQ(read("pcss.filter_taps = 8\ntechnique = \"pcss_wide\"\n").get_int("pcss.filter_taps"), 8);
  EXPECT_EQ(read("technique = \"pcss_wide\"").get_int("pcss.filter_taps"), 64);
}

TEST_F(Presets, NameFileLineAndNearNames) {
  const std::string unknown = fault("exposure = 1\n\n[pcss]\nfiltre_taps = 16\n");
  EXPECT_TRUE(unknown.starts_with("p.toml:4: ")) << unknown;
  EXPECT_NE(unknown.find("'pcss.filter_taps'"), std::string::npos) << unknown;
  const std::string technique = fault("technique = \"pcs\"\n");
  EXPECT_TRUE(technique.starts_with("p.toml:1: ") && technique.find("'pcss'") != std::string::npos) << technique;
}

TEST_F(Presets, RefuseWrongTypesAndRanges) {
  EXPECT_EQ(fault("sun.shape = 3"), "p.toml:1: parameter 'sun.shape' takes disc|square, not a whole number");
  EXPECT_EQ(fault("pcss.filter_taps = 16.0"),
            "p.toml:1: parameter 'pcss.filter_taps' takes int, not a number with a point");
  EXPECT_EQ(fault("pcss.filter_taps = \"16\""), "p.toml:1: parameter 'pcss.filter_taps' takes int, not a string");
  EXPECT_EQ(fault("pcss.early_exit = 1"), "p.toml:1: parameter 'pcss.early_exit' takes bool, not a whole number");
  EXPECT_EQ(fault("exposure = [1]"), "p.toml:1: parameter 'exposure' takes float, not a list or a date");
  EXPECT_EQ(fault("technique = 1"), "p.toml:1: 'technique' takes a name in quotes");
  for (const char* value : {"0", "257", "99999999999", "-99999999999"})
    EXPECT_NE(fault(std::string("\npcss.filter_taps = ") + value).find("p.toml:2: parameter"), std::string::npos)
        << value;
  for (const char* value : {"nan", "inf", "-inf", "1e300", "20.1"})
    EXPECT_NE(fault(std::string("exposure = ") + value).find("it takes"), std::string::npos) << value;
}

TEST_F(Presets, RefuseWhatIsNoToml) {
  EXPECT_TRUE(fault("exposure = 1\nexposure = \n").starts_with("p.toml:2: "));
  EXPECT_NE(fault(std::string("\x00\xff\xfe junk", 8)), "none");
  EXPECT_NE(fault("exposure = 1\nexposure = 2\n"), "none");
}

TEST_F(Presets, ChangeNothingWhenRefused) {
  ParamSet params = rows();
  std::ofstream(path()) << "exposure = 3\nsun.angle = 99\n";
  EXPECT_THROW(penumbra::io::read_preset(path(), params, select), Error);
  EXPECT_TRUE(params.is_default("exposure"));
}

TEST_F(Presets, ComeBackExactly) {
  ParamSet params = rows();
  params.assign("technique=pcss");
  params.assign("sun.angle=0.1");
  params.assign("exposure=-3.3333333");
  params.assign("pcss.early_exit=false");
  params.assign("sun.shape=square");
  penumbra::io::write_preset(path(), params);
  ParamSet again = rows();
  penumbra::io::read_preset(path(), again, select);
  for (const Param& row : params.rows()) EXPECT_EQ(params.value(row.name), again.value(row.name)) << row.name;
  EXPECT_EQ(penumbra::preset_text(again), penumbra::preset_text(params));
}

TEST_F(Presets, HoldOnlyWhatChanged) {
  ParamSet params = rows();
  params.assign("sun.angle=2");
  const std::string text = penumbra::preset_text(params);
  EXPECT_NE(text.find("technique = \"hard\"\n"), std::string::npos) << text;
  EXPECT_NE(text.find("[sun]\nangle = 2.0\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("pcss"), std::string::npos) << text;
}

// Each part of such a key is a table within the last one.
TEST_F(Presets, RefuseKeysOfVeryManyParts) {
  std::string key = "a";
  for (int i = 0; i < 300'000; ++i) key += ".a";
  for (const std::string& text : {"technique = \"pcss\"\n" + key + " = 1\n", "\n[" + key + "]\n"})
    EXPECT_EQ(fault(text), path().filename().string() + ":2: the line is longer than 1024 bytes");
}

TEST_F(Presets, RefuseMissingFilesAndFolders) {
  ParamSet params = rows();
  EXPECT_THROW(penumbra::io::read_preset(path(), params, select), Error);
  EXPECT_THROW(penumbra::io::read_preset(path().parent_path(), params, select), Error);
}

std::string refusal(const std::filesystem::path& file) {
  ParamSet params = rows();
  try {
    penumbra::io::read_preset(file, params, select);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST_F(Presets, RefuseEmptyFilesAndFaultsOfReading) {
  std::ofstream(path()) << "";
  EXPECT_EQ(refusal(path()), "cannot read preset '" + path().string() + "': it is empty");
  EXPECT_EQ(refusal("/dev/null"), "cannot read preset '/dev/null': it is empty");
  EXPECT_EQ(refusal("/dev/zero"), "cannot read preset '/dev/zero': it is larger than 1 MiB");
  EXPECT_EQ(refusal("/proc/self/mem"), "cannot read preset '/proc/self/mem': Input/output error");
  EXPECT_EQ(fault("# nothing is set\n"), "none");
}

TEST_F(Presets, RefusePipesThatNoProgramWritesTo) {
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_EQ(refusal(path()), "cannot read preset '" + path().string() + "': no program writes to this pipe");
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[1]);
  EXPECT_TRUE(refusal("/dev/fd/" + std::to_string(ends[0])).ends_with("': it is empty"));
  close(ends[0]);
}

TEST_F(Presets, WaitForTheProgramThatWritesToAPipe) {
  using namespace std::chrono_literals;
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  const int writer = open(path().c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  ParamSet params = rows();
  auto reader = std::async(std::launch::async, [&] { penumbra::io::read_preset(path(), params, select); });
  for (const std::string_view part : {"exposure = 2", ".5\nsun.angle = 3\n"}) {
    EXPECT_EQ(reader.wait_for(20ms), std::future_status::timeout);
    EXPECT_EQ(write(writer, part.data(), part.size()), static_cast<ssize_t>(part.size()));
    int unread = 1;
    while (ioctl(writer, FIONREAD, &unread) == 0 && unread > 0 && reader.wait_for(1ms) == std::future_status::timeout) {
    }
  }
  close(writer);
  reader.get();
  EXPECT_EQ(params.get_float("exposure"), 2.5f);
  EXPECT_EQ(params.get_float("sun.angle"), 3.0f);
}

}  // namespace
