# Run by penumbra_embed_web(): writes page.css and page.js of FOLDER as raw string literals to OUTPUT.
set(functions "")
foreach(name IN ITEMS page.css page.js)
  file(READ "${FOLDER}/${name}" text)
  string(REPLACE "." "_" function "${name}")
  string(APPEND functions "std::string_view ${function}() { return R\"penumbra_web(${text})penumbra_web\"; }\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"report/web_files.h\"

namespace penumbra::report {

${functions}
}  // namespace penumbra::report
")
