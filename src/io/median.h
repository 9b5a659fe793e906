#pragma once

#include <vector>

namespace penumbra::io {

// Of an even number of values it is the mean of the middle two; at least one.
double median_of(std::vector<double> values);

}  // namespace penumbra::io
