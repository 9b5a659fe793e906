// Materials, textures and the images behind them.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "image/read.h"
#include "support/gltf_files.h"
#include "support/scene_faults.h"

namespace penumbra::test {
namespace {

using scene::Filter;
using scene::Scene;
using scene::TextureRef;
using scene::Wrap;

// A document with a material that is drawn, three textures and an image each.
std::string with_material(const std::string& material, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"materials":[{)" + material +
         R"(}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{},"material":0}]}],)"
         R"("textures":[{"source":0},{"source":1},{"source":2}],"images":[)"
         R"({"uri":"data:;base64,AAAA"},{"uri":"data:;base64,BBBB"},{"uri":"data:;base64,CCCC"}])" +
         more + "}";
}

Scene load_material(const std::string& material) {
  Scene scene = load_text(with_material(material));
  check_scene(scene);
  return scene;
}

TEST(GltfMaterial, HasTheStandardsDefaults) {
  const scene::Material material = load_material("").materials[0];
  EXPECT_EQ(material.base_color, glm::vec4(1));
  EXPECT_EQ(material.metallic, 1);
  EXPECT_EQ(material.roughness, 1);
  EXPECT_EQ(material.emissive, glm::vec3(0));
  EXPECT_EQ(material.alpha_cutoff, 0.5f);
  EXPECT_EQ(material.alpha_mode, scene::AlphaMode::opaque);
}

TEST(GltfMaterial, ReadsFactorsAndExtensions) {
  const scene::Material material =
      load_material(R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,0.5],"metallicFactor":0,)"
                    R"("roughnessFactor":0.5},"emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.25,)"
                    R"("normalTexture":{"index":0,"scale":0.25},"occlusionTexture":{"index":0,"strength":0.75},)"
                    R"("emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{"texCoord":1}}},)"
                    R"("doubleSided":true,"extensions":{"KHR_materials_unlit":{},)"
                    R"("KHR_materials_emissive_strength":{"emissiveStrength":4}})")
          .materials[0];
  EXPECT_EQ(material.base_color, glm::vec4(1, 0.5f, 0.25f, 0.5f));
  EXPECT_EQ(material.roughness, 0.5f);
  EXPECT_EQ(material.normal_scale, 0.25f);
  EXPECT_EQ(material.occlusion_strength, 0.75f);
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
  EXPECT_EQ(material.emissive_texture.uv_set, 1);
  EXPECT_EQ(material.alpha_cutoff, 0.25f);
  EXPECT_EQ(material.alpha_mode, scene::AlphaMode::mask);
  EXPECT_TRUE(material.double_sided && material.unlit);
}

TEST(GltfMaterial, ApproximatesSpecularGlossiness) {
  const Scene scene =
      load_material(R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.5,0.25,1,1],)"
                    R"("glossinessFactor":0.75,"diffuseTexture":{"index":1}}})");
  EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0.5f, 0.25f, 1, 1));
  EXPECT_EQ(scene.materials[0].roughness, 0.25f);
  EXPECT_EQ(scene.materials[0].metallic, 0);
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, 1);
}

glm::vec2 mapped(const std::string& transform, const glm::vec2& uv) {
  const TextureRef ref =
      load_material(R"("emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":{)" + transform + "}}}")
          .materials[0]
          .emissive_texture;
  return ref.uv_transform * glm::vec3(uv, 1);
}

TEST(GltfMaterial, TransformsUvsByScaleThenRotationThenOffset) {
  EXPECT_EQ(mapped("", {0.25f, 0.5f}), glm::vec2(0.25f, 0.5f));
  EXPECT_EQ(mapped(R"("offset":[1,2],"scale":[2,4])", {0.25f, 0.5f}), glm::vec2(1.5f, 4));
  // A quarter turn counter-clockwise, seen with v growing downwards, takes +u to -v.
  const glm::vec2 turned = mapped(R"("offset":[0,1],"rotation":1.5707963267948966,"scale":[0.5,1])", {1, 0});
  EXPECT_NEAR(turned.x, 0, 1e-6);
  EXPECT_NEAR(turned.y, 0.5, 1e-6);
}

