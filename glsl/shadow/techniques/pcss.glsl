// Percentage-closer soft shadows (Fernando 2005), radii in metres.
const bool blocker_footprints = pcss_blocker_reads == pcss_blocker_reads_footprint;
#include "shadow/blockers.glsl"

float read_radius(Receiver receiver, Light light) { return search_radius(receiver, light); }

Visibility visibility(Receiver receiver, Light light) {
  return soft_shadow(receiver, light, pcss_blocker_taps, pcss_filter_taps, pcss_disocclusion_taps,
                     pcss_early_exit != 0);
}
