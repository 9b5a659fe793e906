// All rays from a receiver to the light that share an azimuth lie in one plane, a slice, which cuts the shadow map in a
// line. One walk along that line, outwards, finds which of these rays are blocked: a bit mask holds rings of equal area
// of the light, from its centre to its rim, and each texel hides those behind it. See docs/techniques.md.
#include "shadow/texel_filter.glsl"
#include "shadow/sampling.glsl"

float read_radius(Receiver receiver, Light light) { return fine_search_radius(receiver, light); }

const int ring_count = 32;

// The radius of the disc that is read, metres. Below half a texel a sample it is narrow enough.
float walk_radius(Receiver receiver, Light light) {
  const int least_with_thin_casters = 4;  // texels
  float texel = texel_size(receiver, light);
  float with_thin_casters = float(max(slices_filter_radius, least_with_thin_casters)) * texel;
  float radius = radius_with_thin_casters(receiver, with_thin_casters, light);
  return fine_edge_radius(receiver, radius, 0.5 * float(slices_samples) * texel, light);
}

// A point of the light's rim, -1..1. Equal shares of the argument, 0..1, are sectors of equal area.
vec2 rim_point(float share, Light light) {
  if (is_square(light)) {
    float along = 2.0 * fract(4.0 * share) - 1.0;
    vec2 point = fract(2.0 * share) < 0.5 ? vec2(1.0, along) : vec2(-along, 1.0);
    return share < 0.5 ? point : -point;
  }
  float angle = 6.2831853 * share;
  return vec2(cos(angle), sin(angle));
}

// The rings from one share of the rim's radius to another. A ring that is hidden in part is so with that probability,
// since `dither` is uniform in 0..1.
uint rings_between(float low, float high, float dither) {
  vec2 ends = clamp(vec2(low * low, high * high), 0.0, 1.0) * float(ring_count) + dither;
  int first = min(int(ends.x), ring_count), end = min(int(ends.y), ring_count);
  if (end <= first) return 0u;
  return (~0u >> (ring_count - (end - first))) << first;
}

// Samples are denser near the receiver, where penumbrae are narrow: the share of a slice's length at which one begins
// that lies at that share of their number. Still denser where near casters may lie below far ones.
float spread(float share) { return (READS_SECOND_LAYER ? share * share : share) * sqrt(share); }

// A pixel's random numbers, 0..1.
struct PixelNoise {
  float azimuth, distance_to, ring;
  vec2 texel;
};

PixelNoise noise_of(Receiver receiver) {
  vec2 first = pixel_noise(receiver, blocker_step), second = pixel_noise(receiver, filter_step);
  return PixelNoise(first.x, first.y, second.x, second);
}

// Metres: the least number that counts, and less where a scene is so small that texels are.
float least_length(float most, float share, Receiver receiver, Light light) {
  return min(most, share * texel_size(receiver, light));
}

// The distance from a receiver, metres, at which rays to the light's rim are that high above it; not 0.
float rim_radius(Receiver receiver, float height, Light light) {
  return max(penumbra_radius(receiver, height, light), least_length(1e-6, 1e-3, receiver, light));
}

// What slices found.
struct Found {
  int hidden;        // rings
  float height_sum;  // of blockers, metres along the light
  float nearness_sum;
  float blockers;
  bool overlaps;  // a near caster lies below a far one, which only the second layer shows
};

// Mean height of blockers. Of a near and a far caster at one place the near one makes the narrower penumbra, which must
// not be blurred, so there it is the harmonic mean.
float mean_height(Found found) {
  return found.overlaps ? found.blockers / found.nearness_sum : max(found.height_sum / found.blockers, 0.0);
}

// Heights below the bias are not known.
float nearness_of(Receiver receiver, float height, float bias, Light light) {
  return 1.0 / max(height, max(bias, least_length(1e-4, 0.1, receiver, light)));
}

const float beyond_rim = 2.0;  // a share of the rim's radius: no ray

