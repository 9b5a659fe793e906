#include "metrics/quality.h"

#include <utility>

#include "metrics/flip.h"
#include "metrics/ssim.h"

namespace penumbra::metrics {

Quality quality_of(const ImageView& test, const ImageView& reference, Receivers receivers) {
  Flip difference = flip(test, reference, receivers);
  return {.errors = error_figures(test, reference, receivers),
          .ssim = ssim(test, reference, receivers),
          .flip = difference.mean,
          .flip_map = std::move(difference.map),
          .width = penumbra_width(test, reference, receivers)};
}

}  // namespace penumbra::metrics
