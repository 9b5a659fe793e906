// The C interface without a context: settings, lists, texts of errors, and refusals.
#include "capi/penumbra.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "session/techniques.h"
#include "shadow/inputs.h"
#include "shadow/registry.h"

namespace penumbra {
namespace {

struct Settings {
  Settings() { EXPECT_EQ(penumbra_settings_create(&held), PENUMBRA_OK); }
  ~Settings() { penumbra_settings_destroy(held); }
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;

  std::string get(const char* name) const {
    std::array<char, 200> text{};
    EXPECT_EQ(penumbra_settings_get(held, name, text.data(), text.size(), nullptr), PENUMBRA_OK);
    return text.data();
  }
  penumbra_settings* held = nullptr;
};

// A refusal: its result, and its message as a whole.
void expect_refused(penumbra_result result, penumbra_result expected, const std::string& message) {
  EXPECT_EQ(result, expected) << penumbra_last_error();
  EXPECT_EQ(penumbra_last_error(), message);
}

TEST(CInterface, SettingsAreReadAsTheyAreSet) {
  const Settings settings;
  EXPECT_EQ(penumbra_settings_set(settings.held, "sun.angle", "1.5"), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_set_number(settings.held, "cascades.count", 3), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_set_number(settings.held, "maps.keep", 0), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_set(settings.held, "sun.shape", "square"), PENUMBRA_OK);
  EXPECT_EQ(settings.get("sun.angle"), "1.5");
  EXPECT_EQ(settings.get("cascades.count"), "3");
  EXPECT_EQ(settings.get("maps.keep"), "false");
  EXPECT_EQ(settings.get("sun.shape"), "square");
  double value = 0;
  EXPECT_EQ(penumbra_settings_get_number(settings.held, "sun.angle", &value), PENUMBRA_OK);
  EXPECT_EQ(value, 1.5);
  EXPECT_EQ(penumbra_settings_get_number(settings.held, "maps.keep", &value), PENUMBRA_OK);
  EXPECT_EQ(value, 0);
  Settings copy;
  penumbra_settings_destroy(copy.held);
  ASSERT_EQ(penumbra_settings_clone(settings.held, &copy.held), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_reset(settings.held, "sun.angle"), PENUMBRA_OK);
  EXPECT_EQ(settings.get("sun.angle"), "0.53");
  EXPECT_EQ(settings.get("cascades.count"), "3");
  EXPECT_EQ(penumbra_settings_reset(settings.held, nullptr), PENUMBRA_OK);
  EXPECT_EQ(settings.get("cascades.count"), "4");
  EXPECT_EQ(copy.get("sun.angle"), "1.5");
}

TEST(CInterface, APresetsTextIsAppliedAsAFileIs) {
  const Settings settings, again;
  const std::string text = "technique = \"thesis\"\n[sun]\nangle = 2.5\n";
  EXPECT_EQ(penumbra_settings_read_preset(settings.held, "mine.toml", text.data(), text.size()), PENUMBRA_OK);
  EXPECT_EQ(settings.get("technique"), "pcss");
  EXPECT_EQ(settings.get("sun.angle"), "2.5");
  std::size_t length = 0;
  ASSERT_EQ(penumbra_settings_write_preset(settings.held, nullptr, 0, &length), PENUMBRA_OK);
  std::string written(length, '\0');
  ASSERT_EQ(penumbra_settings_write_preset(settings.held, written.data(), written.size(), nullptr), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_read_preset(again.held, "again", written.data(), length - 1), PENUMBRA_OK);
  for (std::size_t i = 0; i < penumbra_param_count(); ++i) {
    penumbra_param param{};
    param.struct_size = sizeof param;
    ASSERT_EQ(penumbra_param_info(i, &param), PENUMBRA_OK);
    EXPECT_EQ(settings.get(param.name), again.get(param.name)) << param.name;
  }
}

// Its own scene and pictures are nothing to the library.
TEST(CInterface, WhatAPresetSaysOfTheProgramAloneIsLeftOut) {
  const Settings settings;
  const std::string text =
      "[exposure]\nauto = false\nev = 14.0\n[render]\nhaze = 0.3\n[sun]\nangle = 2.5\n[hybrid]\nrays = 8\n";
  EXPECT_EQ(penumbra_settings_read_preset(settings.held, "mine.toml", text.data(), text.size()), PENUMBRA_OK);
  EXPECT_EQ(settings.get("sun.angle"), "2.5");
  const std::string near = "[renders]\nhaze = 0.3\n";
  expect_refused(penumbra_settings_read_preset(settings.held, "mine.toml", near.data(), near.size()),
                 PENUMBRA_ERROR_REFUSED, "mine.toml:2: unknown parameter 'renders.haze'; see penumbra list params");
  const std::string rays = "technique = \"hybrid\"\n";
  expect_refused(penumbra_settings_read_preset(settings.held, "mine.toml", rays.data(), rays.size()),
                 PENUMBRA_ERROR_REFUSED,
                 "mine.toml:1: technique 'hybrid' needs the program's scene: the library does not have it");
}

TEST(CInterface, TechniquesOfTheProgramAloneAreRefusedAsSuch) {
  const Settings settings;
  const std::vector<std::string> own = shadow::built_in_registry().names();
  int refused = 0;
  for (const std::string& name : session::all_techniques().names()) {
    if (std::ranges::find(own, name) != own.end()) continue;
    expect_refused(penumbra_settings_select(settings.held, name.c_str()), PENUMBRA_ERROR_REFUSED,
                   fmt::format("technique '{}' needs the program's scene: the library does not have it", name));
    ++refused;
  }
  EXPECT_EQ(refused, 3);
}

TEST(CInterface, AnotherTechniqueTakesBackAPresetThatATextNamed) {
  const Settings settings;
  const std::string text = "technique = \"slices_denoised\"\n";
  ASSERT_EQ(penumbra_settings_read_preset(settings.held, "mine.toml", text.data(), text.size()), PENUMBRA_OK);
  EXPECT_EQ(settings.get("filter.visibility"), "isophote");
  ASSERT_EQ(penumbra_settings_select(settings.held, "pcss"), PENUMBRA_OK);
  EXPECT_EQ(settings.get("filter.visibility"), "none");
}

TEST(CInterface, AFaultOfAPresetChangesNothing) {
  const Settings settings;
  const std::string text = "[sun]\nangle = 2.5\nangel = 3.0\n";
  expect_refused(penumbra_settings_read_preset(settings.held, "mine.toml", text.data(), text.size()),
                 PENUMBRA_ERROR_REFUSED, "mine.toml:3: unknown parameter 'sun.angel'; did you mean 'sun.angle'?");
  EXPECT_EQ(settings.get("sun.angle"), "0.53");
  const std::string long_text((1 << 20) + 1, '\n');
  expect_refused(penumbra_settings_read_preset(settings.held, "long", long_text.data(), long_text.size()),
                 PENUMBRA_ERROR_REFUSED, "long: a preset is at most 1 MiB");
  const std::string binary("\0\xff\x80[", 4);
  EXPECT_EQ(penumbra_settings_read_preset(settings.held, "binary", binary.data(), binary.size()),
            PENUMBRA_ERROR_REFUSED);
  EXPECT_EQ(std::string(penumbra_last_error()).rfind("binary:1: ", 0), 0u) << penumbra_last_error();
}

TEST(CInterface, ValuesThatAParameterCannotHaveAreRefused) {
  const Settings settings;
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double value : {nan, infinite, -infinite}) {
    expect_refused(penumbra_settings_set_number(settings.held, "sun.angle", value), PENUMBRA_ERROR_ARGUMENT,
                   "penumbra_settings_set_number(): the value for the parameter 'sun.angle' is not finite");
  }
  expect_refused(penumbra_settings_set_number(settings.held, "cascades.count", 2.5), PENUMBRA_ERROR_REFUSED,
                 "parameter 'cascades.count' takes a whole number, not 2.5");
  expect_refused(penumbra_settings_set_number(settings.held, "maps.keep", 2), PENUMBRA_ERROR_REFUSED,
                 "parameter 'maps.keep' is a switch: 0 or 1, not 2");
  expect_refused(penumbra_settings_set_number(settings.held, "sun.shape", 1), PENUMBRA_ERROR_REFUSED,
                 "parameter 'sun.shape' takes disc|square, not a number");
  for (const double value : {1e300, -1e300, 1e9, 0.0})
    EXPECT_EQ(penumbra_settings_set_number(settings.held, "cascades.count", value), PENUMBRA_ERROR_REFUSED) << value;
  for (const double value : {1e300, -1e300, 21.0})
    EXPECT_EQ(penumbra_settings_set_number(settings.held, "sun.angle", value), PENUMBRA_ERROR_REFUSED) << value;
  for (const char* value : {"nan", "inf", "", "x", "21", "-1"})
    EXPECT_EQ(penumbra_settings_set(settings.held, "sun.angle", value), PENUMBRA_ERROR_REFUSED) << value;
  EXPECT_EQ(settings.get("sun.angle"), "0.53");
  double value = 0;
  expect_refused(penumbra_settings_get_number(settings.held, "sun.shape", &value), PENUMBRA_ERROR_REFUSED,
                 "parameter 'sun.shape' is a word, not a number");
  EXPECT_EQ(penumbra_settings_select(settings.held, "pccs"), PENUMBRA_ERROR_REFUSED);
  EXPECT_NE(std::string(penumbra_last_error()).find("'pcss'"), std::string::npos) << penumbra_last_error();
}

TEST(CInterface, AParameterThatIsLikeNoneIsRefusedWithoutAListOfAll) {
  const Settings settings;
  const char* unknown = "zzzzzzzz";
  double number = 0;
  const auto refused = [](penumbra_result result) {
    expect_refused(result, PENUMBRA_ERROR_REFUSED, "unknown parameter 'zzzzzzzz'; see penumbra_param_info()");
  };
  refused(penumbra_settings_set(settings.held, unknown, "1"));
  refused(penumbra_settings_set_number(settings.held, unknown, 1));
  refused(penumbra_settings_reset(settings.held, unknown));
  refused(penumbra_settings_get(settings.held, unknown, nullptr, 0, nullptr));
  refused(penumbra_settings_get_number(settings.held, unknown, &number));
  expect_refused(penumbra_settings_set(settings.held, "sun.angel", "1"), PENUMBRA_ERROR_REFUSED,
                 "unknown parameter 'sun.angel'; did you mean 'sun.angle'?");
}

TEST(CInterface, EveryParameterAndTechniqueIsListed) {
  const ParamSet params(shadow::built_in_registry().params());
  ASSERT_EQ(penumbra_param_count(), params.rows().size());
  const Settings settings;
  for (std::size_t i = 0; i < penumbra_param_count(); ++i) {
    penumbra_param param{};
    param.struct_size = sizeof param;
    ASSERT_EQ(penumbra_param_info(i, &param), PENUMBRA_OK);
    const Param& row = params.rows()[i];
    EXPECT_EQ(param.name, row.name);
    EXPECT_EQ(param.unit, row.unit);
    EXPECT_EQ(param.help, row.help);
    EXPECT_EQ(settings.get(param.name), param.default_value);
    ASSERT_EQ(param.choice_count, row.choices.size());
    for (uint32_t choice = 0; choice < param.choice_count; ++choice) {
      EXPECT_EQ(penumbra_settings_set(settings.held, param.name, param.choices[choice]), PENUMBRA_OK);
    }
    if (param.type == PENUMBRA_TYPE_INTEGER || param.type == PENUMBRA_TYPE_REAL) {
      EXPECT_EQ(penumbra_settings_set_number(settings.held, param.name, param.least), PENUMBRA_OK) << param.name;
      EXPECT_EQ(penumbra_settings_set_number(settings.held, param.name, param.greatest), PENUMBRA_OK) << param.name;
    }
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < penumbra_technique_count(); ++i) {
    penumbra_technique technique{};
    technique.struct_size = sizeof technique;
    ASSERT_EQ(penumbra_technique_info(i, &technique), PENUMBRA_OK);
    names.emplace_back(technique.name);
    EXPECT_EQ(penumbra_settings_select(settings.held, technique.name), PENUMBRA_OK);
    EXPECT_STRNE(technique.summary, "");
    const auto is_it = [&](const shadow::Preset& preset) { return preset.name == names.back(); };
    EXPECT_EQ(technique.is_preset, std::ranges::any_of(shadow::built_in_registry().presets(), is_it) ? 1u : 0u);
  }
  EXPECT_EQ(names, shadow::built_in_registry().names());
}

std::string preset_of(const penumbra_settings* settings) {
  std::string text(1 << 14, '\0');
  std::size_t length = 0;
  EXPECT_EQ(penumbra_settings_write_preset(settings, text.data(), text.size(), &length), PENUMBRA_OK);
  return text.substr(0, length - 1);
}

// It names the technique, and what the preset sets beside it.
TEST(CInterface, AChoiceLeavesNothingOfAPresetThatWasWrittenBefore) {
  const Settings fresh;
  ASSERT_EQ(penumbra_settings_select(fresh.held, "hard"), PENUMBRA_OK);
  for (const std::string& name : shadow::built_in_registry().names()) {
    const Settings chosen, settings;
    ASSERT_EQ(penumbra_settings_select(chosen.held, name.c_str()), PENUMBRA_OK);
    const std::string text = preset_of(chosen.held);
    ASSERT_EQ(penumbra_settings_read_preset(settings.held, "mine.toml", text.data(), text.size()), PENUMBRA_OK);
    ASSERT_EQ(penumbra_settings_select(settings.held, "hard"), PENUMBRA_OK);
    EXPECT_EQ(preset_of(settings.held), preset_of(fresh.held)) << name;
  }
}

TEST(CInterface, AChoiceLeavesNothingOfThePresetBefore) {
  const std::vector<std::string> names = shadow::built_in_registry().names();
  for (const std::string& second : names) {
    const Settings fresh;
    ASSERT_EQ(penumbra_settings_select(fresh.held, second.c_str()), PENUMBRA_OK);
    for (const std::string& first : names) {
      const Settings settings;
      ASSERT_EQ(penumbra_settings_select(settings.held, first.c_str()), PENUMBRA_OK);
      ASSERT_EQ(penumbra_settings_select(settings.held, second.c_str()), PENUMBRA_OK);
      EXPECT_EQ(preset_of(settings.held), preset_of(fresh.held)) << first << ", then " << second;
    }
  }
  const Settings changed;
  ASSERT_EQ(penumbra_settings_select(changed.held, "slices_history"), PENUMBRA_OK);
  ASSERT_EQ(penumbra_settings_set(changed.held, "history.alpha", "0.25"), PENUMBRA_OK);
  ASSERT_EQ(penumbra_settings_select(changed.held, "slices_denoised"), PENUMBRA_OK);
  double alpha = 0, reuse = 1;
  EXPECT_EQ(penumbra_settings_get_number(changed.held, "history.alpha", &alpha), PENUMBRA_OK);
  EXPECT_EQ(penumbra_settings_get_number(changed.held, "history.reuse", &reuse), PENUMBRA_OK);
  EXPECT_EQ(alpha, 0.25);
  EXPECT_EQ(reuse, 0);
}

TEST(CInterface, ATextTooLongForItsBufferIsLeftOut) {
  const Settings settings;
  std::size_t length = 0;
  EXPECT_EQ(penumbra_settings_get(settings.held, "sun.shape", nullptr, 0, &length), PENUMBRA_OK);
  EXPECT_EQ(length, sizeof "disc");
  std::array<char, 5> text{'?', '?', '?', '?', '?'};
  length = 0;
  expect_refused(penumbra_settings_get(settings.held, "sun.shape", text.data(), 4, &length), PENUMBRA_ERROR_BUFFER,
                 "penumbra_settings_get(): the text takes 5 bytes and 'capacity' is 4");
  EXPECT_EQ(length, 5u);
  EXPECT_EQ(text, (std::array<char, 5>{'\0', '?', '?', '?', '?'}));
  EXPECT_EQ(penumbra_settings_get(settings.held, "sun.shape", text.data(), 0, nullptr), PENUMBRA_ERROR_BUFFER);
  EXPECT_EQ(penumbra_settings_get(settings.held, "sun.shape", text.data(), 5, nullptr), PENUMBRA_OK);
  EXPECT_STREQ(text.data(), "disc");
  expect_refused(penumbra_settings_get(settings.held, "sun.shape", nullptr, 4, nullptr), PENUMBRA_ERROR_ARGUMENT,
                 "penumbra_settings_get(): 'text' is null and 'capacity' is not 0");
}

TEST(CInterface, EveryFunctionRefusesNull) {
  const Settings settings;
  double number = 0;
  uint32_t reads = 0;
  penumbra_mask mask{};
  penumbra_frame frame{};
  penumbra_device* device = nullptr;
  const auto refused = [](penumbra_result result, const std::string& message) {
    expect_refused(result, PENUMBRA_ERROR_ARGUMENT, message);
  };
  refused(penumbra_device_desc_init(nullptr, 40), "penumbra_device_desc_init(): 'desc' is null");
  refused(penumbra_light_init(nullptr, 80), "penumbra_light_init(): 'light' is null");
  refused(penumbra_frame_init(nullptr, 500), "penumbra_frame_init(): 'frame' is null");
  refused(penumbra_device_create(nullptr, &device), "penumbra_device_create(): 'desc' is null");
  penumbra_device_desc desc;
  ASSERT_EQ(penumbra_device_desc_init(&desc, sizeof desc), PENUMBRA_OK);
  refused(penumbra_device_create(&desc, nullptr), "penumbra_device_create(): 'device' is null");
  refused(penumbra_device_create(&desc, &device), "penumbra_device_create(): 'penumbra_device_desc.get_proc' is null");
  EXPECT_EQ(device, nullptr);
  EXPECT_EQ(penumbra_device_destroy(nullptr), PENUMBRA_OK);
  refused(penumbra_device_abandon(nullptr), "penumbra_device_abandon(): 'device' is null");
  refused(penumbra_settings_create(nullptr), "penumbra_settings_create(): 'settings' is null");
  penumbra_settings* copy = settings.held;
  refused(penumbra_settings_clone(nullptr, &copy), "penumbra_settings_clone(): 'settings' is null");
  EXPECT_EQ(copy, nullptr);
  refused(penumbra_settings_clone(settings.held, nullptr), "penumbra_settings_clone(): 'copy' is null");
  penumbra_settings_destroy(nullptr);
  refused(penumbra_settings_select(nullptr, "pcss"), "penumbra_settings_select(): 'settings' is null");
  refused(penumbra_settings_select(settings.held, nullptr), "penumbra_settings_select(): 'technique' is null");
  refused(penumbra_settings_set(nullptr, "sun.angle", "1"), "penumbra_settings_set(): 'settings' is null");
  refused(penumbra_settings_set(settings.held, nullptr, "1"), "penumbra_settings_set(): 'name' is null");
  refused(penumbra_settings_set(settings.held, "sun.angle", nullptr), "penumbra_settings_set(): 'value' is null");
  refused(penumbra_settings_set_number(nullptr, "sun.angle", 1), "penumbra_settings_set_number(): 'settings' is null");
  refused(penumbra_settings_set_number(settings.held, nullptr, 1), "penumbra_settings_set_number(): 'name' is null");
  refused(penumbra_settings_reset(nullptr, nullptr), "penumbra_settings_reset(): 'settings' is null");
  refused(penumbra_settings_get(nullptr, "sun.angle", nullptr, 0, nullptr),
          "penumbra_settings_get(): 'settings' is null");
  refused(penumbra_settings_get(settings.held, nullptr, nullptr, 0, nullptr),
          "penumbra_settings_get(): 'name' is null");
  refused(penumbra_settings_get_number(nullptr, "sun.angle", &number),
          "penumbra_settings_get_number(): 'settings' is null");
  refused(penumbra_settings_get_number(settings.held, nullptr, &number),
          "penumbra_settings_get_number(): 'name' is null");
  refused(penumbra_settings_get_number(settings.held, "sun.angle", nullptr),
          "penumbra_settings_get_number(): 'value' is null");
  refused(penumbra_settings_read_preset(nullptr, "x", "", 0), "penumbra_settings_read_preset(): 'settings' is null");
  refused(penumbra_settings_read_preset(settings.held, nullptr, "", 0),
          "penumbra_settings_read_preset(): 'file' is null");
  refused(penumbra_settings_read_preset(settings.held, "x", nullptr, 1),
          "penumbra_settings_read_preset(): 'text' is null and 'length' is not 0");
  EXPECT_EQ(penumbra_settings_read_preset(settings.held, "x", nullptr, 0), PENUMBRA_OK);
  refused(penumbra_settings_write_preset(nullptr, nullptr, 0, nullptr),
          "penumbra_settings_write_preset(): 'settings' is null");
  refused(penumbra_param_info(0, nullptr), "penumbra_param_info(): 'param' is null");
  refused(penumbra_technique_info(0, nullptr), "penumbra_technique_info(): 'technique' is null");
  refused(penumbra_render(nullptr, settings.held, &frame, &mask), "penumbra_render(): 'device' is null");
  refused(penumbra_reads_motion(nullptr, settings.held, nullptr, 0, &reads),
          "penumbra_reads_motion(): 'device' is null");
  refused(penumbra_forget_view(nullptr, 0), "penumbra_forget_view(): 'device' is null");
  refused(penumbra_warm_up(nullptr, settings.held, &frame), "penumbra_warm_up(): 'device' is null");
  refused(penumbra_forward_source(nullptr, settings.held, nullptr, nullptr, 0, nullptr),
          "penumbra_forward_source(): 'device' is null");
  refused(penumbra_bind_forward(nullptr, 0, 0), "penumbra_bind_forward(): 'device' is null");
  refused(penumbra_unbind_forward(nullptr), "penumbra_unbind_forward(): 'device' is null");
}

// Of penumbra_frame in the first version of the interface.
constexpr std::size_t first_frame_size = 488;

// A struct of an earlier version ends before that of this one; sizes below the first version's are mistakes.
TEST(CInterface, SizesOfStructsAreChecked) {
  penumbra_frame frame{};
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, first_frame_size - 1, std::size_t{65536},
                                 std::numeric_limits<std::size_t>::max()}) {
    expect_refused(penumbra_frame_init(&frame, size), PENUMBRA_ERROR_ARGUMENT,
                   fmt::format("penumbra_frame_init(): penumbra_frame.struct_size is {}; set it to "
                               "sizeof(penumbra_frame), which is {}",
                               size, sizeof frame));
  }
  EXPECT_EQ(frame.struct_size, 0u);
  frame.exact_bounds = 0x5a;
  EXPECT_EQ(penumbra_frame_init(&frame, first_frame_size), PENUMBRA_OK) << penumbra_last_error();
  EXPECT_EQ(frame.exact_bounds, 0x5au) << "written beyond what an earlier program has";
  penumbra_param param{};
  for (const std::size_t size : {std::size_t{0}, std::numeric_limits<std::size_t>::max()}) {
    param.struct_size = size;
    EXPECT_EQ(penumbra_param_info(0, &param), PENUMBRA_ERROR_ARGUMENT) << size;
  }
  EXPECT_EQ(param.name, nullptr);
  param.struct_size = sizeof param;
  expect_refused(penumbra_param_info(penumbra_param_count(), &param), PENUMBRA_ERROR_ARGUMENT,
                 fmt::format("penumbra_param_info(): 'index' is {0} and there are {0}", penumbra_param_count()));
  EXPECT_EQ(penumbra_technique_info(std::numeric_limits<std::size_t>::max(), nullptr), PENUMBRA_ERROR_ARGUMENT);
}