// A sample's stretch of the line, and the place in it that was read: metres from the receiver.
struct Stretch {
  float begin, at, end;
  bool last;  // goes on for ever
};

// The last sample of a layer, if it blocks.
struct Blocker {
  float hidden_to;   // share of the rim's radius up to which it hides rays
  float height, at;  // metres; far below all others if it does not block
};

const Blocker no_blocker = Blocker(beyond_rim, -1e30, 0.0);

// Whether the material of a blocker is taken to go on to the next one on the line. It always is where the second layer
// is not read, since what lies below a higher blocker can't be seen then. Else `below` is the second layer's blocker at
// the sample before: where it shows that the lower surface goes on there, below a higher one that ends this many times
// more steeply than the light's cone, the two are separate. A wall that joins them, along which the light looks, has
// no such surface below it, nor has the inner face of the higher one.
bool goes_on(Blocker before, Blocker below, float height, float at, Receiver receiver, Light light) {
  if (!READS_SECOND_LAYER) return true;
  const float steepest = 4.0;
  float most = steepest * cone_slope(receiver, light) * (at - before.at);
  float falls = before.height - height;
  bool lower_goes_on = abs(below.height - height) <= min(most, 0.5 * falls);
  return falls <= most || !lower_goes_on;
}

// Adds the rays that a texel of that depth hides to `rings`, if it is nearer to the light than `blocking`; `before`:
// the sample before it on the line, and `below`: that of the layer below it.
Blocker add_texel(inout Found found, inout uint rings, Receiver receiver, float depth, float blocking, float bias,
                  Stretch stretch, Blocker before, Blocker below, float dither, Light light) {
  if (depth >= blocking) return no_blocker;
  float height = receiver.position.z - depth;
  float per_metre = 1.0 / rim_radius(receiver, height, light);
  float low = stretch.begin * per_metre;
  if (goes_on(before, below, height, stretch.at, receiver, light)) low = min(low, before.hidden_to);
  float high = stretch.last ? beyond_rim : stretch.end * per_metre;
  uint hides = rings_between(low, high, dither);
  rings |= hides;
  found.height_sum += hides != 0u ? height : 0.0;
  if (READS_SECOND_LAYER) found.nearness_sum += hides != 0u ? nearness_of(receiver, height, bias, light) : 0.0;
  found.blockers += hides != 0u ? 1.0 : 0.0;
  return Blocker(high, height, stretch.at);
}

// How many slices a pixel is given in a round, and how many samples a slice.
struct Counts {
  int azimuths, samples;
};

// Under a narrow light a slice mostly crosses one edge: two thirds of slices.samples are enough, and there are more
// slices instead. Under a wide light, and where casters may overlap, it crosses several. More than two samples a texel
// would read the same texels again.
Counts counts_for(Receiver receiver, float radius, Light light) {
  // Of the cone to the light: its radius for each metre along the light.
  const float narrow = 0.02, wide = 0.05;
  float wideness = clamp((1.0 / cone_slope(receiver, light) - narrow) / (wide - narrow), 0.0, 1.0);
  float share = READS_SECOND_LAYER ? 1.0 : mix(2.0 / 3.0, 1.0, wideness);
  int samples = max(int(share * float(slices_samples) + 0.5), 1);
  int azimuths = slices_azimuths * slices_samples / samples;
  samples = slices_azimuths * slices_samples / azimuths;  // what whole slices leave over
  return Counts(azimuths, min(samples, int(2.0 * radius / texel_size(receiver, light)) + 3));
}

