/** @file
 * Penumbra for C++20: the functions of penumbra.h with owners, exceptions, std::function and std::span. Header only; it
 * adds nothing that penumbra.h does not have. What functions and fields mean stands there.
 *
 *     penumbra::api::Device device(get_proc);            // in the engine's context
 *     penumbra::api::Settings settings("pcss");
 *     settings.set("sun.angle", 1.5);
 *     penumbra::api::Frame frame;                        // all fields at their defaults
 *     frame.draw_with([&](const penumbra_caster_pass& pass) { draw_casters(pass.world_to_clip); });
 *     const std::array lights{penumbra::api::sun(0, to_light)};
 *     frame.light_with(lights);
 *     const penumbra_mask mask = device.render(settings, frame);
 */
#ifndef PENUMBRA_HPP
#define PENUMBRA_HPP

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "penumbra.h"

/// The C interface as C++20. `penumbra` itself is the namespace of the library's own C++.
namespace penumbra::api {

/// A result other than PENUMBRA_OK; what() is penumbra_last_error().
class Error : public std::runtime_error {
 public:
  /// Of the last call of this thread that failed.
  explicit Error(penumbra_result result) : std::runtime_error(penumbra_last_error()), result_(result) {}
  /// Which kind of error it is.
  penumbra_result result() const noexcept { return result_; }

 private:
  penumbra_result result_;
};

/// Throws Error if a function of penumbra.h failed.
inline void check(penumbra_result result) {
  if (result != PENUMBRA_OK) throw Error(result);
}

namespace detail {

// What an array of one coordinate each is made of: std::array<float, 3>, glm::vec3, float[3].
template <class Vector>
void copy3(const Vector& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

// The text that a function writes; `write` has its last three arguments.
template <class Write>
std::string text_of(const Write& write) {
  std::size_t length = 0;
  check(write(nullptr, std::size_t{0}, &length));
  std::string text(length, '\0');
  check(write(text.data(), text.size(), nullptr));
  text.resize(length - 1);
  return text;
}

// Callbacks, at an address that stays. An exception that leaves one is kept, and thrown again by the call that caused
// it.
struct Callbacks {
  std::function<penumbra_proc(const char*)> get_proc;
  std::function<void(std::int32_t level, std::string_view message)> log;
  std::exception_ptr thrown;
};

}  // namespace detail

/// A sun; `to_light` has x, y and z at [0], [1] and [2]. Fields that are not arguments keep their defaults.
template <class Vector>
penumbra_light sun(std::int32_t id, const Vector& to_light) {
  penumbra_light light;
  check(penumbra_light_init(&light, sizeof light));
  light.id = id;
  light.kind = PENUMBRA_SUN;
  detail::copy3(to_light, light.to_light);
  return light;
}

/// A lamp that shines in all directions; `radius` in metres. Set `axis` and `cone` to make it a spot.
template <class Vector>
penumbra_light lamp(std::int32_t id, const Vector& position, float radius) {
  penumbra_light light;
  check(penumbra_light_init(&light, sizeof light));
  light.id = id;
  light.kind = PENUMBRA_LAMP;
  detail::copy3(position, light.position);
  light.radius = radius;
  return light;
}

/// Values of all parameters. Copyable; a moved-from object can only be assigned to or destroyed.
class Settings {
 public:
  /// Each parameter at its default.
  Settings() { check(penumbra_settings_create(&settings_)); }
  /// The same after select().
  explicit Settings(std::string_view technique) : Settings() { select(technique); }
  /// penumbra_settings_clone().
  Settings(const Settings& other) { check(penumbra_settings_clone(other.settings_, &settings_)); }
  /// Takes the values of `other`, which has none then.
  Settings(Settings&& other) noexcept : settings_(std::exchange(other.settings_, nullptr)) {}
  /// The values of `other`, copied or taken.
  Settings& operator=(Settings other) noexcept {
    std::swap(settings_, other.settings_);
    return *this;
  }
  ~Settings() { penumbra_settings_destroy(settings_); }

