#include <fmt/format.h>

#include "bench/results.h"
#include "io/text.h"

namespace penumbra::bench {

namespace {

std::string line_of(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& text : fields) {
    if (!line.empty()) line += ',';
    line += io::csv_field(text);
  }
  return line + "\r\n";
}

std::string number(double value) { return fmt::format("{:.4f}", rounded(value)); }

// Values that are not the defaults, "pcss.blocker_taps=8;pcss.filter_taps=8".
std::string changes_of(const ParamSet& params) {
  std::string changes;
  for (const Param& row : params.rows()) {
    if (row.name == "technique" || params.is_default(row.name)) continue;
    changes += fmt::format("{}{}={}", changes.empty() ? "" : ";", row.name, to_text(params.value(row.name)));
  }
  return changes;
}

class Writer {
 public:
  explicit Writer(const Results& results) : results_(results) {
    std::vector<std::string> head{"technique", "label"};
    for (const Axis& axis : results.sweep.axes) head.push_back(axis.name);
    for (const char* name :
         {"pass",   "median_ms",    "min_ms", "max_ms", "frames",   "share",   "over_first", "width",
          "height", "triangles",    "scene",  "params", "renderer", "driver",  "backend",    "timing",
          "maps",   "mask_details", "cpu",    "cores",  "threads",  "version", "commit"})
      head.emplace_back(name);
    text_ = line_of(head);
  }

  void add(const Measured& point, const Cost& cost, const Entry& entry) {
    for (const PassCost& pass : cost.passes) row(point, entry, pass.name, pass.ms, number(pass.share), "");
    const double frame = cost.frame.median;
    const auto share = [frame](const Summary& of) { return frame > 0 ? number(of.median / frame) : ""; };
    if (cost.has_passes()) {
      row(point, entry, "sum of passes", cost.passes_sum, number(cost.sum_ratio), "");
      row(point, entry, "shadow passes", cost.shadow, share(cost.shadow), number(cost.of_first));
    }
    row(point, entry, "frame", cost.frame, share(cost.frame), cost.has_passes() ? "" : number(cost.of_first));
    row(point, entry, "CPU", cost.cpu, share(cost.cpu), "");
    if (!cost.floor) return;
    if (cost.floor->fetch) row(point, entry, "floor: fetches", *cost.floor->fetch, share(*cost.floor->fetch), "");
    row(point, entry, "floor: mask copy", cost.floor->copy, share(cost.floor->copy), "");
  }

  const std::string& text() const { return text_; }

 private:
  void row(const Measured& point, const Entry& entry, const std::string& pass, const Summary& ms,
           const std::string& share, const std::string& over_first) {
    std::vector<std::string> fields{entry.params.get_word("technique"), entry.label};
    for (const double at : point.point.at) fields.push_back(fmt::format("{}", at));
    const ParamSet params = params_at(point.point, entry.params);
    for (std::string text : {pass,
                             number(ms.median),
                             number(ms.min),
                             number(ms.max),
                             std::to_string(ms.count),
                             share,
                             over_first,
                             std::to_string(point.size.width),
                             std::to_string(point.size.height),
                             std::to_string(point.triangles),
                             results_.scene,
                             changes_of(params),
                             results_.device.renderer,
                             results_.device.version,
                             results_.backend,
                             results_.timing,
                             maps_of(entry.params),
                             std::string(has_floor(point) ? "true" : "false"),
                             results_.machine.cpu,
                             std::to_string(results_.machine.cores),
                             results_.threads ? std::to_string(*results_.threads) : std::string(),
                             results_.version,
                             results_.commit})
      fields.push_back(std::move(text));
    text_ += line_of(fields);
  }

  const Results& results_;
  std::string text_;
};

}  // namespace

std::string csv_of(const Results& results) {
  Writer writer(results);
  for (const Measured& point : results.points) {
    for (std::size_t i = 0; i < point.costs.size(); ++i) writer.add(point, point.costs[i], results.entries[i]);
  }
  return writer.text();
}

}  // namespace penumbra::bench