// Follows a slice and adds what it finds. `share`: its place on the rim, as for rim_point(); `index`: its number among
// the pixel's slices.
void walk(inout Found found, Receiver receiver, float share, int index, int samples, float radius, PixelNoise noise,
          float bias, Light light) {
  uint rings = 0u;
  float rim_texel = texel_size(receiver, light);
  vec2 texel = texel_extent(receiver, light);
  vec2 place = map_place(receiver.position, light);
  vec2 rim = on_outline(rim_point(fract(share), light), light);
  float jitter = fract(noise.distance_to + golden * float(index));
  float dither = fract(noise.ring + plastic.x * float(index));
  float begin = 0.0;
  Blocker before = no_blocker, second_before = no_blocker;
  int i = 0;
  do {
    float end = (radius + rim_texel) * spread(float(i + 1) / float(samples));
    float at = mix(begin, end, jitter);
    // Moved by up to half a texel: the mean over many samples then weights texels as bilinear filters do.
    vec2 moved = fract(noise.texel + plastic * float(index * slices_samples + i)) - 0.5;
    ivec2 cell = ivec2(floor(place + rim * (at / texel) + moved));
    vec2 offset = texel_offset(receiver, cell, light);
    float blocking = blocking_depths_at(receiver, Offsets(vec4(offset.x), vec4(offset.y)), bias).x;
    Stretch stretch = Stretch(begin, at, end, i + 1 == samples);
    before = add_texel(found, rings, receiver, depth_at(cell, light), blocking, bias, stretch, before, second_before,
                       dither, light);
#if READS_SECOND_LAYER
    uint behind = 0u;
    second_before = add_texel(found, behind, receiver, depth_behind(cell, light), blocking, bias, stretch,
                              second_before, no_blocker, dither, light);
    found.overlaps = found.overlaps || behind != 0u && second_before.height < least_share_of_height * before.height;
    rings |= behind;
#endif
    begin = end;
  } while (++i < samples);
  found.hidden += bitCount(rings);
}

// How many times slices.azimuths slices a pixel in a penumbra gets: more where the penumbra is narrow on the screen,
// since there no filter finds neighbours that it could average.
int rounds_for(Receiver receiver, Found found, Light light) {
  const int most = clamp(20000 / (slices_azimuths * (slices_samples + 2)), 1, 4);
  float width = 2.0 * penumbra_radius(receiver, mean_height(found), light) / pixel_width(view_position_of(receiver));
  return min(1 + int(float(slices_narrow) / max(width, 0.01)), most);
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  receiver = with_surroundings(receiver, bias, cone_slope(receiver, light), light);
  Visibility centre = centre_shadow(receiver, bias, light);
  float radius = walk_radius(receiver, reading_centre(centre, light));
  float texel = texel_size(receiver, light);
  // Where the penumbra is so narrow and the four texels agree, a pixel is what it is in decided tiles.
  bool decided = centre.visibility == 0.0 || centre.visibility == 1.0;
  if (radius < 0.5 * texel && (decided || slices_filter_radius == 0)) {
    centre.noise_free = decided;
    return centre;
  }
  if (radius < float(slices_filter_radius) * texel) {
    FilteredTexels filtered = filter_texels(receiver, radius, bias, light);
    if (!filtered.heights_differ) return filtered.seen;
  }
  PixelNoise noise = noise_of(receiver);
  Found found = Found(0, 0.0, 0.0, 0.0, false);
  Counts counts = counts_for(receiver, radius, light);
  int slices = 0, rounds = 1, turn = 0;
  do {
    // Each round's slices lie between those of the others.
    float first = noise.azimuth + float(turn) / float(rounds);
    int azimuth = 0;
    do {
      float share = (float(azimuth) + first) / float(counts.azimuths);
      walk(found, receiver, share, slices + azimuth, counts.samples, radius, noise, bias, light);
    } while (++azimuth < counts.azimuths);
    slices += counts.azimuths;
    bool in_part = found.hidden > 0 && found.hidden < ring_count * slices;
    if (turn == 0 && in_part) rounds = rounds_for(receiver, found, light);
  } while (++turn < rounds);
  if (found.hidden == 0) return fully_lit();
  float mean = mean_height(found);
  float penumbra = penumbra_radius(receiver, mean, light);
  return Visibility(1.0 - float(found.hidden) / float(ring_count * slices), penumbra, mean, penumbra < texel, false);
}
