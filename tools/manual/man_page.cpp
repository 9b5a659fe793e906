#include "manual/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/commands.h"
#include "cli/command_line.h"
#include "io/text.h"
#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra::manual {

namespace {

// An option that as many commands have, in the same words, is explained once for all of them.
constexpr std::ptrdiff_t commands_in_common = 4;

// Text as roff shows it: backslashes, hyphens that are to be copied as they are, and no request at a line's start.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n'))
      (result += "\\&") += c;
    else
      result += c;
  }
  return result;
}

std::string bold(std::string_view text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + escaped(text) + "\\fR"; }

class Page {
 public:
  void section(std::string_view title) { text_ += fmt::format(".SH {}\n", title); }
  void subsection(std::string_view title) { text_ += fmt::format(".SS \"{}\"\n", escaped(title)); }
  void item(std::string_view tag, std::string_view help) { text_ += fmt::format(".TP\n{}\n{}\n", tag, escaped(help)); }
  void literal(std::string_view lines) { text_ += fmt::format(".PP\n.nf\n{}\n.fi\n", escaped(lines)); }
  void roff(std::string_view lines) { (text_ += lines) += '\n'; }
  // Paragraphs, with empty lines between them; lines that are indented stay as they are.
  void prose(std::string_view text);
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void Page::prose(std::string_view text) {
  bool literal = false;
  for (const std::string& line : io::split(std::string(text), '\n')) {
    const bool indented = line.starts_with("  ");
    if (indented != literal) text_ += indented ? ".PP\n.nf\n" : ".fi\n";
    if (literal && !indented && !line.empty()) text_ += ".PP\n";
    literal = indented;
    text_ += line.empty() ? std::string(".PP\n") : escaped(line) + "\n";
  }
  if (literal) text_ += ".fi\n";
}

std::string tag_of(const Option& option) {
  if (option.positional) return italic(option.names.front());
  std::string tag;
  for (const std::string& name : option.names) tag += (tag.empty() ? "" : ", ") + bold(name);
  return option.type.empty() ? tag : tag + " " + italic(option.type);
}

void add_option(Page& page, const Option& option) { page.item(tag_of(option), option.help); }

bool has(const CommandLine& line, const Option& option) {
  return std::ranges::find(line.options, option) != line.options.end();
}

// Options of most commands, in the order in which they appear.
std::vector<Option> options_in_common(std::span<const CommandLine> commands) {
  std::vector<Option> common;
  for (const CommandLine& line : commands) {
    for (const Option& option : line.options) {
      if (option.positional || std::ranges::find(common, option) != common.end()) continue;
      const auto count = std::ranges::count_if(commands, [&](const CommandLine& other) { return has(other, option); });
      if (count >= commands_in_common) common.push_back(option);
    }
  }
  return common;
}

// "penumbra render SCENE -o FILE [OPTIONS]"
std::string usage_of(const CommandLine& line) {
  std::string usage = "penumbra " + line.name;
  bool optional = false;
  for (const Option& option : line.options) {
    const std::string word = option.positional ? option.names.front() : option.names.front() + " " + option.type;
    if (option.required)
      usage += " " + word + (option.repeatable ? "..." : "");
    else if (option.positional)
      usage += " [" + word + "]";
    else
      optional = true;
  }
  return optional ? usage + " [OPTIONS]" : usage;
}

// What `penumbra plan render` has besides the options of `penumbra render`.
const CommandLine* planned_by(const CommandLine& line, std::span<const CommandLine> commands) {
  constexpr std::string_view plan = "plan ";
  if (!line.name.starts_with(plan)) return nullptr;
  const std::string name = line.name.substr(plan.size());
  const auto found = std::ranges::find(commands, name, &CommandLine::name);
  return found == commands.end() ? nullptr : &*found;
}

void add_command(Page& page, const CommandLine& line, std::span<const CommandLine> commands,
                 const std::vector<Option>& common) {
  if (line.options.empty()) {  // its parts follow
    page.subsection("penumbra " + line.name);
    page.prose(line.help);
    return;
  }
  page.subsection(usage_of(line));
  page.prose(line.help);
  const CommandLine* planned = planned_by(line, commands);
  std::string shared;
  for (const Option& option : line.options) {
    if (planned != nullptr && has(*planned, option)) continue;
    if (std::ranges::find(common, option) == common.end()) {
      add_option(page, option);
    } else {
      shared += (shared.empty() ? "" : ", ") + bold(option.names.back());
    }
  }
  if (planned != nullptr)
    page.roff(".PP\nThe other options are those of " + bold("penumbra " + planned->name) + ".");
  else if (!shared.empty())
    page.roff(".PP\nCommon options: " + shared + ".");
}

void add_names(Page& page) {
  const shadow::Registry& registry = session::all_techniques();
  page.section("TECHNIQUES");
  for (const shadow::Technique& technique : registry.techniques()) page.item(bold(technique.name), technique.summary);
  for (const shadow::Preset& preset : registry.presets()) page.item(bold(preset.name), preset.summary);
  page.section("FILTERS");
  for (const shadow::Filter& filter : registry.filters()) page.item(bold(filter.name), filter.summary);
  page.section("DENOISERS");
  for (const shadow::Denoiser& denoiser : registry.denoisers()) page.item(bold(denoiser.name), denoiser.summary);
  page.item(bold(shadow::no_denoiser().name), shadow::no_denoiser().summary);
  page.section("PICTURES OF A FRAME");
  for (const render::Aov& aov : render::aovs()) page.item(bold(aov.name), aov.help);
  page.section("PARAMETERS");
  for (const Param& param : render::Renderer::params(registry)) {
    std::string range = param.choices.empty() ? type_name(param) : fmt::format("{}", fmt::join(param.choices, ", "));
    if (param.choices.empty() && !std::holds_alternative<bool>(param.default_value))
      range += fmt::format(", {:g} to {:g}", param.min, param.max);
    const std::string unit = param.unit.empty() ? "" : " " + param.unit;
    page.item(fmt::format("{}={}{} ({})", bold(param.name), escaped(to_text(param.default_value)), escaped(unit),
                          escaped(range)),
              param.help);
  }
}

}  // namespace

