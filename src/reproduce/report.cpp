#include "reproduce/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "bench/machine.h"
#include "cli/text.h"
#include "io/text.h"
#include "report/text_blocks.h"

namespace penumbra::reproduce {

namespace {

using penumbra::report::Html;

constexpr std::string_view quick_warning =
    "A quick run: small pictures, few frames and rays. Its figures are a preview, not a measurement.";

constexpr int findings_before = 1;  // sections before the first figure's

std::string scene_name(const Workbench& bench) {
  return std::filesystem::path(bench.options().scene).filename().string();
}

const char* kind_of(const Finding& finding) { return finding.kind == Finding::Kind::section ? "section" : "figure"; }

std::string heading(const Finding& finding) {
  return fmt::format("{} {}: {}", finding.kind == Finding::Kind::section ? "Section" : "Figure", finding.id,
                     finding.title);
}

Html badge(const Finding& finding) {
  const std::string verdict = finding.verdict();
  const char* style = verdict == "confirmed"           ? "background:var(--best);color:var(--best-ink)"
                      : verdict == "confirmed in part" ? "border:1px solid var(--line-6);color:var(--line-6)"
                      : verdict == "not measured"      ? "border:1px solid var(--line);color:var(--quiet)"
                                                       : "border:1px solid var(--line-4);color:var(--line-4)";
  Html html(
      fmt::format("<span style='display:inline-block;border-radius:4px;padding:0 8px;font-size:13px;"
                  "font-weight:650;white-space:nowrap;{}'>",
                  style));
  return html.text(verdict).add("</span>");
}

Html verdict_of(const Finding& finding) {
  Html html("<p class='verdict' style='margin:14px 0 18px'>");
  return html.add(badge(finding)).add(" ").text(finding.sentence()).add("</p>\n");
}

Html stated(const char* who, const std::string& what) {
  Html html("<p style='margin-bottom:6px'><strong>");
  return html.text(who).add("</strong> ").text(what).add("</p>\n");
}

Html figures_of(const Finding& finding) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Quantity& quantity : finding.quantities()) entries.emplace_back(quantity.name, quantity.text());
  return penumbra::report::details("All figures", penumbra::report::definition_list(entries));
}

penumbra::report::Section section_of(const Finding& finding) {
  Html body = stated("The thesis:", finding.claim);
  body.add(stated("Measured:", finding.test));
  body.add(verdict_of(finding)).add(finding.body).add(figures_of(finding));
  return {.title = heading(finding), .body = std::move(body)};
}

// From the first `open` to the next `close`, both included; empty if there is none.
std::string_view piece(std::string_view markup, std::string_view open, std::string_view close) {
  const std::size_t begin = markup.find(open);
  if (begin == std::string_view::npos) return {};
  const std::size_t end = markup.find(close, begin);
  return end == std::string_view::npos ? std::string_view() : markup.substr(begin, end + close.size() - begin);
}

// The first picture, drawing or table of a finding, small. Its section describes it, so readers who can't see it are
// told nothing here.
Html thumbnail(const Finding& finding) {
  std::string markup;
  for (const Html::Part& part : finding.body.parts()) {
    if (part.picture.png != nullptr) {
      Html html(fmt::format("<div class='thumbnail' aria-hidden='true'><img alt='' width='{}' height='{}'",
                            part.picture.width, part.picture.height));
      return html.source(part.picture).add("></div>");
    }
    markup += part.markup;
  }
  std::string_view shown = piece(markup, "<svg", "</svg>");
  if (shown.empty()) shown = piece(markup, "<table", "</table>");
  return Html(fmt::format("<div class='plot thumbnail' aria-hidden='true'>{}</div>", shown));
}

penumbra::report::Section overview(std::span<const Finding> findings) {
  const auto count = [&](const std::string& verdict) {
    return std::ranges::count(findings, verdict, &Finding::verdict);
  };
  const auto unmeasured = count("not measured");
  Html html = penumbra::report::paragraph(
      fmt::format("Of {} figures and sections {} are confirmed, {} in part and {} not{}.", findings.size(),
                  count("confirmed"), count("confirmed in part"), count("not confirmed"),
                  unmeasured == 0 ? "" : fmt::format("; {} could not be measured", unmeasured)));
  html.add("<ul class='overview'>\n");
  for (std::size_t i = 0; i < findings.size(); ++i) {
    html.add("<li>").add(thumbnail(findings[i]));
    html.add(fmt::format("<a href='#section-{}'>", i + 1 + findings_before)).text(heading(findings[i])).add("</a>");
    html.add(badge(findings[i])).add("<p>").text(findings[i].sentence()).add("</p></li>\n");
  }
  return {.title = "What was found", .body = std::move(html.add("</ul>\n"))};
}

}  // namespace