  /// penumbra_settings_select(): a technique or a preset.
  void select(std::string_view technique) {
    check(penumbra_settings_select(settings_, std::string(technique).c_str()));
  }
  /// penumbra_settings_set(): a value as text.
  void set(std::string_view name, std::string_view value) {
    check(penumbra_settings_set(settings_, std::string(name).c_str(), std::string(value).c_str()));
  }
  /// The same for a literal.
  void set(std::string_view name, const char* value) { set(name, std::string_view(value)); }
  /// penumbra_settings_set_number(): a number, or true or false.
  template <class Number>
  requires std::integral<Number> || std::floating_point<Number>
  void set(std::string_view name, Number value) {
    check(penumbra_settings_set_number(settings_, std::string(name).c_str(), static_cast<double>(value)));
  }
  /// penumbra_settings_reset(): the default of one parameter.
  void reset(std::string_view name) { check(penumbra_settings_reset(settings_, std::string(name).c_str())); }
  /// The default of every parameter.
  void reset() { check(penumbra_settings_reset(settings_, nullptr)); }
  /// penumbra_settings_get(): a value as text.
  std::string get(std::string_view name) const {
    return detail::text_of([&, key = std::string(name)](char* text, std::size_t capacity, std::size_t* length) {
      return penumbra_settings_get(settings_, key.c_str(), text, capacity, length);
    });
  }
  /// penumbra_settings_get_number().
  double get_number(std::string_view name) const {
    double value = 0;
    check(penumbra_settings_get_number(settings_, std::string(name).c_str(), &value));
    return value;
  }
  /// penumbra_settings_read_preset(). `file`: what messages call the text.
  void read_preset(std::string_view file, std::string_view text) {
    check(penumbra_settings_read_preset(settings_, std::string(file).c_str(), text.data(), text.size()));
  }
  /// penumbra_settings_write_preset(): the text of a preset with these values.
  std::string preset() const {
    return detail::text_of([&](char* text, std::size_t capacity, std::size_t* length) {
      return penumbra_settings_write_preset(settings_, text, capacity, length);
    });
  }

  /// For functions of penumbra.h.
  const penumbra_settings* get() const noexcept { return settings_; }

 private:
  penumbra_settings* settings_ = nullptr;
};

/// The fields of penumbra_frame, which begin as penumbra_frame_init() leaves them, and its callback.
struct Frame : penumbra_frame {
  /// All fields at their defaults.
  Frame() { check(penumbra_frame_init(this, sizeof(penumbra_frame))); }

  /// The lights must stay where they are until the frame is rendered.
  void light_with(std::span<const penumbra_light> all) {
    lights = all.data();
    light_count = all.size();
  }
  /// Draws casters; what it throws leaves Device::render(). Replaces penumbra_frame::draw and draw_user.
  void draw_with(std::function<void(const penumbra_caster_pass&)> function) { casters_ = std::move(function); }

 private:
  friend class Device;
  std::function<void(const penumbra_caster_pass&)> casters_;
};

/// What was made in one OpenGL context, which must be current when it is made, used and destroyed. The destructor can't
/// throw: without that context it leaves the OpenGL objects as they are, with a warning to the log. Movable.
class Device {
 public:
  /// Finds an entry point of OpenGL by its name, as eglGetProcAddress() and glfwGetProcAddress() do.
  using GetProc = std::function<penumbra_proc(const char* name)>;
  /// Receives messages. `level`: PENUMBRA_LOG_...
  using Log = std::function<void(std::int32_t level, std::string_view message)>;

  /// penumbra_device_create(). Without a log, warnings and errors go to stderr.
  explicit Device(GetProc get_proc, Log log = {}) : callbacks_(std::make_unique<detail::Callbacks>()) {
    callbacks_->get_proc = std::move(get_proc);
    callbacks_->log = std::move(log);
    penumbra_device_desc desc;
    check(penumbra_device_desc_init(&desc, sizeof desc));
    if (callbacks_->get_proc) desc.get_proc = find_proc;
    desc.get_proc_user = callbacks_.get();
    if (callbacks_->log) desc.log = write_log;
    desc.log_user = callbacks_.get();
    penumbra_device* device = nullptr;
    const penumbra_result result = penumbra_device_create(&desc, &device);
    device_.reset(device);
    finish(result);
  }
  /// The other device can only be assigned to or destroyed then.
  Device(Device&&) noexcept = default;
  /// The old device is destroyed before its callbacks, which it may call then.
  Device& operator=(Device&& other) noexcept {
    device_ = std::move(other.device_);
    callbacks_ = std::move(other.callbacks_);
    return *this;
  }

