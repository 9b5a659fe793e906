#pragma once

#include <string>

namespace penumbra::report {

// Numbers as a page shows them: a true minus sign, "∞", and "–" for what is not a number.
std::string fixed(double value, int decimals);
// With `digits` significant digits; no exponent from 1e-4 to 1e6, no trailing zeros.
std::string significant(double value, int digits);

}  // namespace penumbra::report
