#pragma once

#include <string>

namespace penumbra::report {

// Numbers as a page shows them: a true minus sign, "∞", and "–" for what is not a number.
std::string fixed(double value, int decimals);
// With so many digits of the value, no exponent for 1e-4 to 1e6, no zeros at the end.
std::string significant(double value, int digits);

}  // namespace penumbra::report