  /// penumbra_render(): the mask of a frame. Its texture belongs to the device.
  penumbra_mask render(const Settings& settings, const Frame& frame) {
    penumbra_mask mask{};
    mask.struct_size = sizeof mask;
    Drawing drawing{frame.casters_, *callbacks_};
    penumbra_frame given = frame;
    if (frame.casters_) {
      given.draw = draw_casters;
      given.draw_user = &drawing;
    }
    finish(penumbra_render(device_.get(), settings.get(), &given, &mask));
    return mask;
  }
  /// penumbra_reads_motion(): whether motion vectors have to be drawn.
  bool reads_motion(const Settings& settings, std::span<const penumbra_light> lights) {
    std::uint32_t reads = 0;
    finish(penumbra_reads_motion(device_.get(), settings.get(), lights.data(), lights.size(), &reads));
    return reads != 0;
  }
  /// penumbra_warm_up(): compiles what such frames need.
  void warm_up(const Settings& settings, const Frame& frame) {
    finish(penumbra_warm_up(device_.get(), settings.get(), &frame));
  }
  /// penumbra_forget_view(): releases the maps, the mask and the history of a view.
  void forget_view(std::int32_t view_id) { finish(penumbra_forget_view(device_.get(), view_id)); }
  /// penumbra_forward_source(): GLSL for surfaces that are drawn forward.
  std::string forward_source(const Settings& settings, const penumbra_light* light = nullptr) {
    return detail::text_of([&](char* text, std::size_t capacity, std::size_t* length) {
      finish(penumbra_forward_source(device_.get(), settings.get(), light, text, capacity, length));
      return PENUMBRA_OK;
    });
  }
  /// penumbra_bind_forward(): binds what that GLSL reads.
  void bind_forward(std::int32_t view_id, std::size_t light_index) {
    finish(penumbra_bind_forward(device_.get(), view_id, light_index));
  }
  /// penumbra_unbind_forward().
  void unbind_forward() { finish(penumbra_unbind_forward(device_.get())); }
  /// penumbra_device_abandon(): for a context that is lost.
  void abandon() { finish(penumbra_device_abandon(device_.get())); }

  /// For functions of penumbra.h.
  penumbra_device* get() const noexcept { return device_.get(); }

 private:
  struct Drawing {
    const std::function<void(const penumbra_caster_pass&)>& casters;
    detail::Callbacks& callbacks;
  };
  struct Destroy {
    void operator()(penumbra_device* device) const noexcept { penumbra_device_destroy(device); }
  };

  static penumbra_proc find_proc(void* user, const char* name) noexcept {
    auto& callbacks = *static_cast<detail::Callbacks*>(user);
    try {
      return callbacks.get_proc(name);
    } catch (...) {
      callbacks.thrown = std::current_exception();
      return nullptr;
    }
  }
  static void write_log(void* user, std::int32_t level, const char* message) noexcept {
    auto& callbacks = *static_cast<detail::Callbacks*>(user);
    try {
      callbacks.log(level, message);
    } catch (...) {
      callbacks.thrown = std::current_exception();
    }
  }
  static std::int32_t draw_casters(void* user, const penumbra_caster_pass* pass) noexcept {
    auto& drawing = *static_cast<Drawing*>(user);
    try {
      drawing.casters(*pass);
      return 0;
    } catch (...) {
      drawing.callbacks.thrown = std::current_exception();
      return 1;
    }
  }
  void finish(penumbra_result result) {
    if (const std::exception_ptr thrown = std::exchange(callbacks_->thrown, nullptr)) std::rethrow_exception(thrown);
    check(result);
  }

  std::unique_ptr<detail::Callbacks> callbacks_;  // outlives the device
  std::unique_ptr<penumbra_device, Destroy> device_;
};

}  // namespace penumbra::api

#endif
