#include "truth/reference.h"

namespace penumbra::truth {

bool is_reference(std::string_view technique) { return technique == "truth" || technique == "brute_force"; }

void make_reference(ParamSet& params) {
  constexpr int seeds = 65536, shift = seeds / 2;  // the range of sampling.seed
  params.set("denoiser", std::string("none"));
  if (params.get_word("technique") != "truth")
    params.set("sampling.seed", (params.get_int("sampling.seed") + shift) % seeds);
}

}  // namespace penumbra::truth
