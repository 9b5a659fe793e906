#include "gpu_test.h"

#include <cstdlib>
#include <memory>

#include "gl/debug.h"

namespace penumbra::test {

std::string backend_name() {
  const char* name = std::getenv("PENUMBRA_TEST_BACKEND");
  return name == nullptr || *name == '\0' ? "egl" : name;
}

gl::Context& test_context() {
  static const std::unique_ptr<gl::Context> context = gl::make_context(backend_name(), {.debug = true});
  return *context;
}

GpuTest::GpuTest() { test_context().make_current(); }

void GpuTest::TearDown() { EXPECT_NO_THROW(gl::check_errors("end of test")); }

gl::ShaderFiles shader_files(std::initializer_list<std::pair<const char*, const char*>> files) {
  gl::ShaderFiles result;
  for (const auto& [name, text] : files) result.put(name, text);
  return result;
}

}  // namespace penumbra::test
