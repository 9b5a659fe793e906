#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <utility>

#include "core/error.h"
#include "gl/context.h"
#include "gl/pass.h"

namespace penumbra::test {

// The backend that GPU tests run on: PENUMBRA_TEST_BACKEND, or "egl".
std::string backend_name();

// The debug context of the tests below, which is made once per process.
gl::Context& test_context();

// A test with a debug context, which is made once per process and is current before members of test classes are
// constructed. It fails on any GL error or debug message of type error.
class GpuTest : public testing::Test {
 protected:
  GpuTest();
  void TearDown() override;
};

// Shader files of a test: the built-in ones and these, by name and text.
gl::ShaderFiles shader_files(std::initializer_list<std::pair<const char*, const char*>> files);

// A pass that does nothing but set its state and clear.
inline void clear(gl::Device& device, const gl::PassDesc& desc) { const gl::Pass pass(device, desc); }

// The message of the penumbra::Error that `call` throws; fails the test if it throws none.
template <class Call>
std::string message_of(Call&& call) {
  try {
    std::forward<Call>(call)();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "no penumbra::Error was thrown";
  return "";
}

}  // namespace penumbra::test
