#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/names.h"
#include "lib/octahedral.glsl"
#include "lib/packed_texel.glsl"
#include "render/frame.h"

namespace penumbra::render {

namespace {

// Pixels on the CPU, rows top to bottom.
struct Pixels {
  int channels;
  std::vector<float> values;

  std::size_t pixels() const { return values.size() / static_cast<std::size_t>(channels); }
  const float* operator[](std::size_t pixel) const { return &values[pixel * static_cast<std::size_t>(channels)]; }
};

// A frame, or one pixel of it.
struct Source {
  const FrameParts& frame;
  std::size_t light = 0;
  std::optional<glm::ivec2> pixel = {};  // counted from the upper left; absent: the whole frame

  Pixels read(const gl::Texture& texture, int channels, int layer = 0) const;
  // Of a texture with a texel for every scale-th pixel of each row and column.
  Pixels read_bits(const gl::Texture& texture, int scale) const;
};

template <class Value>
std::vector<float> rows_top_down(const std::vector<Value>& bottom_up, std::size_t row) {
  std::vector<float> rows;
  rows.reserve(bottom_up.size());
  for (std::size_t end = bottom_up.size(); end > 0; end -= row) {
    const auto begin = bottom_up.begin() + static_cast<std::ptrdiff_t>(end - row);
    rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return rows;
}

Pixels Source::read(const gl::Texture& texture, int channels, int layer) const {
  if (pixel) return {channels, gl::read_float_texel(texture, channels, pixel->x, texture.height() - 1 - pixel->y)};
  const auto row = static_cast<std::size_t>(texture.width()) * static_cast<std::size_t>(channels);
  return {channels, rows_top_down(gl::read_floats(texture, channels, 0, layer), row)};
}

// Small integers, which floats represent exactly.
Pixels Source::read_bits(const gl::Texture& texture, int scale) const {
  const int width = frame.gbuffer.depth->width(), height = frame.gbuffer.depth->height();
  if (pixel) {
    const auto bits = gl::read_uint_texel(texture, 1, pixel->x / scale, (height - 1 - pixel->y) / scale);
    return {1, rows_top_down(bits, 1)};
  }
  const std::vector<unsigned> bits = gl::read_uints(texture, 1);
  std::vector<unsigned> of_pixels;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      of_pixels.push_back(bits[static_cast<std::size_t>(y / scale * texture.width() + x / scale)]);
  }
  return {1, rows_top_down(of_pixels, static_cast<std::size_t>(width))};
}

// Converts each pixel of `picture` by a function that appends the result's values.
template <class Convert>
std::vector<float> each(const Pixels& picture, Convert convert) {
  std::vector<float> result;
  for (std::size_t i = 0; i < picture.pixels(); ++i) convert(i, picture[i], result);
  return result;
}

bool is_sky(const Pixels& depth, std::size_t pixel) { return depth.values[pixel] == 0.0f; }

void append(std::vector<float>& values, const glm::vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

std::vector<float> color(const Source& from) {
  float exposure = 1.0f;
  gl::glGetNamedBufferSubData(from.frame.exposure->id(), 0, sizeof(exposure), &exposure);
  return each(from.read(*from.frame.color, 3), [&](std::size_t, const float* p, std::vector<float>& out) {
    append(out, exposure * glm::vec3(p[0], p[1], p[2]));
  });
}

std::vector<float> depth(const Source& from) {
  const Camera& camera = from.frame.camera;
  return each(from.read(*from.frame.gbuffer.depth, 1), [&](std::size_t, const float* p, std::vector<float>& out) {
    const float metres = camera.orthographic ? camera.far - p[0] * (camera.far - camera.near) : camera.near / p[0];
    out.push_back(p[0] == 0.0f ? 0.0f : metres);
  });
}

std::vector<float> position(const Source& from) {
  const glm::dmat4 clip_to_world = glm::inverse(glm::dmat4(from.frame.view.world_to_clip));
  const Pixels stored = from.read(*from.frame.gbuffer.depth, 1);
  const auto width = static_cast<std::size_t>(from.frame.gbuffer.depth->width());
  const glm::dvec2 scale = 2.0 / glm::dvec2(from.frame.gbuffer.depth->width(), from.frame.gbuffer.depth->height());
  return each(stored, [&](std::size_t i, const float* p, std::vector<float>& out) {
    const glm::ivec2 at = from.pixel.value_or(glm::ivec2(i % width, i / width));  // counted from the upper left
    const glm::dvec2 from_corner = (glm::dvec2(at) + 0.5) * scale;
    const glm::dvec4 world = clip_to_world * glm::dvec4(from_corner.x - 1.0, 1.0 - from_corner.y, p[0], 1.0);
    append(out, is_sky(stored, i) ? glm::vec3(0.0f) : glm::vec3(glm::dvec3(world) / world.w));
  });
}

std::vector<float> normals(const Source& from, const gl::Texture& texture, float scale, float offset) {
  const Pixels sky = from.read(*from.frame.gbuffer.depth, 1);
  return each(from.read(texture, 2), [&](std::size_t i, const float* p, std::vector<float>& out) {
    const glm::vec3 normal = glsl::octahedral_decode({p[0] * scale + offset, p[1] * scale + offset});
    append(out, is_sky(sky, i) ? glm::vec3(0.0f) : normal);
  });
}

std::vector<float> shading_normal(const Source& from) { return normals(from, *from.frame.gbuffer.normal, 2.0f, -1.0f); }
std::vector<float> geometric_normal(const Source& from) {
  return normals(from, *from.frame.gbuffer.geometric_normal, 1.0f, 0.0f);
}

std::vector<float> albedo(const Source& from) {
  return each(from.read(*from.frame.gbuffer.albedo, 3), [](std::size_t, const float* p, std::vector<float>& out) {
    append(out, glm::vec3(p[0] * p[0], p[1] * p[1], p[2] * p[2]));
  });
}

std::vector<float> material(const Source& from) { return from.read(*from.frame.gbuffer.material, 3).values; }
std::vector<float> emission(const Source& from) {
  const gl::Texture* texture = from.frame.gbuffer.emission;
  if (texture != nullptr) return from.read(*texture, 3).values;
  return std::vector<float>(from.read(*from.frame.gbuffer.depth, 1).pixels() * 3, 0.0f);  // nothing emits light
}

std::vector<float> motion(const Source& from) {
  const glm::vec2 half(from.frame.view.viewport.x * 0.5f, from.frame.view.viewport.y * 0.5f);
  return each(from.read(*from.frame.gbuffer.motion, 2), [&](std::size_t, const float* p, std::vector<float>& out) {
    out.insert(out.end(), {p[0] * half.x, -p[1] * half.y});
  });
}

// Of visibility and, with `channels` 4, its details.
template <class Convert>
std::vector<float> of_mask(const Source& from, int channels, Convert convert) {
  const Pixels sky = from.read(*from.frame.gbuffer.depth, 1);
  return each(
      from.read(*from.frame.mask.texture, channels, static_cast<int>(from.light)),
      [&](std::size_t i, const float* p, std::vector<float>& out) { out.push_back(convert(p, is_sky(sky, i))); });
}

std::vector<float> visibility(const Source& from) {
  return of_mask(from, 1, [](const float* p, bool) { return p[0]; });
}
std::vector<float> penumbra_width(const Source& from) {
  return of_mask(from, 4, [](const float* p, bool) { return 2.0f * p[1]; });
}
std::vector<float> blocker(const Source& from) {
  return of_mask(from, 4, [](const float* p, bool) { return p[2]; });
}
std::vector<float> cascade(const Source& from) {
  return of_mask(from, 4, [](const float* p, bool sky) { return sky ? -1.0f : std::floor(p[3]); });
}
std::vector<float> under_texel(const Source& from) {
  return of_mask(from, 4, [](const float* p, bool) { return p[3] - std::floor(p[3]) >= 0.25f ? 1.0f : 0.0f; });
}

// Of the light's shadow map: the side of a square of the texel's area.
std::vector<float> texel(const Source& from) {
  const gl::Texture& depth_texture = *from.frame.gbuffer.depth;
  const auto width = static_cast<float>(depth_texture.width()), height = static_cast<float>(depth_texture.height());
  const glm::mat4 projection = projection_of(from.frame.camera, width / height);
  const float pixel = 2.0f / (projection[1][1] * height);  // metres, at a distance of one metre in perspective
  const std::vector<float> distances = depth(from), layers = cascade(from);
  const shadow::LightProjection& maps = from.frame.mask.lights[from.light].projection;
  std::vector<float> texels;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (layers[i] < 0) {  // the sky
      texels.push_back(0);
      continue;
    }
    const float of_pixel = from.frame.camera.orthographic ? pixel : pixel * distances[i];
    const glm::vec2 of_map = maps.texel(static_cast<int>(layers[i]));
    texels.push_back((of_map.x == of_map.y ? of_map.x : std::sqrt(of_map.x * of_map.y)) / of_pixel);
  }
  return texels;
}

std::vector<float> history(const Source& from) {
  const Pixels sky = from.read(*from.frame.gbuffer.depth, 1);
  const shadow::LightFrame& light = from.frame.mask.lights[from.light];
  const gl::Texture* notes = light.notes;
  if (notes == nullptr) {
    return each(sky, [&](std::size_t i, const float*, std::vector<float>& out) {
      out.push_back(is_sky(sky, i) ? -1.0f : static_cast<float>(HISTORY_NONE));
    });
  }
  const Pixels bits = from.read_bits(*notes, light.scale);
  return each(sky, [&](std::size_t i, const float*, std::vector<float>& out) {
    const auto note = static_cast<unsigned>(bits.values[i]);
    out.push_back(is_sky(sky, i) ? -1.0f : static_cast<float>(glsl::notes_refusal(note)));
  });
}

// Of a channel of the mask beside visibility.
Aov detail(const char* name, const char* help, Reduction reduction) {
  return {
      .name = name, .help = help, .channels = {"V"}, .reduction = reduction, .mask_details = true, .of_light = true};
}

// The part of a whole frame's values that is asked for.
std::vector<float> at_pixel(const std::vector<float>& values, std::size_t channels, const Source& from) {
  if (!from.pixel) return values;
  const glm::ivec2& at = *from.pixel;
  const auto first =
      values.begin() + (at.y * from.frame.gbuffer.depth->width() + at.x) * static_cast<std::ptrdiff_t>(channels);
  return {first, first + static_cast<std::ptrdiff_t>(channels)};
}

struct Row {
  Aov aov;
  std::vector<float> (*read)(const Source&);
};

const std::vector<Row>& rows() {
  static const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"}, v{"V"};
  using enum Reduction;
  static const std::vector<Row> all{
      {{"color", "Linear light, exposed, before the tone map.", rgb, mean}, color},
      {{.name = "shadow", .help = "Visibility of the light: 1 lit, 0 in shadow.", .channels = v, .of_light = true},
       visibility},
      {{"depth", "Distance from the camera's plane, m; 0 for the sky.", {"Z"}, nearest_center}, depth},
      {{"position", "Position of the surface, world space, m; 0 for the sky.", xyz, nearest_center}, position},
      {{"normal", "Shading normal, world space; 0 for the sky.", xyz, nearest_center}, shading_normal},
      {{"geometric_normal", "Normal of the triangle itself, world space, facing the camera; 0 for the sky.", xyz,
        nearest_center},
       geometric_normal},
      {{"albedo", "Base colour, linear.", rgb, mean}, albedo},
      {{"material", "Metallic, roughness, occlusion.", rgb, mean}, material},
      {{"emission", "Emitted light as the file gives it.", rgb, mean}, emission},
      {{.name = "motion",
        .help = "Motion vector: where a surface is minus where it was in the last frame, pixels, x to the right and y "
                "down.",
        .channels = {"X", "Y"},
        .reduction = nearest_center,
        .in_pixels = true},
       motion},
      {detail("cascade", "Layer of the shadow map that is read, for a sun its cascade, 0 the finest; -1 for the sky.",
              nearest_center),
       cascade},
      {detail("blocker", "Mean distance from a surface to what hides the light, m; 0 for none.", mean_of_valid),
       blocker},
      {detail("penumbra", "Full width of the penumbra, m; 0 where nothing hides the light.", mean_of_valid),
       penumbra_width},
      {detail("under_texel", "1 where the penumbra is narrower than the shadow map can show.", nearest_center),
       under_texel},
      {{.name = "texel",
        .help = "Width of a texel of the shadow map that is read, in widths of a pixel at the surface; 0 for the sky.",
        .channels = v,
        .reduction = nearest_center,
        .in_pixels = true,
        .mask_details = true,
        .of_light = true},
       texel},
      {{.name = "history",
        .help = "Why the shadow of the last frames is not used: 0 it is used, 1 there is none, 2 the surface was off "
                "screen, 3 another surface was there, 4 a caster moved; -1 for the sky.",
        .channels = v,
        .reduction = nearest_center,
        .of_light = true},
       history},
  };
  return all;
}

}  // namespace

const std::vector<Aov>& aovs() {
  static const std::vector<Aov> all = [] {
    std::vector<Aov> list;
    for (const Row& row : rows()) list.push_back(row.aov);
    return list;
  }();
  return all;
}

std::vector<float> read_aov(const FrameParts& frame, std::string_view name, int light,
                            std::optional<glm::ivec2> pixel) {
  std::vector<std::string> names;
  for (const Row& row : rows()) {
    if (row.aov.name == name) {
      if (row.aov.mask_details && frame.mask.texture->desc().format != GL_RGBA16F)
        fail("aov '{}' was not kept: the frame was drawn without details of its mask", name);
      const Source source{frame, static_cast<std::size_t>(light), pixel};
      const auto mean = frame.means.find(name);
      if (mean == frame.means.end()) return row.read(source);
      return at_pixel(mean->second.at(source.light), row.aov.channels.size(), source);
    }
    names.push_back(row.aov.name);
  }
  fail_unknown("aov", name, names);
}

}  // namespace penumbra::render
