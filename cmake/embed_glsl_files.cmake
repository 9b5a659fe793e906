# Run by penumbra_embed_glsl(): writes the files named in LIST, relative to ROOT, as raw string literals to OUTPUT.
file(READ "${LIST}" names)
set(entries "")
foreach(name IN LISTS names)
  file(READ "${ROOT}/${name}" text)
  string(APPEND entries "    {\"${name}\", R\"penumbra_glsl(${text})penumbra_glsl\"},\n")
endforeach()
list(LENGTH names count)
file(WRITE "${OUTPUT}" "#include \"gl/built_in_files.h\"

#include <array>

namespace penumbra::gl {

namespace {
constexpr std::array<BuiltInFile, ${count}> files{{
${entries}}};
}  // namespace

std::span<const BuiltInFile> built_in_files() { return files; }

}  // namespace penumbra::gl
")
