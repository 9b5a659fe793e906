#include "report/text_blocks.h"

#include <algorithm>
#include <cctype>

namespace penumbra::report {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Where the name of an option that begins at `begin` ends, such as "--size"; `begin` if none begins there.
std::size_t option_end(std::string_view text, std::size_t begin) {
  if (begin > 0 && std::string_view(" \n('").find(text[begin - 1]) == std::string_view::npos) return begin;
  std::size_t end = std::min(text.find_first_not_of('-', begin), text.size());
  if (end == begin || end > begin + 2 || end == text.size() || !is_letter(text[end])) return begin;
  while (end < text.size() && (is_letter(text[end]) || text[end] == '-')) ++end;
  return end;
}

// Escaped text in which the name of an option stays in one piece: browsers break lines after hyphens.
Html with_whole_options(std::string_view text) {
  Html html;
  std::size_t written = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = option_end(text, i);
    if (end == i) continue;
    html.text(text.substr(written, i - written));
    html.add("<span class='option'>").text(text.substr(i, end - i)).add("</span>");
    written = end;
    i = end - 1;
  }
  return html.text(text.substr(written));
}

}  // namespace

Html paragraph(std::string_view text) { return Html("<p>").add(with_whole_options(text)).add("</p>\n"); }

Html note(std::string_view text) { return Html("<p class='note'>").add(with_whole_options(text)).add("</p>\n"); }

Html heading(std::string_view text) { return Html("<h3>").text(text).add("</h3>\n"); }

Html code_block(std::string_view code) {
  return Html("<div class='code'><pre tabindex='0'><code>")
      .add(with_whole_options(code))
      .add("</code></pre><button type='button' class='copy'>Copy</button></div>\n");
}

Html definition_list(const std::vector<std::pair<std::string, std::string>>& entries) {
  if (entries.empty()) return {};
  Html html("<dl>\n");
  for (const auto& [name, value] : entries)
    html.add("<div><dt>").text(name).add("</dt><dd>").add(with_whole_options(value)).add("</dd></div>\n");
  return html.add("</dl>\n");
}

Html details(std::string_view title, const Html& body) {
  return Html("<details><summary>").text(title).add("</summary>\n").add(body).add("</details>\n");
}

}  // namespace penumbra::report
