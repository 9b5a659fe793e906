#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace penumbra::app {

// The colour of a label, 0, 1, …, in pictures of AOVs: 8-bit sRGB, eight of them in turn. What is no label, as the -1
// of the sky, is black.
inline std::array<std::uint8_t, 3> label_color(float label) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 8> colors{{{{214, 69, 65}},
                                                                      {{84, 160, 72}},
                                                                      {{66, 110, 196}},
                                                                      {{222, 180, 60}},
                                                                      {{150, 84, 170}},
                                                                      {{60, 176, 180}},
                                                                      {{226, 128, 52}},
                                                                      {{150, 150, 150}}}};
  constexpr float most = 65536;
  if (!(label >= 0 && label < most)) return {};
  return colors[static_cast<std::size_t>(label) % colors.size()];
}

}  // namespace penumbra::app
