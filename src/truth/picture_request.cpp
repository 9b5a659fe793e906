#include "truth/picture_request.h"

namespace penumbra::truth {

TracedPicture PictureTracer::trace(const PictureRequest& request, const std::stop_token& stop) {
  TracedPicture picture{.key = request.key};
  if (!tracer_ || casters_ != request.casters) {
    tracer_.reset();  // released first, so that two tracers never exist at the same time
    tracer_.emplace(*request.scene, request.geometry, BuildOptions{.threads = request.options.threads, .stop = stop});
    casters_ = request.casters;
    picture.build = tracer_->stats();
  }
  if (stop.stop_requested()) throw Interrupted();
  picture.traced = tracer_->trace(request.receivers, request.width, request.light, request.options);
  return picture;
}

}  // namespace penumbra::truth
