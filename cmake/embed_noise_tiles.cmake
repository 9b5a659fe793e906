# Run by penumbra_embed_noise(): writes the tiles in FOLDER, 16-bit little endian, as arrays of numbers to OUTPUT.
set(arrays "")
foreach(tile IN ITEMS blue void_and_cluster spatiotemporal sample_keys)
  file(READ "${FOLDER}/${tile}.u16" hex HEX)
  string(REGEX REPLACE "(..)(..)" "0x\\2\\1," numbers "${hex}")
  string(APPEND arrays "const decltype(${tile}_tile) ${tile}_tile{${numbers}};\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"shadow/noise_tiles.h\"

namespace penumbra::shadow {

${arrays}
}  // namespace penumbra::shadow
")
