#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "report/html.h"

namespace penumbra::reproduce {

// A measured value, with a name that is unique within its finding.
struct Quantity {
  std::string name;
  double value = 0;
  std::string unit;
  int decimals = 2;

  std::string text() const;  // "31.20 dB"
};

// What was measured about one figure of the thesis. The verdict and its sentence follow from the measurements alone.
class Finding {
 public:
  enum class Kind { figure, section };
  Kind kind = Kind::figure;  // a section: what the thesis says without a figure
  std::string id;            // "4.3"
  std::string title;         // "Uniform sampling"
  std::string claim;         // what the thesis claims about it, in a sentence
  std::string test;          // what is measured to test the claim, which the thesis judges by eye
  report::Html body;         // our version

  // Each records the quantities and whether the claim holds for them, for the verdict and its sentence.
  void expect_below(const Quantity& a, const Quantity& b);
  void expect_above(const Quantity& a, const Quantity& b);
  void expect_above_by(double margin, const Quantity& a, const Quantity& b);  // at least
  void expect_at_least(const Quantity& a, double limit);
  void expect_near(const Quantity& a, const Quantity& b, double tolerance);

  // Records a value; a second one of the same name is ignored.
  void record(const Quantity& quantity);

  const std::vector<Quantity>& quantities() const { return quantities_; }
  // "confirmed", "confirmed in part", "not confirmed", or "not measured": nothing that the claim is tested by has a
  // value.
  std::string verdict() const;
  // One sentence, with the figures that the verdict rests on in brackets.
  std::string sentence() const;

 private:
  struct Check {
    std::optional<bool> holds;  // nothing if a value could not be measured (NaN)
    std::string words;
  };
  void expect(std::optional<bool> holds, const Quantity& a, const std::string& relation);
  std::string joined(bool holding) const;

  std::vector<Quantity> quantities_;
  std::vector<Check> checks_;
};

}  // namespace penumbra::reproduce