TEST(GltfMaterial, GivesHighUvSetsASlot) {
  GltfBuilder gltf;
  gltf.add(std::vector<float>{0, 0, 0}, "VEC3", 3);
  gltf.add(std::vector<float>{0.125f, 0.25f}, "VEC2", 2);
  const Scene scene = load_text(
      gltf.text(one_mesh(R"({"attributes":{"POSITION":0,"TEXCOORD_3":1},"mode":0,"material":0})",
                         R"("materials":[{"emissiveTexture":{"index":0,"texCoord":3}}],"textures":[{"source":0}],)"
                         R"("images":[{"uri":"data:;base64,AAAA"}])")));
  const auto slot = static_cast<std::size_t>(scene.materials[0].emissive_texture.uv_set);
  ASSERT_EQ(scene.meshes[0].primitives[0].uvs[slot].size(), 1u);
  EXPECT_EQ(scene.meshes[0].primitives[0].uvs[slot][0], glm::vec2(0.125f, 0.25f));
}

TEST(GltfMaterial, ReadsSamplers) {
  const Scene scene =
      load_text(R"({"asset":{"version":"2.0"},"textures":[{},{"sampler":0},{"sampler":1}],"samplers":[)"
                R"({"magFilter":9728,"minFilter":9985,"wrapS":33071,"wrapT":33648},{"minFilter":9728}]})");
  EXPECT_TRUE(scene.textures[0].mipmapped);
  EXPECT_EQ(scene.textures[0].wrap_s, Wrap::repeat);
  EXPECT_EQ(scene.textures[1].mag, Filter::nearest);
  EXPECT_EQ(scene.textures[1].min, Filter::linear);
  EXPECT_EQ(scene.textures[1].mip, Filter::nearest);
  EXPECT_EQ(scene.textures[1].wrap_s, Wrap::clamp_to_edge);
  EXPECT_EQ(scene.textures[1].wrap_t, Wrap::mirrored_repeat);
  EXPECT_FALSE(scene.textures[2].mipmapped);
}

TEST(GltfMaterial, DecodesOnlyImagesThatAreUsedAndEachOnce) {
  const ScratchFolder folder;
  const auto file =
      folder.write("scene.gltf", with_material(R"("emissiveTexture":{"index":1},"normalTexture":{"index":1},)"
                                               R"("occlusionTexture":{"index":1})"));
  std::vector<std::string> decoded;
  const Scene scene = scene::read_gltf(file, [&](std::span<const std::byte> bytes, const std::string& name) {
    decoded.push_back(name);
    return any_image(bytes, name);
  });
  EXPECT_EQ(decoded, std::vector<std::string>{"images[1]"});
  EXPECT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.textures[1].image, 0);
  EXPECT_EQ(scene.textures[0].image, -1);
}

TEST(GltfMaterial, NamesTheImageThatCantBeDecoded) {
  const ScratchFolder folder;
  const auto file = folder.write("scene.gltf", with_material(R"("emissiveTexture":{"index":2})"));
  EXPECT_EQ(error_of([&] { scene::read_gltf(file, no_image); }),
            file.string() + ": images[2]: no decoder for images[2]");
}

TEST(GltfMaterial, RefusesTexturesThatAreNotThere) {
  EXPECT_NE(error_of([] {
              load_text(with_material(R"("normalTexture":{"index":3})"));
            }).find("materials[0].normalTexture.index is 3, but there are 3 textures"),
            std::string::npos);
}

