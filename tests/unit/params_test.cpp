#include "core/params.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "core/error.h"

namespace penumbra {
namespace {

ParamSet sample() {
  return ParamSet({
      {"a.flag", true, 0, 1, "", "A switch.", ParamBinding::compiled},
      {"a.count", 16, 1, 256, "taps", "A count.", ParamBinding::compiled},
      {"a.size", 0.5f, 0, 2, "m", "A quantity."},
      {"b.kind", std::string("disc"), 0, 0, "", "A word.", ParamBinding::uniform, {"disc", "square"}},
      {"b.path", 3, 0, 9, "", "Known to the host alone.", ParamBinding::host},
  });
}

std::string message(const std::string& assignment) {
  ParamSet params = sample();
  try {
    params.assign(assignment);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Params, AssignmentsOfEachTypeAreRead) {
  ParamSet params = sample();
  params.assign("a.flag=off");
  params.assign("a.count=64");
  params.assign("a.size=1.25");
  params.assign("b.kind=square");
  EXPECT_FALSE(params.get_bool("a.flag"));
  EXPECT_EQ(params.get_int("a.count"), 64);
  EXPECT_EQ(params.get_float("a.size"), 1.25f);
  EXPECT_EQ(params.get_word("b.kind"), "square");
}

TEST(Params, WrongTypesAndRangesSayWhatIsAllowed) {
  EXPECT_EQ(message("a.count=12.5"), "parameter 'a.count' can't be '12.5': it takes a whole number from 1 to 256 taps");
  EXPECT_EQ(message("a.count=300"), "parameter 'a.count' can't be '300': it takes a whole number from 1 to 256 taps");
  EXPECT_EQ(message("a.size=nan"), "parameter 'a.size' can't be 'nan': it takes a number from 0 to 2 m");
  EXPECT_EQ(message("a.size="), "parameter 'a.size' can't be '': it takes a number from 0 to 2 m");
  EXPECT_EQ(message("a.flag=maybe"), "parameter 'a.flag' can't be 'maybe': it takes true or false");
  EXPECT_EQ(message("b.kind=ring"), "parameter 'b.kind' can't be 'ring': it takes one of disc, square");
  EXPECT_EQ(message("a.size"), "'a.size' is not of the form name=value");
}

TEST(Params, UnknownNamesListNearOnes) { EXPECT_NE(message("a.cuont=3").find("a.count"), std::string::npos); }

TEST(Params, AFormerNameIsRefusedWithThePresentOne) {
  ParamSet params({{.name = "a.count", .default_value = 1, .max = 9, .former_names = {"a.number", "b.taps"}}});
  for (const char* former : {"a.number", "b.taps"}) {
    const std::string expected = std::string("parameter '") + former + "' is now called 'a.count'";
    const auto complaint = [&](const auto& use) -> std::string {
      try {
        use();
      } catch (const Error& error) {
        return error.what();
      }
      return "";
    };
    EXPECT_EQ(complaint([&] { params.assign(std::string(former) + "=2"); }), expected);
    EXPECT_EQ(complaint([&] { params.set(former, 2); }), expected);
    EXPECT_EQ(complaint([&] { static_cast<void>(params.get_int(former)); }), expected);
    EXPECT_FALSE(params.contains(former));
  }
  EXPECT_EQ(params.get_int("a.count"), 1);
  EXPECT_THROW(
      ParamSet({{.name = "a.x", .default_value = 1}, {.name = "a.y", .default_value = 1, .former_names = {"a.x"}}}),
      std::logic_error);
}

TEST(Params, SetsAreEqualByNamesAndValues) {
  ParamSet a = sample();
  const ParamSet copy = a;
  EXPECT_EQ(a, copy);
  EXPECT_EQ(a, sample()) << "declared apart";
  a.set("a.count", 17);
  EXPECT_NE(a, copy);
  EXPECT_EQ(copy.get_int("a.count"), 16) << "a copy has values of its own";
  EXPECT_NE(ParamSet({{"a.x", 1, 0, 9, "", ""}}), ParamSet({{"a.y", 1, 0, 9, "", ""}}));
}

TEST(Params, ARefusedAssignmentChangesNothing) {
  ParamSet params = sample();
  EXPECT_THROW(params.assign("a.count=0"), Error);
  EXPECT_TRUE(params.is_default("a.count"));
}

TEST(Params, TypedValuesConvertWholeNumbersOnly) {
  ParamSet params = sample();
  params.set("a.size", 1);
  EXPECT_EQ(params.get_float("a.size"), 1.0f);
  EXPECT_THROW(params.set("a.count", 1.5f), Error);
  EXPECT_THROW(params.set("a.flag", 1), Error);
}

TEST(Params, TextRoundTripsEveryFloat) {
  const ParamSet params = sample();
  const Param& row = params.row("a.size");
  for (const float value : {0.1f, 1.0f / 3, 1.9999999f, 1e-30f}) {
    EXPECT_EQ(std::get<float>(parse_value(row, to_text(value))), value);
  }
}

TEST(Params, GlslSeesUniformRowsInOrderAndWordsAsConstants) {
  const std::string text = glsl_declarations(sample(), 4);
  EXPECT_NE(text.find("const int b_kind_square = 1;"), std::string::npos);
  EXPECT_NE(text.find("layout(std140, binding = 4) uniform Params {\n  float a_size;\n  int b_kind;\n};"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("b_path"), std::string::npos);
  EXPECT_EQ(text.find("a_count"), std::string::npos) << "compiled rows are defines";
}

TEST(Params, UniformBytesFollowTheBlock) {
  ParamSet params = sample();
  params.assign("b.kind=square");
  const std::vector<std::byte> bytes = uniform_bytes(params);
  ASSERT_EQ(bytes.size(), 16u) << "std140 rounds up";
  float size = 0;
  int kind = 0;
  std::memcpy(&size, bytes.data(), 4);
  std::memcpy(&kind, bytes.data() + 4, 4);
  EXPECT_EQ(size, 0.5f);
  EXPECT_EQ(kind, 1);
}

TEST(Params, CompiledConstantsAreThoseOfTheGivenRows) {
  const ParamSet params = sample();
  std::vector<Param> rows;
  for (const Param& row : params.rows()) {
    if (row.name.starts_with("a.")) rows.push_back(row);
  }
  const std::vector<GlslConstant> constants = compiled_constants(params, rows);
  ASSERT_EQ(constants.size(), 2u);
  EXPECT_EQ(constants[0].name, "a_flag");
  EXPECT_EQ(constants[0].value, "1");
  EXPECT_EQ(constants[1].value, "16");
}

TEST(Params, ADuplicateRowIsABug) {
  EXPECT_THROW(ParamSet({{"x", 1, 0, 2, "", "One."}, {"x", 1, 0, 2, "", "Two."}}), std::logic_error);
}

}  // namespace
}  // namespace penumbra
