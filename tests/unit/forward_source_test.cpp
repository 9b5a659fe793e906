#include "shadow/forward_source.h"

#include <gtest/gtest.h>

#include <string>

namespace penumbra::shadow {
namespace {

std::string prefixed(const char* glsl) { return with_prefix(glsl, "p_"); }

TEST(WithPrefix, RenamesWhatIsDeclaredAtGlobalScopeWhereverItStands) {
  EXPECT_EQ(prefixed("struct S { float s; };\nS make(float s) { S made; return made; }\n"),
            "struct p_S { float s; };\np_S p_make(float s) { p_S made; return made; }\n");
  EXPECT_EQ(prefixed("const float a = 1.0e5, b = sqrt(2.0);\nfloat f() { return a + sin(a); }\n"),
            "const float p_a = 1.0e5, p_b = sqrt(2.0);\nfloat p_f() { return p_a + sin(p_a); }\n");
  EXPECT_EQ(prefixed("uniform int flags[4];\nint g() { return flags[0]; }"),
            "uniform int p_flags[4];\nint p_g() { return p_flags[0]; }");
}

TEST(WithPrefix, BlocksAndTheirMembersAreGlobal) {
  EXPECT_EQ(prefixed("layout(std140, binding = 0) uniform Params {\n  float scale;\n};\nfloat f() { return scale; }"),
            "layout(std140, binding = 0) uniform p_Params {\n  float p_scale;\n};\nfloat p_f() { return p_scale; }");
  EXPECT_EQ(prefixed("layout(binding = 2) uniform sampler2D map;\nstruct T { vec4 v; };"),
            "layout(binding = 2) uniform sampler2D p_map;\nstruct p_T { vec4 v; };");
}

TEST(WithPrefix, MacrosAreRenamedInDirectivesToo) {
  EXPECT_EQ(prefixed("#define TAPS 4\n#if TAPS > 2\nint n() { return TAPS; }\n#endif\n"),
            "#define p_TAPS 4\n#if p_TAPS > 2\nint p_n() { return p_TAPS; }\n#endif\n");
}

TEST(WithPrefix, CommentsNumbersAndNamesThatHaveItStay) {
  EXPECT_EQ(prefixed("// f of x\nfloat f(float x) { /* f */ return 2.0f * x; }\nfloat p_g() { return f(1e3); }"),
            "// f of x\nfloat p_f(float x) { /* f */ return 2.0f * x; }\nfloat p_g() { return p_f(1e3); }");
}

TEST(WithoutVersion, OnlyTheFirstLineGoes) {
  EXPECT_EQ(without_version("#version 450 core\n#define A\n"), "#define A\n");
  EXPECT_EQ(without_version("float f;"), "float f;");
}

}  // namespace
}  // namespace penumbra::shadow