penumbra::report::Page page_of(std::span<const Finding> findings, const Workbench& bench,
                               const cli::Arguments& arguments) {
  const bench::Machine machine = bench::machine();
  const Options& options = bench.options();
  penumbra::report::Page page{
      .title = "The thesis's figures, measured",
      .summary =
          std::string(
              "Figures 2.8 to 2.14 and 4.1 to 4.13 of Deligiannis, “Real-Time Rendering of Soft Shadows” "
              "(LiU-ITN-TEK-A--19/060--SE), and what its sections 2.2 and 2.3 say of other techniques and 2.5 of "
              "histories, in our version and with figures. Verdicts follow from what this run measured. The thesis's "
              "reference scene has a single caster, and its section 2.3 is about rectangular lights; "
              "scenes/thesis.glb has casters near the receivers too, and the sun here is a disc. Section 2.5 is "
              "measured in scenes/moving.glb.") +
          (options.quick ? fmt::format(" {}", quick_warning) : ""),
      .facts = {{"Scene", scene_name(bench)},
                {"Size", fmt::format("{} × {}{}", bench.width(), bench.height(), options.quick ? ", quick" : "")},
                {"Sun", fmt::format("{:g}° disc", bench.sun_angle())},
                {"Converged PCSS", "256 × 256 taps"},
                {"Truth", fmt::format("ray traced, {} rays a pixel", options.truth_samples())},
                {"Device", bench.device().renderer},
                {"Processor", fmt::format("{}, {} cores", machine.cpu, machine.cores)},
                {"Commit", bench::commit()}},
      .sections = {overview(findings)},
      .footer = fmt::format("{}. Costs are valid for this machine and run only: compare them only with each other.",
                            cli::version())};
  for (const Finding& finding : findings) page.sections.push_back(section_of(finding));
  page.sections.push_back(
      {.title = "Command", .body = penumbra::report::code_block(cli::command_text("penumbra reproduce", arguments))});
  return page;
}

io::Json json_of(std::span<const Finding> findings, const Workbench& bench) {
  io::Json figures = io::Json::array();
  for (const Finding& finding : findings) {
    io::Json quantities = io::Json::array();
    for (const Quantity& quantity : finding.quantities()) {
      quantities.push_back({{"name", quantity.name},
                            {"value", io::json_number(quantity.value)},
                            {"unit", quantity.unit},
                            {"text", quantity.text()}});
    }
    figures.push_back({{"id", finding.id},
                       {"kind", kind_of(finding)},
                       {"title", finding.title},
                       {"claim", finding.claim},
                       {"test", finding.test},
                       {"verdict", finding.verdict()},
                       {"sentence", finding.sentence()},
                       {"quantities", quantities}});
  }
  const bench::Machine machine = bench::machine();
  return io::document("reproduce", 1,
                      {{"version", cli::version()},
                       {"commit", bench::commit()},
                       {"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}}},
                       {"device", io::to_json(bench.device())},
                       {"scene", scene_name(bench)},
                       {"width", bench.width()},
                       {"height", bench.height()},
                       {"quick", bench.options().quick},
                       {"sun_angle", bench.sun_angle()},
                       {"truth_samples", bench.options().truth_samples()},
                       {"figures", figures}});
}

std::string csv_of(std::span<const Finding> findings) {
  std::string text = "figure,name,value,unit\n";
  for (const Finding& finding : findings) {
    for (const Quantity& quantity : finding.quantities()) {
      const std::string value = std::isnan(quantity.value) ? "" : fmt::format("{}", quantity.value);
      text += fmt::format("{} {},{},{},{}\n", kind_of(finding), finding.id, io::csv_field(quantity.name), value,
                          quantity.unit);
    }
  }
  return text;
}

std::string text_of(std::span<const Finding> findings, const Options& options) {
  std::string text;
  for (const Finding& finding : findings)
    text += fmt::format("{:<6} {:<18} {}\n", finding.id, finding.verdict(), finding.title);
  if (options.quick) text += fmt::format("{}\n", quick_warning);
  return text;
}

}  // namespace penumbra::reproduce
