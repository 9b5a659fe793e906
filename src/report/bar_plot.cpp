#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "report/number.h"
#include "report/plot.h"
#include "report/plot_frame.h"

namespace penumbra::report {

namespace {

constexpr std::size_t colours = 8;  // .line-0 to .line-7 in page.css
constexpr double width = 760, top = 10, bottom = 58, bar_height = 26, bar_step = 40;
constexpr double most_label = 220, gap = 10;

double sum_of(const Bar& bar) { return std::accumulate(bar.values.begin(), bar.values.end(), 0.0); }

// The parts in falling order of their sums over all bars, and those beyond the colours as one.
BarPlot with_fewer_parts(const BarPlot& plot) {
  const auto sum = [&](std::size_t part) {
    return std::accumulate(plot.bars.begin(), plot.bars.end(), 0.0,
                           [&](double all, const Bar& bar) { return all + bar.values.at(part); });
  };
  std::vector<std::size_t> kept(plot.parts.size());
  std::iota(kept.begin(), kept.end(), std::size_t{0});
  std::vector<std::size_t> others;
  if (kept.size() > colours) {
    std::ranges::stable_sort(kept, std::ranges::greater(), sum);
    others.assign(kept.begin() + colours - 1, kept.end());
    kept.resize(colours - 1);
    std::ranges::sort(kept);  // in the order in which they were given
  }
  BarPlot fewer{.title = plot.title, .x = plot.x, .parts = {}, .bars = {}};
  for (const std::size_t part : kept) fewer.parts.push_back(plot.parts[part]);
  if (!others.empty()) fewer.parts.emplace_back("others");
  for (const Bar& bar : plot.bars) {
    Bar shorter{.label = bar.label, .values = {}};
    for (const std::size_t part : kept) shorter.values.push_back(bar.values[part]);
    if (!others.empty()) {
      shorter.values.push_back(std::accumulate(others.begin(), others.end(), 0.0,
                                               [&](double all, std::size_t part) { return all + bar.values[part]; }));
    }
    fewer.bars.push_back(std::move(shorter));
  }
  return fewer;
}

std::string value_text(const Axis& axis, double value) {
  return significant(value, 4) + (axis.unit.empty() ? "" : " " + axis.unit);
}

std::string bar_svg(const BarPlot& plot, const Bar& bar, const Scale& x, double y) {
  std::string svg = fmt::format("<text class='label' x='{:.1f}' y='{:.1f}' text-anchor='end'>{}</text>", x.at(0) - gap,
                                y + bar_height / 2 + 4.5, label_text(bar.label, most_label));
  double from = 0;
  for (std::size_t i = 0; i < bar.values.size(); ++i) {
    if (bar.values[i] <= 0) continue;
    const double left = x.at(from), right = x.at(from += bar.values[i]);
    svg += fmt::format(
        "<rect class='part line-{}' x='{:.2f}' y='{:.1f}' width='{:.2f}' height='{}'><title>{}: {}, {}</title></rect>",
        i, left, y, right - left, bar_height, escape(bar.label), escape(plot.parts[i]),
        escape(value_text(plot.x, bar.values[i])));
  }
  return svg + fmt::format("<text class='sum' x='{:.1f}' y='{:.1f}'>{}</text>", x.at(from) + gap / 2,
                           y + bar_height / 2 + 4.5, escape(value_text(plot.x, from)));
}

std::string key_of(const BarPlot& plot) {
  std::string html = "<ul class='key'>";
  for (std::size_t i = 0; i < plot.parts.size(); ++i)
    html += fmt::format("<li><span class='line-{}'></span>{}</li>", i, escape(plot.parts[i]));
  return html + "</ul>\n";
}

}  // namespace

Html to_html(const BarPlot& given) {
  const BarPlot plot = with_fewer_parts(given);
  std::vector<double> sums{0};
  double label = 0, sum = 0;
  for (const Bar& bar : plot.bars) {
    sums.push_back(sum_of(bar));
    label = std::max(label, text_width(bar.label));
    sum = std::max(sum, text_width(value_text(plot.x, sums.back())));
  }
  const double left = std::min(label, most_label) + 2 * gap, right = width - sum - 2 * gap;
  const double low = top + bar_step * static_cast<double>(plot.bars.size()), height = low + bottom;
  const Scale x(plot.x, sums, left, right);
  std::string drawn;
  for (const Tick& tick : x.ticks()) {
    drawn += fmt::format(
        "<path class='grid' d='M{0:.1f} {1}V{2:.1f}'/>"
        "<text class='tick' x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4}</text>",
        x.at(tick.value), top, low, low + 20, escape(tick.label));
  }
  for (std::size_t i = 0; i < plot.bars.size(); ++i)
    drawn += bar_svg(plot, plot.bars[i], x, top + bar_step * (static_cast<double>(i) + 0.5) - bar_height / 2);
  const std::string title = plot.x.unit.empty() ? plot.x.label : plot.x.label + " (" + plot.x.unit + ")";
  return Html(
      fmt::format("<div class='plot' tabindex='0'><svg viewBox='0 0 {} {:.0f}' role='img' aria-label='{}'>{}"
                  "<path class='axis' d='M{:.1f} {}V{:.1f}'/>"
                  "<text class='axis-title' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text></svg>{}</div>\n",
                  width, height, escape(plot.title), drawn, x.at(0), top, low, (left + right) / 2, height - 12,
                  escape(title), key_of(plot)));
}

}  // namespace penumbra::report