TEST(GltfMaterial, LimitsWhatAllImagesDecodeTo) {
  const ScratchFolder folder;
  const auto file =
      folder.write("scene.gltf", with_material(R"("emissiveTexture":{"index":2},"normalTexture":{"index":0})"));
  const auto megapixel = [](std::span<const std::byte>, const std::string& name) {
    return scene::Image{.name = name, .width = 1024, .height = 1024, .rgba = std::vector<uint8_t>(4 << 20)};
  };
  EXPECT_NO_THROW(scene::read_gltf(file, megapixel, {.limits = {.image_bytes = 9 << 20}}));
  const auto over = [&] { scene::read_gltf(file, megapixel, {.limits = {.image_bytes = 7 << 20}}); };
  EXPECT_NE(error_of(over).find("the images decode to more, over the limit of 7 MiB; --limit images=SIZE"),
            std::string::npos);
}

TEST(GltfMaterial, KnowsWhatAllImagesTakeBeforeTheFirstIsDecoded) {
  const ScratchFolder folder;
  const auto file =
      folder.write("scene.gltf", with_material(R"("emissiveTexture":{"index":2},"normalTexture":{"index":0})"));
  int decoded = 0;
  const scene::ImageDecoder counting(
      [&](std::span<const std::byte> bytes, const std::string& name) {
        ++decoded;
        return any_image(bytes, name);
      },
      [](const scene::ReadAt&) {
        return scene::ImageHeader{.width = 1 << 12, .height = 1 << 12, .channels = 3, .decoded_bytes = 64 << 20};
      });
  const std::string message =
      error_of([&] { scene::read_gltf(file, counting, {.limits = {.image_bytes = 100 << 20}}); });
  EXPECT_EQ(message, file.string() +
                         ": 2 images take 128 MiB when decoded, over the limit of 100 MiB; "
                         "--limit images=SIZE changes it");
  EXPECT_EQ(error_of([&] { scene::read_gltf(file, counting, {.limits = {.image_pixels = 1 << 23}}); }),
            file.string() +
                ": images[0]: 4096 x 4096 pixels, over the limit of 8388608; "
                "--limit image-pixels=N changes it");
  EXPECT_EQ(decoded, 0);
  EXPECT_NO_THROW(scene::read_gltf(file, counting, {.limits = {.image_bytes = 128 << 20}}));
  EXPECT_EQ(decoded, 2);
}

// Bytes that this process has read from files; nothing without /proc.
std::optional<std::size_t> bytes_read() {
  std::ifstream stream("/proc/self/io");
  std::string label;
  std::size_t count = 0;
  if (stream >> label >> count && label == "rchar:") return count;
  return {};
}

TEST(GltfMaterial, ReadsNoMoreThanTheHeadersOfImagesThatAreTooLarge) {
  using namespace std::string_literals;
  constexpr std::uintmax_t size = 900 << 20;  // the rest is a hole in the file
  const std::string png = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\x01\0\0\0\x01\0\0\x08\x06\0\0\0"s;
  const std::string jpeg =
      "\xff\xd8\xff\xe1\xff\xff"s + std::string(65533, 'x') + "\xff\xc0\0\x0b\x08\xff\xff\xff\xff\x01\x01\x11\0"s;
  for (const auto& [name, head] : {std::pair("a.png", png), {"b.jpg", jpeg}}) {
    const ScratchFolder folder;
    std::filesystem::resize_file(folder.write(name, head), size);
    std::string text = with_material(R"("emissiveTexture":{"index":0})");
    const std::string data = "data:;base64,AAAA";
    const auto file = folder.write("scene.gltf", text.replace(text.find(data), data.size(), name));
    const std::optional<std::size_t> before = bytes_read();
    const std::string message = error_of([&] { scene::read_gltf(file, image::image_decoder()); });
    EXPECT_NE(message.find("pixels, over the limit of"), std::string::npos) << message;
    if (before) {
      EXPECT_LT(*bytes_read() - *before, 1u << 20) << name;
    }
  }
}

}  // namespace
}  // namespace penumbra::test
