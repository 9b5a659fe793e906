#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "report/picture.h"
#include "report/web_files.h"

namespace penumbra::report {

namespace {

constexpr std::string_view policy =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

std::string head(const Page& page) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n"
      "<meta http-equiv='Content-Security-Policy' content='{}'>\n"
      "<meta name='viewport' content='width=device-width, initial-scale=1'>\n"
      "<meta name='color-scheme' content='light dark'>\n<link rel='icon' href='data:,'>\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n",
      escape(policy), escape(page.title), page_css());
}

std::string id_of(std::size_t section) { return fmt::format("section-{}", section + 1); }

Html header(const Page& page) {
  Html html("<header>\n<h1>");
  html.text(page.title).add("</h1>\n");
  if (!page.summary.empty()) html.add("<p class='lead'>").text(page.summary).add("</p>\n");
  if (!page.facts.empty()) html.add("<dl class='facts'>\n");
  for (const auto& [name, value] : page.facts)
    html.add("<div><dt>").text(name).add("</dt><dd>").text(value).add("</dd></div>\n");
  if (!page.facts.empty()) html.add("</dl>\n");
  return html.add("</header>\n");
}

Html contents(const Page& page) {
  if (page.sections.size() < 2) return {};
  Html html("<nav aria-label='Contents'><ul>\n");
  for (std::size_t i = 0; i < page.sections.size(); ++i)
    html.add("<li><a href='#" + id_of(i) + "'>").text(page.sections[i].title).add("</a></li>\n");
  return html.add("</ul></nav>\n");
}

// Chooses the range of all error maps.
std::string range_choice() {
  std::string options = "<option value=''>as drawn</option>";
  for (const double range : error_ranges) options += fmt::format("<option value='{0:g}'>±{0:g}</option>", range);
  return "<label class='range'>Colours of errors <select id='error-range'>" + options + "</select></label>";
}

// Stays in sight while the page has pictures.
constexpr std::string_view picture_bar =
    "<div class='picture-bar' role='toolbar' aria-label='All pictures'>"
    "<span class='group' role='group' aria-label='Zoom'><span aria-hidden='true'>Zoom</span>"
    "<button type='button' data-zoom='1' aria-pressed='true'>1×</button>"
    "<button type='button' data-zoom='2' aria-pressed='false'>2×</button>"
    "<button type='button' data-zoom='4' aria-pressed='false'>4×</button></span>"
    "<label><input type='checkbox' id='together' checked> Move all dividers together</label>"
    "{}<span class='hint'>Zoomed in, drag a picture or use the arrow keys: all pictures show the same spot.</span>"
    "</div>\n";

bool has_part(const Page& page, const std::function<bool(const Html::Part&)>& is) {
  return std::ranges::any_of(page.sections,
                             [&](const Section& section) { return std::ranges::any_of(section.body.parts(), is); });
}

bool has_pictures(const Page& page) {
  return has_part(page, [](const Html::Part& part) { return part.picture.png != nullptr; });
}

bool has_error_maps(const Page& page) {
  return has_part(page,
                  [](const Html::Part& part) { return part.markup.find("class='error-map'") != std::string::npos; });
}

// The first <img> of a picture holds its data; page.js copies it to the others.
class Writer {
 public:
  explicit Writer(const std::function<void(std::string_view)>& write) : write_(write) {}

  void add(std::string_view markup) { write_(markup); }

  void add(const Html& html) {
    for (const Html::Part& part : html.parts()) {
      write_(part.markup);
      if (part.picture.png) write_(source_of(part.picture));
    }
  }

 private:
  std::string source_of(const EncodedPicture& picture) {
    const std::vector<std::byte>& png = *picture.png;
    const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
    const auto [entry, is_new] = numbers_.try_emplace(bytes, numbers_.size() + 1);
    return is_new ? fmt::format(" id='picture-{}' src='{}'", entry->second, data_uri(picture))
                  : fmt::format(" data-same-as='picture-{}'", entry->second);
  }

  const std::function<void(std::string_view)>& write_;
  std::map<std::string_view, std::size_t> numbers_;  // by the pictures' bytes
};

}  // namespace

void write_text(const Page& page, const std::function<void(std::string_view)>& write) {
  Writer writer(write);
  writer.add(head(page));
  writer.add("<body>\n");
  writer.add(header(page));
  writer.add(contents(page));
  if (has_pictures(page)) writer.add(fmt::format(picture_bar, has_error_maps(page) ? range_choice() : ""));
  writer.add("<main>\n");
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    const Section& section = page.sections[i];
    writer.add(
        fmt::format("<section aria-labelledby='{0}'>\n<h2 id='{0}'>{1}</h2>\n", id_of(i), escape(section.title)));
    writer.add(section.body);
    writer.add("</section>\n");
  }
  writer.add("</main>\n");
  if (!page.footer.empty()) writer.add(fmt::format("<footer>{}</footer>\n", escape(page.footer)));
  writer.add(fmt::format("<script>\n{}</script>\n</body>\n</html>\n", page_js()));
}

std::string to_text(const Page& page) {
  std::string text;
  write_text(page, [&text](std::string_view part) { text += part; });
  return text;
}

}  // namespace penumbra::report
