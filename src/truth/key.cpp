#include <span>
#include <type_traits>
#include <variant>

#include "truth/cache.h"

namespace penumbra::truth {

namespace {

// Increment it whenever the same input produces another picture, so that old cache files are ignored.
constexpr int generation = 1;

// Of plain values without padding.
class Hash {
 public:
  Hash() { add(generation); }

  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    hasher_.add(std::as_bytes(std::span(&value, 1)));
  }
  template <int n, class T>
  void add(const glm::vec<n, T>& value) {
    for (int i = 0; i < n; ++i) add(value[i]);
  }
  // Hashes elements without padding, and how many there are.
  template <class T>
  void add_all(std::span<const T> values) {
    add(values.size());
    hasher_.add(std::as_bytes(values));
  }

  Key key() const { return hasher_.key(); }

 private:
  io::Hasher hasher_;
};

void add_texture(Hash& hash, const scene::Scene& scene, const scene::TextureRef& ref) {
  hash.add(ref.texture >= 0);
  if (ref.texture < 0) return;
  const scene::Texture& texture = scene.textures[static_cast<std::size_t>(ref.texture)];
  hash.add(ref.uv_set);
  for (int column = 0; column < 3; ++column) hash.add(ref.uv_transform[column]);
  hash.add(texture.wrap_s);
  hash.add(texture.wrap_t);
  hash.add(texture.mag);
  hash.add(texture.image >= 0);
  if (texture.image < 0) return;
  const scene::Image& image = scene.images[static_cast<std::size_t>(texture.image)];
  hash.add(image.width);
  hash.add(image.height);
  hash.add_all(std::span(image.rgba));
}

void add_alpha(Hash& hash, const scene::Scene& scene, const scene::Primitive& primitive) {
  hash.add(primitive.material);
  if (primitive.material >= 0) {
    const scene::Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
    hash.add(material.base_color.a);
    hash.add(material.alpha_mode);
    hash.add(material.alpha_cutoff);
    add_texture(hash, scene, material.base_color_texture);
  }
  for (const std::vector<glm::vec2>& uvs : primitive.uvs) hash.add_all(std::span(uvs));
  hash.add_all(std::span(primitive.colors));
}

void add_light(Hash& hash, const TracedSun& sun) {
  hash.add(sun.to_light);
  hash.add(sun.angle);
  hash.add(sun.square);
}

void add_light(Hash& hash, const LocalLight& light) {
  hash.add(light.position);
  hash.add(light.radius);
  hash.add(false);  // so that keys of older cache files stay valid: lamps could be discs with an axis
  // Nor are defaults hashed, for the same reason.
  if (light.clear > 0) hash.add(light.clear);
  if (light.cone) {
    hash.add(light.cone->axis);
    hash.add(light.cone->cosine);
  }
  if (light.range > 0) hash.add(light.range);
}

}  // namespace

Key key_of(const scene::Scene& scene, const scene::PosedGeometry& geometry) {
  Hash hash;
  for (const scene::PosedSurface& surface : geometry.surfaces) {
    hash.add(surface.casts);
    if (surface.casts == scene::CastMode::never) continue;
    // The default is not hashed, so that keys of older cache files stay valid.
    if (surface.faces != scene::CasterFaces::both) {
      hash.add(surface.faces);
      hash.add(surface.mirrored);
    }
    for (int column = 0; column < 4; ++column) hash.add(surface.world[column]);
    hash.add_all(surface.positions);
    hash.add_all(std::span(surface.primitive->indices));
    if (surface.casts == scene::CastMode::by_alpha) add_alpha(hash, scene, *surface.primitive);
  }
  return hash.key();
}

Key key_of(const Key& casters, std::span<const Receiver> receivers, int width, const TracedLight& light,
           const TraceOptions& options) {
  Hash hash;
  hash.add(casters);
  hash.add(width);
  hash.add(receivers.size());
  for (const Receiver& receiver : receivers) {
    hash.add(receiver.there);
    if (!receiver.there) continue;
    hash.add(receiver.position);
    hash.add(receiver.normal);
    hash.add(receiver.extent);
  }
  hash.add(light.index());
  std::visit([&](const auto& kind) { add_light(hash, kind); }, light);
  hash.add(options.samples);
  hash.add(options.error);
  hash.add(options.seed);
  return hash.key();
}

Key key_of(const Traced& traced) {
  Hash hash;
  for (const auto layer : {&Traced::visibility, &Traced::standard_error, &Traced::hard})
    hash.add_all(std::span(traced.*layer));
  hash.add(traced.rays);
  hash.add(traced.seconds);
  hash.add(traced.samples);
  return hash.key();
}

}  // namespace penumbra::truth
