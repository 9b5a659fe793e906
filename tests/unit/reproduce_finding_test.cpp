// Verdicts follow from what was measured, and say so where nothing was.
#include <gtest/gtest.h>

#include <limits>

#include "reproduce/finding.h"

namespace penumbra {
namespace {

using reproduce::Finding;
using reproduce::Quantity;

constexpr double none = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

Quantity decibels(const char* name, double value) { return {name, value, "dB"}; }
const Quantity low = decibels("the PSNR of A", 20), high = decibels("the PSNR of B", 30);
const Quantity unknown = decibels("the PSNR of C", none);

TEST(ReproduceFinding, IsConfirmedAsFarAsItsChecksHold) {
  Finding finding;
  finding.expect_above(high, low);
  EXPECT_EQ(finding.verdict(), "confirmed");
  EXPECT_EQ(finding.sentence(),
            "Our measurement confirms the thesis: the PSNR of B (30.00 dB) is above that of A (20.00 dB).");
  finding.expect_below(high, low);
  EXPECT_EQ(finding.verdict(), "confirmed in part");
  Finding refuted;
  refuted.expect_above_by(11, high, low);
  EXPECT_EQ(refuted.verdict(), "not confirmed");
}

TEST(ReproduceFinding, WithoutAValueIsNeitherConfirmedNorRefuted) {
  const auto each = [](const auto& expect) {
    Finding finding;
    expect(finding);
    EXPECT_EQ(finding.verdict(), "not measured");
    EXPECT_EQ(finding.sentence().find(") is not "), std::string::npos) << finding.sentence();
    EXPECT_NE(finding.sentence().find("could not be measured"), std::string::npos) << finding.sentence();
  };
  each([](Finding& f) { f.expect_below(unknown, high); });
  each([](Finding& f) { f.expect_above(high, unknown); });
  each([](Finding& f) { f.expect_above_by(1, unknown, high); });
  each([](Finding& f) { f.expect_at_least(unknown, 1); });
  each([](Finding& f) { f.expect_near(high, unknown, 1); });
  Finding finding;
  finding.expect_at_least(unknown, 30);
  EXPECT_EQ(finding.sentence(),
            "Our measurement says nothing about it: whether the PSNR of C (– dB) is at least 30.00 dB could not be "
            "measured.");
}

TEST(ReproduceFinding, RestsOnWhatWasMeasured) {
  Finding finding;
  finding.expect_above(unknown, low);
  finding.expect_above(low, high);
  EXPECT_EQ(finding.verdict(), "not confirmed");
  finding.expect_above(high, low);
  EXPECT_EQ(finding.verdict(), "confirmed in part");
  EXPECT_EQ(finding.sentence(),
            "Our measurement confirms the thesis in part: the PSNR of B (30.00 dB) is above that of A (20.00 dB), but "
            "whether the PSNR of C (– dB) is above that of A (20.00 dB) could not be measured and the PSNR of A (20.00 "
            "dB) is not above that of B (30.00 dB).");
}

TEST(ReproduceFinding, EqualPicturesAreAlike) {
  Finding finding;
  finding.expect_near(decibels("the PSNR of A", infinite), decibels("the PSNR of B", infinite), 3);
  EXPECT_EQ(finding.verdict(), "confirmed");
  Finding other;
  other.expect_near(high, decibels("the PSNR of A", infinite), 3);
  EXPECT_EQ(other.verdict(), "not confirmed");
}

}  // namespace
}  // namespace penumbra
