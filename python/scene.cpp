#include "scene.h"

#include <pybind11/stl.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/command_line.h"
#include "core/names.h"
#include "image/read.h"
#include "session/render_device.h"
#include "session/techniques.h"
#include "truth/tracer.h"

namespace penumbra::python {

namespace py = pybind11;

namespace {

// Python's handler of Ctrl-C runs only when it is asked to; an exception that it raises ends the tracing.
bool no_signal_raised() {
  const py::gil_scoped_acquire acquire;
  return PyErr_CheckSignals() == 0;
}

void raise_for_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::object to_python(const ParamValue& value) {
  return std::visit([](const auto& held) -> py::object { return py::cast(held); }, value);
}

template <class T>
py::array array_of(const std::vector<T>& values, int height, int width, std::size_t channels) {
  std::vector<py::ssize_t> shape{height, width};
  if (channels > 1) shape.push_back(static_cast<py::ssize_t>(channels));
  return py::array_t<T>(shape, values.data());
}

// Of rows from bottom to top.
py::array flipped(const std::vector<float>& rows, int height, int width) {
  std::vector<float> result;
  result.reserve(rows.size());
  for (auto row = rows.end(); row != rows.begin();) {
    row -= width;
    result.insert(result.end(), row, row + width);
  }
  return array_of(result, height, width, 1);
}

constexpr const char* display = "display";

void check_frame(int frame) {
  constexpr int last = 999'999;  // as of --frames
  if (frame < 0 || frame > last) cli::fail_usage("frame can't be {}, only 0 to {}", frame, last);
}

// A wrong name or value is a usage error.
template <class Call>
void as_usage(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    throw cli::UsageError(error.what());
  }
}

// All names would make a long line.
void check_known(const ParamSet& params, const std::string& name) {
  const bool known = params.contains(name) || params.renamed_from(name) != nullptr;
  if (!known && near_names(name, params.names()).empty())
    cli::fail_usage("unknown parameter '{}'; see penumbra.params()", name);
}

// Null for the display. Throws UsageError for an unknown name.
const render::Aov* find_picture(const std::string& name) {
  std::vector<std::string> names{display};
  for (const render::Aov& aov : render::aovs()) {
    if (aov.name == name) return &aov;
    names.push_back(aov.name);
  }
  cli::one_of("picture", name, names);
  return nullptr;
}

}  // namespace

Scene::Scene(const std::string& path, const std::vector<std::string>& arguments) {
  CLI::App app("", "penumbra render");  // where an error sends users for a list of options
  app.set_help_flag();
  options_.otherwise = session::usual_technique;
  cli::add_scene_option(app, options_);
  cli::add_size_option(app, options_);
  cli::add_samples_option(app, options_);
  cli::add_sample_shadows_option(app, options_);
  cli::add_view_options(app, options_);
  cli::add_time_options(app, options_);
  cli::add_technique_option(app, options_);
  cli::add_shadow_options(app, options_);
  cli::add_device_options(app, options_);
  session::add_cache_options(app, options_);
  std::vector<std::string> all = arguments;
  all.insert(all.end(), {"--", path});
  cli::parse(app, all);
  cli::check_together(static_cast<const cli::SceneOptions&>(options_));
  cli::check_together(static_cast<const cli::DeviceOptions&>(options_));
  session::check_together(static_cast<const session::CacheOptions&>(options_));
  params_ = cli::resolve_params(options_, session::all_techniques());
  if (!options_.frames) options_.frames = cli::FrameRange{};  // each frame has its time

  const py::gil_scoped_release release;
  session::limit_threads(options_);
  options_.reading.skies_chosen = cli::is_chosen(options_, params_, "casters.skies");
  prepared_ = session::load_scene(options_, image::image_decoder(cli::limits_of(options_.reading)));
  truth::TechniqueOptions how = session::truth_options(options_, options_);
  how.progress = [](double) { return no_signal_raised(); };
  truth_.emplace(std::move(how));
  std::unique_ptr<gl::Context> context = session::open_context(options_, options_);
  context_ = context.get();
  session_ = std::make_unique<session::RenderSession>(options_, options_, std::move(context), prepared_,
                                                      truth_->registry(), /* timed= */ false);
}

