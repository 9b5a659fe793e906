// A program with OGRE whose sun casts soft shadows. soft_shadows.cpp is what it takes, frame.cpp where it is called;
// the rest is a scene, and what draws a picture and checks it.
#include <OgreException.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreImage.h>
#include <OgreLogManager.h>
#include <OgreRenderTexture.h>
#include <OgreRenderWindow.h>
#include <OgreRoot.h>
#include <OgreTextureManager.h>
#include <OgreWindowEventUtilities.h>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "frame.h"
#include "rays.h"
#include "scene.h"

namespace {

constexpr double frames_per_second = 60, most_rms = 0.015;

constexpr const char* help =
    "ogre [--picture FILE | --check] [--frames N] [--size WxH] [--technique NAME]\n"
    "  Opens a window; --picture writes a picture instead, a PNG.\n"
    "  --check         compares the hard shadows of shadow_volume with rays; exit code 1 if they differ\n"
    "  --frames N      the animation, of 60 frames a second, stops after N frames (default: for pictures 1)\n"
    "  --size WxH      pixels (default: 1280x720)\n"
    "  --technique T   a technique or preset of Penumbra without a history (default: slices_denoised)\n";

struct Options {
  std::string picture, technique = "slices_denoised";
  bool help = false, check = false;
  int frames = 0, width = 1280, height = 720;  // frames 0: without an end

  bool window() const { return picture.empty() && !check; }
};

void read_frames(const std::string& value, Options& options) {
  const char* end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, options.frames);
  if (error != std::errc() || rest != end || options.frames < 1) {
    throw std::runtime_error("--frames " + value + ": not a number above 0");
  }
}

void read_size(const std::string& value, Options& options) {
  char rest = 0;
  if (std::sscanf(value.c_str(), "%5dx%5d%c", &options.width, &options.height, &rest) != 2 || options.width < 1 ||
      options.height < 1) {
    throw std::runtime_error("--size " + value + ": not of the form 1280x720");
  }
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const auto value = [&]() -> std::string {
      if (++i == argc) throw std::runtime_error(name + ": its value is missing");
      return argv[i];
    };
    if (name == "--help") {
      options.help = true;
    } else if (name == "--check") {
      options.check = true;
    } else if (name == "--picture") {
      options.picture = value();
    } else if (name == "--technique") {
      options.technique = value();
    } else if (name == "--frames") {
      read_frames(value(), options);
    } else if (name == "--size") {
      read_size(value(), options);
    } else {
      throw std::runtime_error("unexpected argument: " + name);
    }
  }
  if (options.check) options.technique = "shadow_volume";
  if (!options.window() && options.frames == 0) options.frames = 1;
  return options;
}

// OGRE with a window, which is hidden if a picture is drawn without one.
class Engine {
 public:
  explicit Engine(const Options& options) {
    root_.loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
    root_.loadPlugin(OGRE_PLUGINS "/Codec_STBI");
    root_.setRenderSystem(root_.getAvailableRenderers().front());
    root_.initialise(false);
    const Ogre::NameValuePairList parameters{{"hidden", options.window() ? "false" : "true"}, {"vsync", "true"}};
    window_ = root_.createRenderWindow("Penumbra in OGRE", static_cast<unsigned>(options.width),
                                       static_cast<unsigned>(options.height), false, &parameters);
    OgreBites::WindowEventUtilities::_addRenderWindow(window_);
  }

  Ogre::Root& root() { return root_; }
  Ogre::RenderWindow& window() { return *window_; }

 private:
  struct Silence : Ogre::LogManager {  // errors are the program's own, of one line
    Silence() { createLog("", true, false, true); }
  };
  Silence log_;
  Ogre::Root root_{"", "", ""};
  Ogre::RenderWindow* window_ = nullptr;
};

Ogre::TexturePtr make_picture_texture(const Options& options) {
  return Ogre::TextureManager::getSingleton().createManual(
      "picture", Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D,
      static_cast<unsigned>(options.width), static_cast<unsigned>(options.height), 0, Ogre::PF_BYTE_RGB,
      Ogre::TU_RENDERTARGET);
}

Ogre::Image read(Ogre::Texture& texture) {
  Ogre::Image image;
  texture.convertToImage(image);
  return image;
}

// The codec's own exceptions must not outlive the codec.
void write(Ogre::Texture& picture, const std::string& file) {
  try {
    read(picture).save(file);
  } catch (const Ogre::Exception& error) {
    throw std::runtime_error("can't write " + file + ": " + error.getDescription());
  }
}

void check(Frame& frame, const Scene& scene) {
  const Difference found =
      compare_with_rays(read(frame.visibility()), *scene.camera, *scene.manager, -scene.sun->getDerivedDirection());
  std::printf("rms %.4f at %d points\n", found.rms, found.points);
  if (found.points == 0 || found.rms >= most_rms) throw std::runtime_error("the shadows are not where rays find them");
}

void run(const Options& options) {
  penumbra::api::Settings settings(options.technique);
  settings.set("sun.angle", 4);

  Engine engine(options);
  Scene scene = make_scene(engine.root());
  const Ogre::TexturePtr picture = options.window() ? nullptr : make_picture_texture(options);
  Frame frame({scene.camera, scene.sun, scene.things, scene.sails}, settings,
              picture ? static_cast<Ogre::RenderTarget&>(*picture->getBuffer()->getRenderTarget()) : engine.window());
  for (int i = 0; !engine.window().isClosed() && (options.window() || i < options.frames); ++i) {
    animate(scene, (options.frames > 0 ? std::min(i, options.frames - 1) : i) / frames_per_second);
    frame.draw();
    OgreBites::WindowEventUtilities::messagePump();
  }

  if (!options.picture.empty()) write(*picture, options.picture);
  if (options.check) check(frame, scene);
}

}  // namespace

int main(int argc, char** argv) {
  const auto fail = [](const std::string& message) {
    std::fprintf(stderr, "error: %s\n", message.c_str());
    return 1;
  };
  try {
    const Options options = read_options(argc, argv);
    if (options.help) {
      std::fputs(help, stdout);
    } else {
      run(options);
    }
    return 0;
  } catch (const Ogre::Exception& error) {
    return fail(error.getDescription());
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