// What a program gets that was compiled with a later header: more room, all 0.
TEST(CInterface, LargerStructsAreFilledWithZeros) {
  struct {
    penumbra_device_desc desc;
    std::array<unsigned char, 64> later;
  } larger;
  std::memset(static_cast<void*>(&larger), 0x5a, sizeof larger);
  ASSERT_EQ(penumbra_device_desc_init(&larger.desc, sizeof larger), PENUMBRA_OK);
  EXPECT_EQ(larger.desc.struct_size, sizeof larger);
  EXPECT_EQ(larger.later, (std::array<unsigned char, 64>{}));
  larger.desc.get_proc = [](void*, const char*) -> penumbra_proc { return nullptr; };
  penumbra_device* device = nullptr;
  EXPECT_EQ(penumbra_device_create(&larger.desc, &device), PENUMBRA_ERROR_CONTEXT) << penumbra_last_error();
  larger.later[63] = 1;
  expect_refused(
      penumbra_device_create(&larger.desc, &device), PENUMBRA_ERROR_ARGUMENT,
      fmt::format("penumbra_device_create(): penumbra_device_desc.struct_size is {}: the library, which is older than "
                  "the program, knows {} bytes, and the bytes after them are not all 0",
                  sizeof larger, sizeof larger.desc));
}