Scene::~Scene() {
  if (!session_) return;
  try {
    use();
  } catch (const Error&) {
    // OpenGL objects can't be deleted without their context, nor on another thread than theirs.
    static_cast<void>(session_.release());
  }
}

void Scene::check_thread() const {
  if (thread_ != std::this_thread::get_id()) fail("a scene can be used only on the thread that opened it");
}

void Scene::use() const {
  check_thread();
  context_->make_current();
}

void Scene::select(const std::string& technique) {
  check_thread();
  ParamSet chosen = params_;
  as_usage([&] { session::choose_technique(chosen, session::all_techniques(), technique); });
  params_ = chosen;  // only if there is such a technique
}

py::object Scene::get(const std::string& param) const {
  check_thread();
  check_known(params_, param);
  py::object value;
  as_usage([&] { value = to_python(params_.value(param)); });
  return value;
}

void Scene::set(const std::string& param, const py::object& value) {
  check_thread();
  check_known(params_, param);
  // A bool is also an int to Python, and a number from NumPy is neither a float nor an int.
  const bool is_bool =
      py::isinstance<py::bool_>(value) || py::isinstance(value, py::module_::import("numpy").attr("bool_"));
  const std::string text = is_bool ? (py::bool_(value) ? "on" : "off") : std::string(py::str(value));
  cli::assign(params_, param + "=" + text);
}

py::dict Scene::params() const {
  check_thread();
  py::dict values;
  for (const std::string& name : params_.names()) values[py::str(name)] = get(name);
  return values;
}

std::size_t Scene::lights() const { return render::shadowed_lights(prepared_.setup).size(); }

void Scene::check_light(int light) const {
  const int count = static_cast<int>(lights());
  if (light < 0 || light >= count) cli::fail_usage("light {} of {} that cast shadows", light, count);
}

void Scene::draw(const ParamSet& params, int frame, int samples) {
  use();
  // The session takes the frame before the first one for the first one itself, which has the same time.
  if (drawn_ != frame - 1) session_->cut();
  drawn_.reset();
  {
    const py::gil_scoped_release release;
    try {
      session_->draw(frame, params, samples);
      drawn_ = frame;
    } catch (const truth::Interrupted&) {
      session_->cut();
    }
  }
  if (PyErr_Occurred() != nullptr) throw py::error_already_set();
  raise_for_signals();
}

py::array Scene::read(const std::string& picture, int light) const {
  const render::Aov* aov = find_picture(picture);
  const render::Renderer& renderer = session_->renderer();
  if (aov == nullptr) return array_of(renderer.read_display(), height(), width(), 3);
  return array_of(renderer.read_aov(picture, aov->of_light ? light : 0), height(), width(), aov->channels.size());
}

py::array Scene::render(const std::string& picture, int frame, int light) {
  return py::array(render(std::vector<std::string>{picture}, frame, light)[py::str(picture)]);
}

py::dict Scene::render(const std::vector<std::string>& pictures, int frame, int light) {
  check_frame(frame);
  check_light(light);
  int samples = 1;
  for (const std::string& picture : pictures) {
    const render::Aov* aov = find_picture(picture);
    if (aov != nullptr && aov->mask_details) session_->keep_mask_details();
    if (aov == nullptr || aov->name == "color") samples = options_.samples;  // no other picture is a mean of samples
  }
  draw(params_, frame, samples);
  py::dict result;
  for (const std::string& picture : pictures) result[py::str(picture)] = read(picture, light);
  return result;
}

py::dict Scene::truth(std::optional<int> samples, std::optional<double> error, int frame, int light) {
  check_frame(frame);
  check_light(light);
  ParamSet params = params_;
  session::choose_technique(params, session::all_techniques(), "truth");
  if (samples) cli::assign(params, fmt::format("truth.samples={}", *samples));
  if (error) cli::assign(params, fmt::format("truth.error={}", *error));
  draw(params, frame, /* samples= */ 1);
  const truth::TruthTechnique::Last& last = truth_->last(light);
  py::dict result;
  result["shadow"] = flipped(last.traced.visibility, height(), width());
  result["standard_error"] = flipped(last.traced.standard_error, height(), width());
  result["hard"] = flipped(last.traced.hard, height(), width());
  result["receiver"] = flipped(last.receiver, height(), width());
  return result;
}

}  // namespace penumbra::python
