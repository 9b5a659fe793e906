// Programs of parameter values that are no longer used, as while a slider is dragged, are deleted at
// some point, and are not compiled again when a shader is saved.
#include "gl/shader_library.h"

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

class ShaderIdleTest : public test::GpuTest {
 protected:
  static constexpr const char* good = "layout(local_size_x = TAPS) in;\nvoid main() {}\n";
  static constexpr const char* broken = "layout(local_size_x = TAPS) in;\nvoid main() { oops; }\n";

  static gl::ProgramDesc with_taps(int taps) {
    return {
        .name = std::to_string(taps) + " taps", .compute = "taps.comp", .defines = {{"TAPS", std::to_string(taps)}}};
  }
  void frames(int count, int taps) {
    for (int i = 0; i < count; ++i) {
      library.next_frame();
      library.get(with_taps(taps));
    }
  }
  gl::ShaderLibrary::Reload save(const char* text) {
    library.files().put("taps.comp", text);
    library.changed("taps.comp");
    return library.reload();
  }

  static constexpr int most = static_cast<int>(gl::ShaderLibrary::usual_idle);
  static constexpr int long_enough = static_cast<int>(gl::ShaderLibrary::idle_after) + 1;

  gl::ShaderLibrary library{test::shader_files({{"taps.comp", good}})};
};

TEST_F(ShaderIdleTest, OnlyTheLatestOfManyValuesStay) {
  const gl::Program& in_use = library.get(with_taps(1));
  const GLuint id = in_use.id();
  for (int taps = 2; taps < 2 * most; ++taps) {
    library.next_frame();
    library.get(with_taps(1));
    library.get(with_taps(taps));
    ASSERT_LE(library.size(), static_cast<std::size_t>(most + long_enough + 1));
  }
  EXPECT_EQ(library.get(with_taps(1)).id(), id) << "what every frame uses was compiled again";
  EXPECT_EQ(in_use.id(), id);
}

TEST_F(ShaderIdleTest, AsManyStayAsTheCallerKeeps) {
  const GLuint id = library.get(with_taps(1)).id();
  library.keep_idle(2 * most);
  for (int taps = 2; taps < 2 * most; ++taps) frames(1, taps);
  frames(long_enough, 2);
  EXPECT_EQ(library.size(), static_cast<std::size_t>(2 * most - 1));
  EXPECT_EQ(library.get(with_taps(1)).id(), id);
}

TEST_F(ShaderIdleTest, ASaveCompilesWhatFramesUse) {
  for (int taps = 1; taps <= 20; ++taps) frames(1, taps);
  frames(long_enough, 21);
  EXPECT_EQ(save("layout(local_size_x = 2 * TAPS) in;\nvoid main() {}\n").rebuilt, 1u);
  EXPECT_EQ(library.get(with_taps(21)).group_size().x, 42);
  EXPECT_EQ(library.get(with_taps(3)).group_size().x, 6) << "a value that comes back";
}

TEST_F(ShaderIdleTest, AnIdleProgramThatComesBackBrokenDrawsWithItsLastGoodVersion) {
  frames(1, 3);
  frames(long_enough, 21);
  EXPECT_EQ(save(broken).failed, 1u) << "what frames use";
  EXPECT_EQ(library.errors().size(), 1u);

  library.take_outdated();
  library.next_frame();
  EXPECT_EQ(library.get(with_taps(3)).group_size().x, 3);
  EXPECT_TRUE(library.take_outdated());
  EXPECT_EQ(library.errors().size(), 2u);
  EXPECT_EQ(save(good).rebuilt, 2u);
  EXPECT_TRUE(library.errors().empty());
}

TEST_F(ShaderIdleTest, AFaultOfAProgramThatHasBecomeIdleIsTakenBackByASave) {
  frames(1, 3);
  EXPECT_EQ(save(broken).failed, 1u);
  library.files().put("other.comp", good);
  for (int i = 0; i < long_enough; ++i) {
    library.next_frame();
    library.get({.name = "other", .compute = "other.comp", .defines = {{"TAPS", "1"}}});
  }
  EXPECT_EQ(library.errors().size(), 1u);
  save(good);
  EXPECT_TRUE(library.errors().empty());
  EXPECT_EQ(library.get(with_taps(3)).group_size().x, 3);
  EXPECT_FALSE(library.take_outdated());
}

TEST_F(ShaderIdleTest, WhereNoFramesAreCountedAllStay) {
  for (int taps = 1; taps <= 2 * most; ++taps) library.get(with_taps(taps));
  EXPECT_EQ(library.size(), static_cast<std::size_t>(2 * most));
  library.changed("taps.comp");
  EXPECT_EQ(library.reload().rebuilt, static_cast<std::size_t>(2 * most));
}

}  // namespace
}  // namespace penumbra
