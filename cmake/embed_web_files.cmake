# Run by penumbra_embed_web(): writes the files of FOLDER as raw string literals to OUTPUT, the styles one after the
# other, page.css last: its rules for narrow pages and for print override the others.
set(literals_css "")
foreach(name IN ITEMS figures pictures page)
  file(READ "${FOLDER}/${name}.css" text)
  string(APPEND literals_css "\n    R\"penumbra_web(${text})penumbra_web\"")
endforeach()
file(READ "${FOLDER}/page.js" script)
file(WRITE "${OUTPUT}" "#include \"report/web_files.h\"

namespace penumbra::report {

std::string_view page_css() {
  return${literals_css};
}

std::string_view page_js() { return R\"penumbra_web(${script})penumbra_web\"; }

}  // namespace penumbra::report
")
