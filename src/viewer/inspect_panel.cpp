#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "cli/text.h"
#include "viewer/fields.h"
#include "viewer/panels.h"
#include "viewer/targets.h"

namespace penumbra::viewer {

namespace {

void choose(const Panel& panel, const std::string& what, const std::string& label, const std::string& help) {
  Inspection& inspection = panel.state.inspection;
  ImGui::PushID(what.c_str());  // a texture and an AOV may have the same name
  const std::string shown = shortened(label, ImGui::GetContentRegionAvail().x);
  if (ImGui::Selectable(shown.c_str(), inspection.what == what))
    inspection = Inspection{.what = what, .over = inspection.over};
  ImGui::PopID();
  panel.widgets.mark("show=" + (what.empty() ? "picture" : what));
  if (!help.empty()) tooltip(shown == label ? help : label + "\n" + help);
}

void list(const Panel& panel) {
  const float height = std::max(ImGui::GetContentRegionAvail().y * 0.42f, 5 * ImGui::GetTextLineHeightWithSpacing());
  ImGui::BeginChild("list", {0, height}, /* border= */ true);
  choose(panel, "", "picture", "The lit picture.");
  for (const render::Aov& aov : render::aovs()) choose(panel, aov.name, aov.name, aov.help);
  ImGui::Separator();
  ImGui::TextDisabled("textures that passes draw to");
  for (const gl::Device::NamedTarget& target : panel.status.gl.targets()) {
    if (target.name.starts_with("viewer/") || is_of_other_view(target.name)) continue;
    const gl::TextureDesc& desc = target.texture->desc();
    const std::string about = about_target(target.name);
    const std::string layers = desc.layers > 1 ? fmt::format(", {} layers", desc.layers) : "";
    const std::string levels = desc.levels > 1 ? fmt::format(", {} levels", desc.levels) : "";
    choose(panel, "target " + std::string(target.name), target_label(target.name, panel.status.scene),
           fmt::format("{}{}{} × {}{}{}, {}", about, about.empty() ? "" : "\n", desc.width, desc.height, layers, levels,
                       cli::bytes_text(static_cast<double>(target.texture->bytes()))));
  }
  ImGui::EndChild();
  panel.widgets.mark("shown list");
}

// Which part, layer and level of the texture to show.
void choose_part(const Panel& panel) {
  Inspection& inspection = panel.state.inspection;
  const std::optional<gl::Device::NamedTarget> target = inspected_target(inspection, panel.status.gl);
  if (!target) return;
  const std::vector<TargetPart> parts = parts_of(*target);
  if (parts.size() > 1) {
    row("part", "Which value of a packed texel, or which channel.");
    const std::size_t current = part_index(parts, inspection);
    const bool open = begin_combo("##part", parts[current].name);
    panel.widgets.mark("part");
    if (open) {
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (ImGui::Selectable(parts[i].name.c_str(), i == current)) inspection.part = static_cast<int>(i);
        panel.widgets.mark("part=" + parts[i].name);
      }
      ImGui::EndCombo();
    }
  }
  const gl::TextureDesc& desc = target->texture->desc();
  if (desc.layers > 1) {
    row("layer", "Of the texture array.");
    slider(panel.widgets, "layer", inspection.layer, 0, desc.layers - 1);
  }
  if (desc.levels > 1) {
    row("level", "Mip level; 0 is the finest.");
    slider(panel.widgets, "level", inspection.level, 0, desc.levels - 1);
  }
}

void range(const Panel& panel) {
  Inspection& inspection = panel.state.inspection;
  if (ImGui::Button("Fit to the view")) panel.state.zoom = {};
  panel.widgets.mark("fit");
  tooltip("Shows all of the texture (0). Ctrl + wheel magnifies it.");
  begin_rows("range");
  row("over the picture", "Tints the lit picture with the colours, instead of showing them alone (T for cascades).");
  ImGui::Checkbox("##over", &inspection.over);
  panel.widgets.mark("over");
  choose_part(panel);
  if (panel.status.mapping.scale == ColorScale::labels) {
    end_rows();
    return;
  }
  row("automatic range", "The colours span the range of the values.");
  if (ImGui::Checkbox("##automatic", &inspection.automatic)) {
    inspection.low = panel.status.values.low;
    inspection.high = panel.status.values.high;
  }
  panel.widgets.mark("automatic range");
  if (!inspection.automatic) {
    const float span = std::max(panel.status.values.high - panel.status.values.low, 1e-4f);
    row("from", "The value with the first colour.");
    drag(panel.widgets, "range low", inspection.low, span * 0.005f, "%.4g");
    row("to", "The value with the last colour.");
    drag(panel.widgets, "range high", inspection.high, span * 0.005f, "%.4g");
  }
  end_rows();
}

void probe(const Panel& panel) {
  ImGui::Checkbox("Values under the cursor", &panel.state.probe);
  panel.widgets.mark("probe");
  if (!panel.state.probe) return;
  if (panel.status.texture_alone) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("The picture is not shown. The legend has the texture's value.");
    ImGui::PopStyleColor();
    panel.widgets.mark("values of a texture");
    return;
  }
  bool locked = panel.state.locked_pixel.has_value();
  same_line_for("locked", /* has_box= */ true);
  if (ImGui::Checkbox("locked", &locked)) toggle_lock(panel);
  panel.widgets.mark("lock");
  tooltip("Keeps the pixel, which a cross marks, while the mouse moves (L). Its values follow the picture.");
  if (!panel.status.probed) {
    ImGui::TextDisabled("Point at the picture.");
    panel.widgets.mark("point at the picture");
    return;
  }
  ImGui::Text("pixel %d, %d%s", panel.status.probed->x, panel.status.probed->y,
              panel.state.comparison.on ? " of A" : "");
  ImGui::BeginTable("probe", 2, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg);
  ImGui::PushTextWrapPos(0);
  for (const ProbeRow& each : panel.status.probe) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", each.name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(each.value.c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTable();
  panel.widgets.mark("probe values");
}

}  // namespace

void toggle_lock(const Panel& panel) {
  std::optional<glm::ivec2>& locked = panel.state.locked_pixel;
  if (locked) {
    locked.reset();
  } else if (panel.state.probe) {
    locked = panel.status.last_probed;
  }
}

void inspect_panel(const Panel& panel) {
  list(panel);
  if (!panel.state.inspection.what.empty()) range(panel);
  ImGui::Separator();
  if (ImGui::BeginChild("values", {0, rest_of_panel()})) probe(panel);
  ImGui::EndChild();
}

}  // namespace penumbra::viewer
