#include "bench/bench.h"

#include "app/commands.h"
#include "image/read.h"

namespace penumbra::app {

int run_bench(const Arguments& arguments) { return bench::run("penumbra bench", arguments, image::image_decoder()); }

}  // namespace penumbra::app
