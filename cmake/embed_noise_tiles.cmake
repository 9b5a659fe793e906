# Run by penumbra_embed_noise(): writes the tiles in FOLDER, 16-bit little endian, as arrays of numbers to OUTPUT.
set(arrays "")
foreach(kind IN ITEMS blue void_and_cluster)
  file(READ "${FOLDER}/${kind}.u16" hex HEX)
  string(REGEX REPLACE "(..)(..)" "0x\\2\\1," numbers "${hex}")
  string(APPEND arrays "const std::array<std::uint16_t, built_in_noise_values> ${kind}_ranks{${numbers}};\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"shadow/noise_tiles.h\"

namespace penumbra::shadow {

${arrays}
}  // namespace penumbra::shadow
")
