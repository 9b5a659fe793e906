#include <algorithm>
#include <optional>

#include "core/log.h"
#include "scene/gltf/accessor.h"
#include "scene/gltf/read.h"
#include "scene/pose.h"

namespace penumbra::scene::gltf {
namespace {

std::optional<Path> to_path(const std::string& name) {
  if (name == "translation") return Path::translation;
  if (name == "rotation") return Path::rotation;
  if (name == "scale") return Path::scale;
  if (name == "weights") return Path::weights;
  return std::nullopt;  // KHR_animation_pointer or a future extension
}

Interpolation to_interpolation(const std::string& name) {
  if (name == "STEP") return Interpolation::step;
  return name == "CUBICSPLINE" ? Interpolation::cubic_spline : Interpolation::linear;
}

int component_count(const Scene& scene, const Node& node, Path path) {
  if (path == Path::rotation) return 4;
  if (path != Path::weights) return 3;
  if (node.mesh < 0) return 0;
  return static_cast<int>(scene.meshes[static_cast<std::size_t>(node.mesh)].default_weights.size());
}

void read_keys(Document& document, const tinygltf::AnimationSampler& sampler, AnimationChannel& channel) {
  const AccessorView input = view_accessor(document, sampler.input), output = view_accessor(document, sampler.output);
  expect_components(input, 1);
  if (input.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) fail("{} must hold floats", input.name);
  expect_components(output, channel.path == Path::weights ? 1 : channel.components);
  document.budget.spend(input.count, sizeof(float));
  document.budget.spend(output.count, static_cast<std::size_t>(output.components) * sizeof(float));
  channel.times = read_numbers(input);
  channel.values = read_numbers(output);
  for (std::size_t k = 0; k < channel.times.size(); ++k)
    if (channel.times[k] < 0 || (k > 0 && channel.times[k] < channel.times[k - 1]))
      fail("key times must grow from zero; key {} is at {}", k, channel.times[k]);
  const std::size_t values_a_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
  const std::size_t expected = channel.times.size() * values_a_key * static_cast<std::size_t>(channel.components);
  if (channel.values.size() != expected) fail("{} values for its keys, not {}", channel.values.size(), expected);
}

// Nothing if the channel has no target that this program supports.
std::optional<AnimationChannel> read_channel(Document& document, const Scene& scene,
                                             const tinygltf::Animation& animation,
                                             const tinygltf::AnimationChannel& in) {
  const auto path = to_path(in.target_path);
  if (!path || in.target_node < 0) return std::nullopt;
  if (static_cast<std::size_t>(in.sampler) >= animation.samplers.size())
    fail("sampler {}, but there are {}", in.sampler, animation.samplers.size());
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(in.sampler)];
  const Node& node = scene.nodes[static_cast<std::size_t>(in.target_node)];
  AnimationChannel channel{
      .node = in.target_node, .path = *path, .interpolation = to_interpolation(sampler.interpolation)};
  channel.components = component_count(scene, node, *path);
  if (channel.components == 0) return std::nullopt;  // weights of a mesh without morph targets
  read_keys(document, sampler, channel);
  return channel;
}

Animation read_animation(Document& document, const Scene& scene, std::size_t number) {
  const tinygltf::Animation& in = document.model.animations[number];
  Animation animation{.name = in.name};
  for (std::size_t i = 0; i < in.channels.size(); ++i) {
    try {
      auto channel = read_channel(document, scene, in, in.channels[i]);
      if (!channel) continue;
      animation.duration = std::max(animation.duration, channel->times.back());
      animation.channels.push_back(std::move(*channel));
    } catch (const Error& e) {
      const int node = in.channels[i].target_node;
      document.left_out.add_part(fmt::format("animations[{}].channels[{}]", number, i),
                                 node >= 0 && document.left_out.used().holds("nodes", static_cast<std::size_t>(node)),
                                 e.what());
    }
  }
  return animation;
}

}  // namespace

void read_animations(Document& document, Scene& scene) {
  for (std::size_t i = 0; i < document.model.animations.size(); ++i)
    scene.animations.push_back(read_animation(document, scene, i));
  // Animation changes a node's translation, rotation and scale separately, which a matrix can't provide.
  for (const Animation& animation : scene.animations)
    for (const AnimationChannel& channel : animation.channels) {
      Node& node = scene.nodes[static_cast<std::size_t>(channel.node)];
      if (!node.matrix || channel.path == Path::weights) continue;
      node.transform = to_transform(*node.matrix);
      node.matrix.reset();
    }
}

}  // namespace penumbra::scene::gltf