TEST(CInterface, DefaultsAreThoseOfTheFacade) {
  penumbra_frame frame;
  ASSERT_EQ(penumbra_frame_init(&frame, sizeof frame), PENUMBRA_OK);
  const shadow::Conventions conventions;
  EXPECT_EQ(frame.reversed_z != 0, conventions.reversed_z);
  EXPECT_EQ(frame.depth_zero_to_one != 0, conventions.depth_zero_to_one);
  EXPECT_EQ(frame.normals_encoding == PENUMBRA_NORMALS_OCTAHEDRAL, conventions.octahedral_normals);
  EXPECT_EQ(frame.exact_bounds != 0, shadow::Inputs().exact_bounds);
  EXPECT_EQ(frame.normals_scale, conventions.normals_scale);
  EXPECT_EQ(frame.normals_offset, conventions.normals_offset);
  EXPECT_GT(frame.casters.min[0], frame.casters.max[0]);
  EXPECT_EQ(frame.view[5], 1.0f);
  EXPECT_EQ(frame.view[4], 0.0f);
  penumbra_light light;
  ASSERT_EQ(penumbra_light_init(&light, sizeof light), PENUMBRA_OK);
  EXPECT_EQ(light.radius, shadow::Lamp().radius);
  EXPECT_EQ(light.to_light[1], shadow::Sun().to_light.y);
  EXPECT_EQ(light.output_texture, 0u);
}

TEST(CInterface, EachThreadHasItsOwnLastError) {
  EXPECT_EQ(penumbra_settings_create(nullptr), PENUMBRA_ERROR_ARGUMENT);
  std::string first, then;
  std::thread([&] {
    first = penumbra_last_error();
    penumbra_device_abandon(nullptr);
    then = penumbra_last_error();
  }).join();
  EXPECT_EQ(first, "");
  EXPECT_EQ(then, "penumbra_device_abandon(): 'device' is null");
  EXPECT_STREQ(penumbra_last_error(), "penumbra_settings_create(): 'settings' is null");
}

TEST(CInterface, ResultsHaveNames) {
  for (int i = PENUMBRA_OK; i <= PENUMBRA_ERROR_INTERNAL; ++i)
    EXPECT_EQ(std::string(penumbra_result_name(static_cast<penumbra_result>(i))).rfind("PENUMBRA_", 0), 0u) << i;
  EXPECT_STREQ(penumbra_result_name(PENUMBRA_ERROR_BUFFER), "PENUMBRA_ERROR_BUFFER");
}

}  // namespace
}  // namespace penumbra
