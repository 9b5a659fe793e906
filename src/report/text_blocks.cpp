#include "report/text_blocks.h"

namespace penumbra::report {

Html paragraph(std::string_view text) { return Html("<p>").text(text).add("</p>\n"); }

Html note(std::string_view text) { return Html("<p class='note'>").text(text).add("</p>\n"); }

Html heading(std::string_view text) { return Html("<h3>").text(text).add("</h3>\n"); }

Html code_block(std::string_view code) {
  return Html("<div class='code'><pre tabindex='0'><code>")
      .text(code)
      .add("</code></pre><button type='button' class='copy'>Copy</button></div>\n");
}

Html definition_list(const std::vector<std::pair<std::string, std::string>>& entries) {
  if (entries.empty()) return {};
  Html html("<dl>\n");
  for (const auto& [name, value] : entries)
    html.add("<div><dt>").text(name).add("</dt><dd>").text(value).add("</dd></div>\n");
  return html.add("</dl>\n");
}

Html details(std::string_view title, const Html& body) {
  return Html("<details><summary>").text(title).add("</summary>\n").add(body).add("</details>\n");
}

}  // namespace penumbra::report
