#include <cmath>

#include "core/names.h"
#include "lib/octahedral.glsl"
#include "lib/packed_texel.glsl"
#include "render/frame.h"

namespace penumbra::render {

namespace {

// A picture on the CPU, rows top to bottom.
struct Picture {
  int channels;
  std::vector<float> values;

  std::size_t pixels() const { return values.size() / static_cast<std::size_t>(channels); }
  const float* operator[](std::size_t pixel) const { return &values[pixel * static_cast<std::size_t>(channels)]; }
};

Picture read(const gl::Texture& texture, int channels, int layer = 0) {
  const std::vector<float> bottom_up = gl::read_floats(texture, channels, 0, layer);
  Picture picture{channels, {}};
  picture.values.reserve(bottom_up.size());
  const auto row = static_cast<std::size_t>(texture.width()) * static_cast<std::size_t>(channels);
  for (auto y = static_cast<std::size_t>(texture.height()); y-- > 0;) {
    const auto begin = bottom_up.begin() + static_cast<std::ptrdiff_t>(y * row);
    picture.values.insert(picture.values.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return picture;
}

// Each pixel of `picture` by a function that appends its values.
template <class Convert>
std::vector<float> each(const Picture& picture, Convert convert) {
  std::vector<float> result;
  for (std::size_t i = 0; i < picture.pixels(); ++i) convert(i, picture[i], result);
  return result;
}

bool is_sky(const Picture& depth, std::size_t pixel) { return depth.values[pixel] == 0.0f; }

void append(std::vector<float>& values, const glm::vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

std::vector<float> color(const FrameParts& frame) {
  float exposure = 1.0f;
  gl::glGetNamedBufferSubData(frame.exposure->id(), 0, sizeof(exposure), &exposure);
  return each(read(*frame.lit, 3), [&](std::size_t, const float* p, std::vector<float>& out) {
    append(out, exposure * glm::vec3(p[0], p[1], p[2]));
  });
}

std::vector<float> depth(const FrameParts& frame) {
  const Camera& camera = frame.camera;
  return each(read(*frame.gbuffer.depth, 1), [&](std::size_t, const float* p, std::vector<float>& out) {
    const float metres = camera.orthographic ? camera.far - p[0] * (camera.far - camera.near) : camera.near / p[0];
    out.push_back(p[0] == 0.0f ? 0.0f : metres);
  });
}

std::vector<float> normals(const FrameParts& frame, const gl::Texture& texture, float scale, float offset) {
  const Picture sky = read(*frame.gbuffer.depth, 1);
  return each(read(texture, 2), [&](std::size_t i, const float* p, std::vector<float>& out) {
    const glm::vec3 normal = glsl::octahedral_decode({p[0] * scale + offset, p[1] * scale + offset});
    append(out, is_sky(sky, i) ? glm::vec3(0.0f) : normal);
  });
}

std::vector<float> shading_normal(const FrameParts& frame) {
  return normals(frame, *frame.gbuffer.normal, 2.0f, -1.0f);
}
std::vector<float> geometric_normal(const FrameParts& frame) {
  return normals(frame, *frame.gbuffer.geometric_normal, 1.0f, 0.0f);
}

std::vector<float> albedo(const FrameParts& frame) {
  return each(read(*frame.gbuffer.albedo, 3), [](std::size_t, const float* p, std::vector<float>& out) {
    append(out, glm::vec3(p[0] * p[0], p[1] * p[1], p[2] * p[2]));
  });
}

std::vector<float> material(const FrameParts& frame) { return read(*frame.gbuffer.material, 3).values; }
std::vector<float> emission(const FrameParts& frame) { return read(*frame.gbuffer.emission, 3).values; }

std::vector<float> motion(const FrameParts& frame) {
  const glm::vec2 half(frame.view.viewport.x * 0.5f, frame.view.viewport.y * 0.5f);
  return each(read(*frame.gbuffer.motion, 2), [&](std::size_t, const float* p, std::vector<float>& out) {
    out.insert(out.end(), {p[0] * half.x, -p[1] * half.y});
  });
}

template <class Convert>
std::vector<float> of_mask(const FrameParts& frame, Convert convert) {
  const Picture sky = read(*frame.gbuffer.depth, 1);
  return each(read(*frame.mask.texture, 4), [&](std::size_t i, const float* p, std::vector<float>& out) {
    out.push_back(convert(p, is_sky(sky, i)));
  });
}

std::vector<float> visibility(const FrameParts& frame) {
  return of_mask(frame, [](const float* p, bool) { return p[0]; });
}
std::vector<float> penumbra_width(const FrameParts& frame) {
  return of_mask(frame, [](const float* p, bool) { return 2.0f * p[1]; });
}
std::vector<float> blocker(const FrameParts& frame) {
  return of_mask(frame, [](const float* p, bool) { return p[2]; });
}
std::vector<float> cascade(const FrameParts& frame) {
  return of_mask(frame, [](const float* p, bool sky) { return sky ? -1.0f : std::floor(p[3]); });
}
std::vector<float> under_texel(const FrameParts& frame) {
  return of_mask(frame, [](const float* p, bool) { return p[3] - std::floor(p[3]) >= 0.25f ? 1.0f : 0.0f; });
}

// Of the sun, whose light is the frame's first.
std::vector<float> history(const FrameParts& frame) {
  const Picture sky = read(*frame.gbuffer.depth, 1);
  const gl::Texture* notes = frame.mask.lights.front().notes;
  if (notes == nullptr) {
    return each(sky, [&](std::size_t i, const float*, std::vector<float>& out) {
      out.push_back(is_sky(sky, i) ? -1.0f : static_cast<float>(HISTORY_NONE));
    });
  }
  const std::vector<unsigned> bits = gl::read_uints(*notes, 1);
  const auto width = static_cast<std::size_t>(notes->width());
  const auto height = static_cast<std::size_t>(notes->height());
  return each(sky, [&](std::size_t i, const float*, std::vector<float>& out) {
    const std::size_t flipped = (height - 1 - i / width) * width + i % width;
    out.push_back(is_sky(sky, i) ? -1.0f : static_cast<float>(glsl::notes_refusal(bits[flipped])));
  });
}

struct Row {
  Aov aov;
  std::vector<float> (*read)(const FrameParts&);
};

const std::vector<Row>& rows() {
  static const std::vector<std::string> rgb{"R", "G", "B"}, xyz{"X", "Y", "Z"}, v{"V"};
  using enum Reduction;
  static const std::vector<Row> all{
      {{"color", "Linear light, exposed, before the tone map.", rgb, mean}, color},
      {{"shadow", "Visibility of the sun: 1 lit, 0 in shadow.", v, mean}, visibility},
      {{"depth", "Distance from the camera's plane, m; 0 for the sky.", {"Z"}, nearest_center}, depth},
      {{"normal", "Shading normal, world space; 0 for the sky.", xyz, nearest_center}, shading_normal},
      {{"geometric_normal", "Normal of the triangle itself, world space, facing the camera; 0 for the sky.", xyz,
        nearest_center},
       geometric_normal},
      {{"albedo", "Base colour, linear.", rgb, mean}, albedo},
      {{"material", "Metallic, roughness, occlusion.", rgb, mean}, material},
      {{"emission", "Emitted light as the file gives it.", rgb, mean}, emission},
      {{.name = "motion",
        .help = "Where a surface is minus where it was in the last frame, pixels, x to the right and y down.",
        .channels = {"X", "Y"},
        .reduction = nearest_center,
        .in_pixels = true},
       motion},
      {{"cascade", "Cascade of the shadow map, 0 the finest; -1 for the sky.", v, nearest_center}, cascade},
      {{"blocker", "Mean distance from a surface to what hides the sun, m; 0 for none.", v, mean_of_valid}, blocker},
      {{"penumbra", "Full width of the penumbra, m; 0 where nothing hides the sun.", v, mean_of_valid}, penumbra_width},
      {{"under_texel", "1 where the penumbra is narrower than the shadow map can show.", v, nearest_center},
       under_texel},
      {{"history",
        "What became of the last frames' shadow: 0 kept, 1 there is none, 2 it was off screen, 3 another surface was "
        "there, 4 a caster moved; -1 for the sky.",
        v, nearest_center},
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

std::vector<float> read_aov(const FrameParts& frame, std::string_view name) {
  std::vector<std::string> names;
  for (const Row& row : rows()) {
    if (row.aov.name == name) return row.read(frame);
    names.push_back(row.aov.name);
  }
  fail_unknown("aov", name, names);
}

}  // namespace penumbra::render
