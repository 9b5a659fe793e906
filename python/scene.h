#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/options.h"
#include "session/cache_options.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "truth/technique.h"

namespace penumbra::python {

// A scene that is open, with a context of its own, from which pictures are drawn. For the thread that made it.
class Scene {
 public:
  // `arguments`: options of `penumbra render`. Throws UsageError and Error.
  Scene(const std::string& path, const std::vector<std::string>& arguments);
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // Chooses a technique or a preset, as --technique does. Throws Error for an unknown name.
  void select(const std::string& technique);
  pybind11::object get(const std::string& param) const;
  void set(const std::string& param, const pybind11::object& value);
  pybind11::dict params() const;

  // Draws a frame and reads a picture of it: "display" as bytes, 8 bits sRGB, or an AOV as floats.
  pybind11::array render(const std::string& picture, int frame, int light);
  // The same of several pictures, by name.
  pybind11::dict render(const std::vector<std::string>& pictures, int frame, int light);
  // Ray traces the shadow of a light in a frame: "shadow", "standard_error", "hard" and "receiver".
  pybind11::dict truth(std::optional<int> samples, std::optional<double> error, int frame, int light);

  int width() const { return options_.size.width; }
  int height() const { return options_.size.height; }
  std::size_t lights() const;  // that cast shadows

 private:
  struct Options : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions, session::CacheOptions {};

  void check_thread() const;  // throws Error on another thread than the scene's
  void use() const;           // the same, and makes the scene's context current
  void draw(const ParamSet& params, int frame, int samples);
  void check_light(int light) const;
  pybind11::array read(const std::string& picture, int light) const;

  std::thread::id thread_ = std::this_thread::get_id();
  std::optional<int> drawn_;  // the last frame that was finished
  Options options_;
  ParamSet params_;
  session::PreparedScene prepared_;
  std::optional<truth::TruthTechnique> truth_;
  gl::Context* context_ = nullptr;  // the session's
  std::unique_ptr<session::RenderSession> session_;
};

}  // namespace penumbra::python
