#include "report/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra::report {

namespace {

// A picture's frame: it reserves the picture's shape while that loads, receives arrow keys, and clips what zooming
// moves outside.
std::string open_pane(const EncodedPicture& picture, std::string_view kind, std::string_view label) {
  return fmt::format(
      "<div class='pane{}' style='aspect-ratio:{}/{}'>"
      "<div class='view' tabindex='0' role='group' aria-label='{}'>",
      kind, picture.width, picture.height, escape(label));
}

Html image(const Figure& figure) {
  Html html(fmt::format("<img alt='{}' width='{}' height='{}' decoding='async' draggable='false'", escape(figure.alt),
                        figure.picture.width, figure.picture.height));
  return html.source(figure.picture).add(">");
}

std::string label(std::string_view side, const std::string& text) {
  return text.empty() ? "" : fmt::format("<span class='label {}'>{}</span>", side, escape(text));
}

}  // namespace

Html picture_slider(const Figure& left, const Figure& right) {
  assert(left.picture.width == right.picture.width && left.picture.height == right.picture.height);
  const std::string both = left.label + " against " + right.label;
  Html html(open_pane(left.picture, " slider", both));
  html.add(image(left)).add("<div class='over'>").add(image(right)).add("</div></div>");
  html.add(label("left", left.label) + label("right", right.label));
  return html.add(fmt::format(
      "<input type='range' min='0' max='100' step='0.5' value='50' aria-label='Divider: {}'></div>\n", escape(both)));
}

Html picture(const Figure& figure) {
  Html html(open_pane(figure.picture, "", figure.label.empty() ? figure.alt : figure.label));
  return html.add(image(figure)).add("</div>" + label("left", figure.label) + "</div>\n");
}

namespace {

// A legend whose labels contain "{}" where the script writes the range.
Html legend_of(const Legend& legend, const std::string& range) {
  std::string colours, labels;
  for (const std::string& colour : legend.colours) colours += fmt::format(",{}", escape(colour));
  for (const std::string& text : legend.labels) {
    const std::size_t place = text.find("{}");
    std::string shown = text;
    if (place != text.npos) shown.replace(place, 2, range);
    const std::string pattern = place == text.npos ? "" : fmt::format(" data-label='{}'", escape(text));
    labels += fmt::format("<span{}>{}</span>", pattern, escape(shown));
  }
  return Html(
      fmt::format("<div class='legend'><span class='legend-title'>{}</span>"
                  "<div class='bar' style='background:linear-gradient(90deg{})'></div>"
                  "<div class='ends'>{}</div></div>\n",
                  escape(legend.title), colours, labels));
}

}  // namespace

std::uint8_t error_code(float error) {
  if (std::isnan(error)) return 0;
  const float root = std::copysign(std::sqrt(std::min(std::abs(error), 1.0f)), error);
  return static_cast<std::uint8_t>(128 + std::lround(root * 127));
}

Html error_map(const ErrorMap& map) {
  std::string colours;
  for (const std::string& colour : map.legend.colours) colours += (colours.empty() ? "" : " ") + colour;
  const std::string range = fmt::format("{:g}", map.range);
  return Html(fmt::format(
                  "<div class='error-map' data-range='{}' data-colours='{}' data-unmeasured='{}' data-codes='{}'>",
                  range, escape(colours), escape(map.unmeasured), data_uri(map.codes)))
      .add(picture(map.figure))
      .add(legend_of(map.legend, range))
      .add("</div>\n");
}

Html tiles(const std::vector<Tile>& tiles) {
  Html html("<div class='tiles'>\n");
  for (const Tile& tile : tiles) {
    html.add("<article class='tile'><h4>").text(tile.title).add("</h4>\n").add(tile.body);
    if (!tile.note.empty()) html.add("<p class='note'>").text(tile.note).add("</p>");
    html.add("</article>\n");
  }
  return html.add("</div>\n");
}

}  // namespace penumbra::report
