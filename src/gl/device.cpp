#include "device.h"

#include <array>
#include <atomic>
#include <cmath>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "../core/error.h"
#include "context.h"
#include "debug.h"
#include "pass_state.h"

namespace penumbra::gl {
namespace {

void delete_framebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }
void delete_vertex_array(GLuint id) { glDeleteVertexArrays(1, &id); }

// Of the vertex array without vertices. Contexts don't share vertex arrays, so the name tells a context from others.
std::string next_name() {
  static std::atomic<std::uint64_t> last{0};
  return fmt::format("no vertices, device {}", ++last);
}

std::string label_of(GLenum kind, GLuint id) {
  std::array<GLchar, 64> text{};
  glGetObjectLabel(kind, id, static_cast<GLsizei>(text.size()), nullptr, text.data());
  return text.data();
}

// What identifies a framebuffer's attachment; zeros: none. Penumbra's own textures are identified by serial, as a
// driver reuses ids and a framebuffer keeps drawing to the deleted texture. Foreign textures have no serial: they are
// attached again for every pass, so only what affects framebuffer completeness is compared.
struct AttachmentKey {
  std::uint64_t serial = 0;
  GLenum target = 0, format = 0;
  int width = 0, height = 0, level = 0, layer = 0;
  auto operator<=>(const AttachmentKey&) const = default;
};

// Depth first.
using FramebufferKey = std::vector<AttachmentKey>;

AttachmentKey key_of(const Attachment& attachment) {
  const TextureDesc& desc = attachment.texture->desc();
  return {attachment.texture->serial(),
          desc.target,
          desc.format,
          desc.width,
          desc.height,
          attachment.level,
          attachment.layer};
}

struct CachedFramebuffer {
  Handle<delete_framebuffer> handle;
  std::uint64_t last_use = 0;
};

using SamplerKey = std::tuple<GLenum, GLenum, GLenum, GLenum, bool, float, float>;

void attach(GLuint framebuffer, GLenum point, const Attachment& attachment) {
  const Texture& texture = *attachment.texture;
  if (texture.desc().target == GL_TEXTURE_2D_ARRAY && attachment.layer != Attachment::all_layers) {
    glNamedFramebufferTextureLayer(framebuffer, point, texture.id(), attachment.level, attachment.layer);
  } else {
    glNamedFramebufferTexture(framebuffer, point, texture.id(), attachment.level);
  }
}

Handle<delete_framebuffer> make_framebuffer(std::string_view name, std::span<const Attachment> colors,
                                            const Attachment* depth) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  Handle<delete_framebuffer> handle(id);
  label(GL_FRAMEBUFFER, id, name);
  std::vector<GLenum> draw_buffers;
  for (const Attachment& color : colors) {
    const GLenum point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size());
    attach(id, point, color);
    draw_buffers.push_back(point);
  }
  if (depth != nullptr) attach(id, depth_attachment_point(*depth->texture), *depth);
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
  if (draw_buffers.empty()) glNamedFramebufferReadBuffer(id, GL_NONE);
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    fail("pass '{}': the driver refuses the framebuffer (status {:#x})", name, status);
  return handle;
}

// Not std::this_thread::get_id(), which a later thread may have again.
std::uint64_t this_thread() {
  static std::atomic<std::uint64_t> threads = 0;
  thread_local const std::uint64_t number = ++threads;
  return number;
}

void attach_foreign(GLuint framebuffer, std::span<const Attachment> colors, const Attachment* depth) {
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (colors[i].texture->is_foreign()) attach(framebuffer, GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i), colors[i]);
  }
  if (depth != nullptr && depth->texture->is_foreign()) {
    attach(framebuffer, depth_attachment_point(*depth->texture), *depth);
  }
}

}  // namespace

struct Device::Impl {
  Api* api = current_api;
  std::uint64_t thread = this_thread();  // the last one that used the device
  const std::string name = next_name();
  std::map<std::string, Texture, std::less<>> targets;
  std::map<std::string, Buffer, std::less<>> buffers;
  std::map<SamplerKey, Sampler> samplers;
  std::map<FramebufferKey, CachedFramebuffer> framebuffers;
  std::uint64_t framebuffer_uses = 0;
  Handle<delete_vertex_array> empty_vertex_array;
  std::optional<bool> debugged;
  std::optional<float> vertex_rounding;

  // A framebuffer keeps its textures' memory. So framebuffers of a target are deleted with it, those of other textures
  // when they have not been used for long.
  void drop_framebuffers_of(const Texture& texture) {
    if (!texture) return;
    std::erase_if(framebuffers, [&](const auto& entry) {
      for (const auto& attachment : entry.first) {
        if (attachment.serial == texture.serial()) return true;
      }
      return false;
    });
  }
  void drop_unused_framebuffers() {
    constexpr std::uint64_t long_ago = 4096;
    std::erase_if(framebuffers, [&](const auto& entry) { return entry.second.last_use + long_ago < framebuffer_uses; });
  }
};

Device::Device(ShaderFiles files, Timers::Mode timing)
    : shaders(std::move(files)), timers(timing), impl_(std::make_unique<Impl>()) {}

Device::~Device() = default;

void Device::aside(const std::function<void()>& action) {
  struct Turn {
    explicit Turn(Device& of) : device(of), before_pass(std::exchange(of.before_pass, nullptr)) {}
    ~Turn() { device.before_pass = std::move(before_pass); }
    Device& device;
    std::function<void()> before_pass;
  };
  const Timers::Break uncounted(timers);
  const Turn turn(*this);
  action();
}

