#pragma once

#include <vector>

#include "metrics/image_view.h"

namespace penumbra::metrics {

// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive Techniques 3(2), 2020. It measures
// how different two pictures look to a viewer who flips between them: colours after the blur of the eye's contrast
// sensitivity at a viewing distance, and edges and points that only one picture has.
struct Flip {
  double mean = 0;         // over the receivers, 0 (the same) to 1; NaN without receivers
  std::vector<float> map;  // one value per pixel, 0 to 1, rows top to bottom; 0 where there is no receiver
};

// A 0.7 m wide screen of 3840 pixels at 0.7 m, the authors' default.
constexpr float usual_pixels_per_degree = 67.0206f;

// Takes display values, sRGB-encoded, 0 to 1; others are clamped. One channel is treated as a grey picture of that
// value: a visibility of 0.5 looks like the grey 127.5 of 255. Where there is no receiver, both pictures use the
// reference, so that unmeasured pixels do not affect their neighbours. A pixel whose test value is not finite has the
// error 1. Throws Error as check() does, and for channels other than 1 and 3.
Flip flip(const ImageView& test, const ImageView& reference, Receivers receivers = {},
          float pixels_per_degree = usual_pixels_per_degree);

}  // namespace penumbra::metrics
