#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <utility>

#include "app/diff/figures.h"
#include "cli/command_line.h"
#include "cli/usage.h"
#include "core/error.h"
#include "image/module_folder.h"
#include "image/picture.h"
#include "render/renderer.h"
#include "scene.h"
#include "session/techniques.h"

namespace penumbra::python {
namespace {

namespace py = pybind11;

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

bool has_bytes(const py::object& given) { return py::isinstance<py::array_t<std::uint8_t>>(given); }

// Bytes count as shares of 255. `display`: the values are those of a display, not linear.
image::Picture picture_of(const py::object& given, const char* name, bool display) {
  const Floats values = Floats::ensure(given);
  if (!values) fail("{} is no array of numbers", name);
  if (values.ndim() != 2 && values.ndim() != 3)
    fail("{} has {} dimensions: it takes rows and columns, and channels", name, values.ndim());
  if (values.size() == 0) fail("{} has no values", name);
  image::Picture picture;
  picture.height = static_cast<int>(values.shape(0));
  picture.width = static_cast<int>(values.shape(1));
  const py::ssize_t channels = values.ndim() == 3 ? values.shape(2) : 1;
  for (py::ssize_t i = 0; i < channels; ++i) picture.channels.push_back(channels == 1 ? "V" : fmt::format("{}", i));
  picture.pixels.assign(values.data(), values.data() + values.size());
  picture.display = display;
  if (has_bytes(given)) {
    for (float& value : picture.pixels) value /= 255.0f;
  }
  return picture;
}

std::vector<std::uint8_t> receivers_of(const std::optional<Floats>& values, const image::Picture& reference) {
  if (!values) return {};
  if (values->ndim() != 2 || values->shape(0) != reference.height || values->shape(1) != reference.width)
    fail("the receivers are not one value for each pixel of the reference");
  return app::selected_by({values->data(), static_cast<std::size_t>(values->size())}, "the array of receivers");
}

py::dict difference(const py::object& test, const py::object& reference, const std::optional<Floats>& receivers,
                    std::optional<bool> display) {
  const bool shown = display.value_or(has_bytes(test) || has_bytes(reference));
  const image::Picture a = picture_of(test, "the test picture", shown),
                       b = picture_of(reference, "the reference", shown);
  const std::vector<std::uint8_t> measured = receivers_of(receivers, b);
  app::Difference found;
  {
    const py::gil_scoped_release release;
    app::check_comparable(a, b, measured, "test", "reference");
    found = app::difference_of(a, b, measured);
  }
  py::dict figures;
  for (const auto& [name, value] : app::named_figures(found)) figures[name] = value;
  figures["not_finite"] = found.not_finite;
  return figures;
}

py::array read(const std::filesystem::path& path, const std::string& layer) {
  const image::Picture picture = image::read_picture(path, layer);
  std::vector<py::ssize_t> shape{picture.height, picture.width};
  if (picture.channels.size() > 1) shape.push_back(static_cast<py::ssize_t>(picture.channels.size()));
  return py::array_t<float>(shape, picture.pixels.data());
}

py::dict techniques() {
  py::dict rows;
  const shadow::Registry& registry = session::all_techniques();
  for (const shadow::Technique& technique : registry.techniques()) rows[py::str(technique.name)] = technique.summary;
  for (const shadow::Preset& preset : registry.presets()) rows[py::str(preset.name)] = preset.summary;
  return rows;
}

py::dict aovs() {
  py::dict rows;
  for (const render::Aov& aov : render::aovs()) rows[py::str(aov.name)] = aov.help;
  return rows;
}

py::dict params() {
  py::dict rows;
  for (const Param& param : render::Renderer::params(session::all_techniques())) rows[py::str(param.name)] = param.help;
  return rows;
}

void add_scene(py::module_& module) {
  using Several = py::dict (Scene::*)(const std::vector<std::string>&, int, int);
  using One = py::array (Scene::*)(const std::string&, int, int);
  py::class_<Scene>(module, "Scene", "A scene that is open; see penumbra.open().")
      .def(py::init<const std::string&, const std::vector<std::string>&>())
      .def("select", &Scene::select, py::arg("technique"), "Chooses a technique or a preset; see techniques().")
      .def("__getitem__", &Scene::get, py::arg("param"), "The value of a parameter; see params().")
      .def("__setitem__", &Scene::set, py::arg("param"), py::arg("value"))
      .def("params", &Scene::params, "The values of all parameters.")
      .def("render", static_cast<One>(&Scene::render), py::arg("picture") = "display", py::arg("frame") = 0,
           py::arg("light") = 0,
           "Draws a frame and returns a picture of it: \"display\", which is RGB of 8 bits, or an AOV as floats; see\n"
           "aovs(). `frame` counts from the scene's time, in steps of 1 / fps; histories continue if it is the one "
           "after\n"
           "the last. `light`: which of those that cast shadows a picture is of, where it is of one.")
      .def("render", static_cast<Several>(&Scene::render), py::arg("pictures"), py::arg("frame") = 0,
           py::arg("light") = 0, "Draws a frame, and returns several pictures of it by name.")
      .def("truth", &Scene::truth, py::arg("samples") = py::none(), py::arg("error") = py::none(), py::arg("frame") = 0,
           py::arg("light") = 0,
           "Ray traces the shadow of a light: a dict of \"shadow\", its \"standard_error\", \"hard\", which is the "
           "shadow of\n"
           "the light's centre, and \"receiver\", 1 where a pixel counts in metrics. `samples`: rays of each pixel "
           "(256);\n"
           "`error`: the standard error to reach instead. Ctrl-C interrupts it.")
      .def_property_readonly(
          "size", [](const Scene& scene) { return std::pair(scene.width(), scene.height()); },
          "Width and height, pixels.")
      .def_property_readonly("lights", &Scene::lights, "How many lights cast shadows.");
}

// `package`: the folder of the Python files. The module is in the installed library's folder, or in the build folder.
void find_image_module(const std::filesystem::path& package) {
  image::add_module_folder(package / PENUMBRA_MODULE_FOLDER);
  image::add_module_folder(package.parent_path().parent_path());
}

}  // namespace

PYBIND11_MODULE(_penumbra, module) {
  const std::string version = cli::version();
  module.attr("__version__") = version.substr(version.find(' ') + 1);
  const auto& error = py::register_exception<Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<cli::UsageError>(module, "UsageError", error);
  add_scene(module);
  module.def(
      "difference", &difference, py::arg("test"), py::arg("reference"), py::arg("receivers") = py::none(),
      py::arg("display") = py::none(),
      "How far a picture is from a reference, as `penumbra diff` measures it: a dict of the metrics that apply, and\n"
      "\"not_finite\": how many values are NaN or infinite, which count as errors of 1. Pixels whose value in\n"
      "`receivers` is 0 or not finite are left out. `display`: whether values are those of a display, as\n"
      "the metrics of colours need them; None: where one of the arrays has bytes.");
  module.def("read", &read, py::arg("path"), py::arg("layer") = "",
             "A picture file as floats: a PNG as display values from 0 to 1, or a layer of an EXR as it is.");
  module.def("techniques", &techniques, "What select() takes, with a sentence about each.");
  module.def("aovs", &aovs, "The pictures of a frame, with a sentence about each.");
  module.def("params", &params, "The parameters, with a sentence about each.");
  module.def("find_image_module", &find_image_module);
}

}  // namespace penumbra::python