Device& Device::interrupted() {
  if (before_pass) aside(std::function(before_pass));
  return *this;
}

const Texture& Device::target(std::string_view name, const TextureDesc& desc) {
  auto found = impl_->targets.find(name);
  if (found == impl_->targets.end()) found = impl_->targets.emplace(name, Texture()).first;
  Texture& texture = found->second;
  if (!texture || texture.desc() != desc) {
    impl_->drop_framebuffers_of(texture);
    texture = Texture();  // frees memory before more is allocated
    texture = Texture(name, desc);
  }
  return texture;
}

const Buffer& Device::scratch(std::string_view name, std::size_t bytes) {
  auto found = impl_->buffers.find(name);
  if (found == impl_->buffers.end()) found = impl_->buffers.emplace(name, Buffer()).first;
  Buffer& buffer = found->second;
  if (!buffer || buffer.size() < bytes) {
    buffer = Buffer();
    buffer = Buffer(name, bytes);
  }
  return buffer;
}

// Called in every frame, mostly with prefixes that match nothing, so it visits only the entries that it deletes.
void Device::drop(std::string_view prefix, const std::set<std::string, std::less<>>& kept) {
  const auto drop_from = [&](auto& items, const auto& before) {
    auto item = items.lower_bound(prefix);
    while (item != items.end() && item->first.starts_with(prefix)) {
      if (kept.contains(item->first)) {
        ++item;
        continue;
      }
      before(item->second);
      item = items.erase(item);
    }
  };
  drop_from(impl_->targets, [&](const Texture& texture) { impl_->drop_framebuffers_of(texture); });
  drop_from(impl_->buffers, [](const Buffer& /*buffer*/) {});
}

const Sampler& Device::sampler(const SamplerDesc& desc) {
  const SamplerKey key(desc.min_filter, desc.mag_filter, desc.wrap_s, desc.wrap_t, desc.compare, desc.max_anisotropy,
                       desc.lod_bias);
  Sampler& sampler = impl_->samplers[key];
  if (sampler.id() == 0) sampler = Sampler("sampler", desc);
  return sampler;
}

std::vector<Device::NamedTarget> Device::targets() const {
  std::vector<NamedTarget> all;
  for (const auto& [name, texture] : impl_->targets) all.push_back({name, &texture});
  return all;
}

std::set<std::string, std::less<>> Device::names(std::string_view prefix) const {
  std::set<std::string, std::less<>> all;
  const auto add_from = [&](const auto& items) {
    for (auto item = items.lower_bound(prefix); item != items.end() && item->first.starts_with(prefix); ++item)
      all.insert(item->first);
  };
  add_from(impl_->targets);
  add_from(impl_->buffers);
  return all;
}

std::size_t Device::target_bytes(std::string_view prefix) const {
  std::size_t bytes = 0;
  for (const auto& [name, texture] : impl_->targets) {
    if (name.starts_with(prefix)) bytes += texture.bytes();
  }
  return bytes;
}

GLuint Device::framebuffer(std::string_view name, std::span<const Attachment> colors, const Attachment* depth) {
  FramebufferKey key{depth == nullptr ? AttachmentKey() : key_of(*depth)};
  for (const Attachment& color : colors) key.push_back(key_of(color));
  const std::uint64_t use = ++impl_->framebuffer_uses;
  auto found = impl_->framebuffers.find(key);
  if (found == impl_->framebuffers.end()) {
    impl_->drop_unused_framebuffers();
    found = impl_->framebuffers.emplace(std::move(key), CachedFramebuffer{make_framebuffer(name, colors, depth)}).first;
  } else {
    attach_foreign(found->second.handle.id(), colors, depth);
  }
  found->second.last_use = use;
  return found->second.handle.id();
}

bool Device::is_debugged() {
  if (!impl_->debugged) impl_->debugged = debug_enabled();
  return *impl_->debugged;
}

float Device::vertex_rounding() {
  if (!impl_->vertex_rounding) {
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    const bool exact = device_info().renderer.starts_with("llvmpipe");
    impl_->vertex_rounding = exact ? 0 : std::exp2(static_cast<float>(-bits - 1));
  }
  return *impl_->vertex_rounding;
}

void Device::assume_vertex_rounding(float pixels) { impl_->vertex_rounding = pixels; }

GLuint Device::empty_vertex_array() {
  if (!impl_->empty_vertex_array) {
    GLuint id = 0;
    glCreateVertexArrays(1, &id);
    impl_->empty_vertex_array = Handle<delete_vertex_array>(id);
    label(GL_VERTEX_ARRAY, id, impl_->name);
  }
  return impl_->empty_vertex_array.id();
}

DeviceScope::DeviceScope(Device& device) : device_(device), outer_(current_api) {
  Device::Impl& impl = *device.impl_;
  if (impl.api == nullptr) impl.api = current_api;
  current_api = impl.api;
}

DeviceScope::~DeviceScope() { current_api = outer_; }

void DeviceScope::mark_context() { device_.empty_vertex_array(); }

bool DeviceScope::has_context() { return device_.impl_->thread == this_thread() || finds_context(); }

bool DeviceScope::finds_context() {
  Device::Impl& impl = *device_.impl_;
  const GLuint mark = impl.empty_vertex_array.id();
  if (mark != 0 && (glIsVertexArray(mark) == GL_FALSE || label_of(GL_VERTEX_ARRAY, mark) != impl.name)) return false;
  impl.thread = this_thread();
  return true;
}

}  // namespace penumbra::gl
