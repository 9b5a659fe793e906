#include "reproduce/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "report/number.h"

namespace penumbra::reproduce {

namespace {

Quantity limit_of(const Quantity& a, double limit) {
  return {.name = {}, .value = limit, .unit = a.unit, .decimals = a.decimals};
}

// Of a difference of two printed values.
constexpr double rounding = 1e-9;

// The value as it is printed. Claims are decided by printed values, so that a reader can check the decision.
double shown(const Quantity& quantity) {
  const double scale = std::pow(10.0, quantity.decimals);
  return std::round(quantity.value * scale) / scale;
}

std::optional<bool> if_measured(bool holds, const Quantity& a, const Quantity& b) {
  return std::isnan(a.value) || std::isnan(b.value) ? std::nullopt : std::optional(holds);
}

// "the PSNR of the box filter", or "that of the box filter" beside another PSNR.
std::string name_beside(const Quantity& other, const Quantity& a) {
  const std::size_t of = a.name.find(" of ");
  if (of == std::string::npos || other.name.compare(0, of + 4, a.name, 0, of + 4) != 0) return other.name;
  return "that" + other.name.substr(of);
}

}  // namespace

std::string Quantity::text() const {
  const std::string number = report::fixed(value, decimals);
  return unit.empty() ? number : number + " " + unit;
}

void Finding::record(const Quantity& quantity) {
  const bool known = std::ranges::any_of(quantities_, [&](const Quantity& q) { return q.name == quantity.name; });
  if (!known) quantities_.push_back(quantity);
}

void Finding::expect(std::optional<bool> holds, const Quantity& a, const std::string& relation) {
  record(a);
  const std::string is = fmt::format("{} ({}) is {}{}", a.name, a.text(), holds.value_or(true) ? "" : "not ", relation);
  checks_.push_back({holds, holds ? is : "whether " + is + " could not be measured"});
}

void Finding::expect_below(const Quantity& a, const Quantity& b) {
  expect(if_measured(shown(a) < shown(b), a, b), a, fmt::format("below {} ({})", name_beside(b, a), b.text()));
  record(b);
}

void Finding::expect_above(const Quantity& a, const Quantity& b) {
  expect(if_measured(shown(a) > shown(b), a, b), a, fmt::format("above {} ({})", name_beside(b, a), b.text()));
  record(b);
}

void Finding::expect_above_by(double margin, const Quantity& a, const Quantity& b) {
  expect(if_measured(shown(a) - shown(b) >= margin - rounding, a, b), a,
         fmt::format("at least {} above {} ({})", limit_of(a, margin).text(), name_beside(b, a), b.text()));
  record(b);
}

void Finding::expect_at_least(const Quantity& a, double limit) {
  expect(if_measured(shown(a) >= limit, a, a), a, "at least " + limit_of(a, limit).text());
}

void Finding::expect_near(const Quantity& a, const Quantity& b, double tolerance) {
  // Infinite values can be equal, but not near.
  const bool near = shown(a) == shown(b) || std::abs(shown(a) - shown(b)) <= tolerance + rounding;
  expect(if_measured(near, a, b), a,
         fmt::format("within {} of {} ({})", limit_of(a, tolerance).text(), b.name, b.text()));
  record(b);
}

std::string Finding::verdict() const {
  assert(!checks_.empty());
  const auto held = std::ranges::count(checks_, std::optional(true), &Check::holds);
  const auto unknown = std::ranges::count(checks_, std::optional<bool>(), &Check::holds);
  if (unknown == std::ssize(checks_)) return "not measured";
  if (held == 0) return "not confirmed";
  return held == std::ssize(checks_) ? "confirmed" : "confirmed in part";
}

std::string Finding::joined(bool holding) const {
  std::vector<std::string> words;
  for (const Check& check : checks_) {
    if ((check.holds == true) == holding) words.push_back(check.words);
  }
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

std::string Finding::sentence() const {
  const std::string of = verdict(), held = joined(true), failed = joined(false);
  if (of == "not measured") return "Our measurement says nothing about it: " + failed + ".";
  if (of == "confirmed") return "Our measurement confirms the thesis: " + held + ".";
  if (of == "not confirmed") return "Our measurement does not confirm the thesis: " + failed + ".";
  return "Our measurement confirms the thesis in part: " + held + ", but " + failed + ".";
}

}  // namespace penumbra::reproduce
