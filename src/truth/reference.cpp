#include "truth/reference.h"

#include <fmt/format.h>

#include "truth/tracer.h"

namespace penumbra::truth {

bool is_reference(std::string_view technique) { return technique == "truth" || technique == "brute_force"; }

bool is_of_scene(std::string_view param) {
  return param.starts_with("sun.") || param.starts_with("casters.") || param == "lamps.near";
}

void make_reference(ParamSet& params) {
  constexpr int seeds = 65536, shift = seeds / 2;  // the range of sampling.seed
  params.set("denoiser", std::string("none"));
  params.set("mask.scale", 1);
  if (params.get_word("technique") != "truth")
    params.set("sampling.seed", (params.get_int("sampling.seed") + shift) % seeds);
}

std::string rays_text(const ParamSet& params) {
  const float error = params.get_float("truth.error");
  const int rays = first_samples({.samples = params.get_int("truth.samples"), .error = error});
  return fmt::format("{} rays a pixel{}", rays,
                     error > 0 ? fmt::format(", or as many as a standard error of {:g} takes", error) : "");
}

}  // namespace penumbra::truth