std::string man_page(std::span<const CommandLine> commands) {
  Page page;
  page.roff(fmt::format(".TH PENUMBRA 1 \"\" \"{}\" \"User Commands\"\n.ad l\n.nh", cli::version()));
  page.section("NAME");
  page.roff("penumbra \\- render soft shadows, and measure them against ray\\-traced truth");
  page.section("SYNOPSIS");
  page.roff(".B penumbra\n" + italic("COMMAND") + " [" + italic("OPTIONS") + "]");
  page.section("DESCRIPTION");
  page.prose(
      "Penumbra draws the soft shadows of glTF scenes with OpenGL, in a window or without a display, and compares "
      "techniques with each other and with the truth.");
  page.roff(bold("penumbra COMMAND --help") + " lists a command's options, " + bold("penumbra list") +
            " what there is to choose from, and " + bold("penumbra help") + " " + italic("NAME") +
            " explains one name.");
  page.section("COMMANDS");
  const std::vector<Option> common = options_in_common(commands);
  for (const CommandLine& line : commands) add_command(page, line, commands, common);
  page.section("COMMON OPTIONS");
  for (const Option& option : common) add_option(page, option);
  add_names(page);
  page.section("EXIT STATUS");
  page.item("0", "Done.");
  page.item("1", "Any failure that is not one of usage, or a limit of diff that is exceeded.");
  page.item("2", "Wrong usage.");
  page.section("EXAMPLES");
  page.literal(
      "penumbra render scene.glb -o picture.png --sun-angle 2\n"
      "penumbra truth scene.glb -o truth.exr --spp 256\n"
      "penumbra compare scene.glb -o report --technique pcss,slices_denoised");
  return page.take();
}

}  // namespace penumbra::manual
