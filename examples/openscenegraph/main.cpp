// A viewer of OpenSceneGraph whose sun casts soft shadows. soft_shadows.cpp is what it takes, frame.cpp where it is
// called; the rest is a scene, and what draws a picture and checks it.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <osg/ArgumentParser>
#include <osg/Image>
#include <osg/Notify>
#include <osg/Texture>
#include <osgDB/WriteFile>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <stdexcept>
#include <string>
#include <vector>

#include "frame.h"
#include "rays.h"
#include "scene.h"

namespace {

constexpr double frames_per_second = 60, most_rms = 0.015;
const osg::Vec3d eye(-4.5, -13.5, 6.4), center(0, 0.6, 1.1), up(0, 0, 1);

constexpr const char* help =
    "openscenegraph [--picture FILE | --check] [--frames N] [--size WxH] [--technique NAME]\n"
    "  Opens a window; --picture writes a picture instead, such as x.png.\n"
    "  --check         compares the hard shadows of shadow_volume with rays; exit code 1 if they differ\n"
    "  --frames N      the animation, of 60 frames a second, stops after N frames (default: for pictures 1)\n"
    "  --size WxH      pixels (default: 1280x720)\n"
    "  --technique T   a technique or preset of Penumbra without a history (default: slices_denoised)\n";

struct Options {
  std::string picture, technique = "slices_denoised";
  bool check = false;
  int frames = 0, width = 1280, height = 720;  // frames 0: without an end

  bool window() const { return picture.empty() && !check; }
};

Options read_options(osg::ArgumentParser& arguments) {
  Options options;
  std::string size;
  arguments.read("--picture", options.picture);
  arguments.read("--technique", options.technique);
  options.check = arguments.read("--check");
  if (arguments.read("--frames", options.frames) && options.frames < 1) {
    throw std::runtime_error("--frames: not a number above 0");
  }
  if (arguments.read("--size", size)) {
    char rest = 0;
    if (std::sscanf(size.c_str(), "%5dx%5d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 ||
        options.height < 1) {
      throw std::runtime_error("--size " + size + ": not of the form 1280x720");
    }
  }
  arguments.reportRemainingOptionsAsUnrecognized();
  if (arguments.errors()) throw std::runtime_error(arguments.getErrorMessageMap().begin()->first);
  if (arguments.argc() > 1) throw std::runtime_error("unexpected argument: " + std::string(arguments[1]));
  if (options.check) options.technique = "shadow_volume";
  if (!options.window() && options.frames == 0) options.frames = 1;
  return options;
}

osg::ref_ptr<osg::GraphicsContext> make_context(const Options& options) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  traits->readDISPLAY();
  traits->setUndefinedScreenDetailsToDefaultScreen();
  traits->windowName = "Penumbra in OpenSceneGraph";
  traits->x = traits->y = 40;
  traits->width = options.width;
  traits->height = options.height;
  traits->windowDecoration = true;
  traits->pbuffer = !options.window();
  traits->doubleBuffer = options.window();
  osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
  if (!context || !context->valid()) throw std::runtime_error("no OpenGL context: is there an X display?");
  return context;
}

class ResizeHandler : public osgGA::GUIEventHandler {
 public:
  explicit ResizeHandler(const FrameGraph& frame) : frame_(frame) {}
  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override {
    if (event.getEventType() == osgGA::GUIEventAdapter::RESIZE) {
      resize(frame_, event.getWindowWidth(), event.getWindowHeight());
    }
    return false;
  }

 private:
  FrameGraph frame_;
};

void place_camera(osgViewer::Viewer& viewer, const Options& options) {
  osg::Camera& camera = *viewer.getCamera();
  camera.setGraphicsContext(make_context(options));
  camera.setViewport(0, 0, options.width, options.height);
  camera.setProjectionMatrixAsPerspective(35, static_cast<double>(options.width) / options.height, 1, 100);
  if (!options.window()) {
    camera.setViewMatrixAsLookAt(eye, center, up);
    return;
  }
  osg::ref_ptr<osgGA::TrackballManipulator> manipulator = new osgGA::TrackballManipulator;
  manipulator->setAutoComputeHomePosition(false);
  manipulator->setHomePosition(eye, center, up);
  viewer.setCameraManipulator(manipulator);
}

void write_picture(const Options& options) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->readPixels(0, 0, options.width, options.height, GL_RGB, GL_UNSIGNED_BYTE);
  if (!osgDB::writeImageFile(*image, options.picture)) throw std::runtime_error("can't write " + options.picture);
}

std::vector<float> read_mask(const SoftShadows& shadows, const Options& options) {
  std::vector<float> mask(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height));
  glBindTexture(GL_TEXTURE_2D_ARRAY_EXT, shadows.mask());
  glGetTexImage(GL_TEXTURE_2D_ARRAY_EXT, 0, GL_RED, GL_FLOAT, mask.data());
  glBindTexture(GL_TEXTURE_2D_ARRAY_EXT, 0);
  return mask;
}

void check(const SoftShadows& shadows, osgViewer::Viewer& viewer, const Scene& scene, const osg::Vec3& to_sun,
           const Options& options) {
  const Difference found = compare_with_rays(read_mask(shadows, options), *viewer.getCamera(), *scene.root, to_sun);
  std::printf("rms %.4f at %d points\n", found.rms, found.points);
  if (found.points == 0 || found.rms >= most_rms) throw std::runtime_error("the shadows are not where rays find them");
}

// Frees what the shadows have made in OpenGL, also where a frame fails. A window that was closed has taken its context
// and all that belongs to it with it.
class ReleasesAtEnd {
 public:
  ReleasesAtEnd(const SoftShadows& shadows, osgViewer::Viewer& viewer) : shadows_(shadows), viewer_(viewer) {}
  ~ReleasesAtEnd() {
    if (viewer_.getCamera()->getGraphicsContext()->makeCurrent()) {
      shadows_.release();
    } else {
      shadows_.abandon();
    }
  }
  ReleasesAtEnd(const ReleasesAtEnd&) = delete;
  ReleasesAtEnd& operator=(const ReleasesAtEnd&) = delete;

 private:
  const SoftShadows& shadows_;
  osgViewer::Viewer& viewer_;
};

void run(osg::ArgumentParser& arguments) {
  const Options options = read_options(arguments);
  penumbra::api::Settings settings(options.technique);
  settings.set("sun.angle", 4);
  osg::Vec3 to_sun(-0.62f, -0.32f, 0.72f);
  to_sun.normalize();
  Scene scene = make_scene();

  osgViewer::Viewer viewer;
  viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
  place_camera(viewer, options);
  FrameGraph frame = make_frame(viewer, *scene.root, *scene.carousel, to_sun, settings);
  const ReleasesAtEnd releases(*frame.shadows, viewer);
  viewer.addEventHandler(new ResizeHandler(frame));
  viewer.realize();
  for (int i = 0; !viewer.done() && (options.window() || i < options.frames); ++i) {
    animate(scene, (options.frames > 0 ? std::min(i, options.frames - 1) : i) / frames_per_second);
    viewer.frame();
  }

  // Else the window was closed.
  if (!viewer.getCamera()->getGraphicsContext()->makeCurrent()) return;
  if (!options.picture.empty()) write_picture(options);
  if (options.check) check(*frame.shadows, viewer, scene, to_sun, options);
}

}  // namespace

int main(int argc, char** argv) {
  osg::setNotifyLevel(osg::FATAL);  // errors are the program's own, of one line
  osg::ArgumentParser arguments(&argc, argv);
  if (arguments.read("--help")) {
    std::fputs(help, stdout);
    return 0;
  }
  try {
    run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
}
