#include "bench/results.h"
#include "io/report.h"

namespace penumbra::bench {

namespace {

using io::Json;

Json json_of(const Summary& ms) {
  return {{"median_ms", rounded(ms.median)},
          {"min_ms", rounded(ms.min)},
          {"max_ms", rounded(ms.max)},
          {"frames", ms.count}};
}

Json json_of(const PassCost& pass) {
  Json json = {{"name", pass.name}};
  json.update(json_of(pass.ms));
  json["share"] = rounded(pass.share);
  json["shadow"] = pass.shadow;
  return json;
}

Json json_of(const FloorCost& floor) {
  Json json = {{"mask_copy", json_of(floor.copy)}};
  json["fetches"] = floor.fetch ? json_of(*floor.fetch) : Json();
  json["mask_over_fetches"] = floor.mask_ratio ? Json(rounded(*floor.mask_ratio)) : Json();
  return json;
}

Json json_of(const Cost& cost) {
  Json passes = Json::array();
  for (const PassCost& pass : cost.passes) passes.push_back(json_of(pass));
  Json json = {{"label", cost.label},
               {"frame", json_of(cost.frame)},
               {"cpu", json_of(cost.cpu)},
               {"shadow_bytes", cost.shadow_bytes}};
  if (!cost.has_passes()) {
    json["frame_over_first"] = rounded(cost.of_first);
    return json;
  }
  json["passes"] = passes;
  json["passes_sum"] = json_of(cost.passes_sum);
  json["passes_sum_over_frame"] = rounded(cost.sum_ratio);
  json["adds_up"] = cost.adds_up();
  json["shadow_passes"] = json_of(cost.shadow);
  json["swept"] = json_of(cost.swept);
  json["shadow_over_first"] = rounded(cost.of_first);
  if (cost.floor) json["floor"] = json_of(*cost.floor);
  return json;
}

Json json_of(const Measured& measured, const Sweep& sweep) {
  Json json = Json::object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    json[sweep.axes[i].name] = measured.point.at[i];
    if (sweep.axes.size() == 1) json["point"] = measured.point.names[i];
  }
  json["width"] = measured.size.width;
  json["height"] = measured.size.height;
  json["triangles"] = measured.triangles;
  json["costs"] = Json::array();
  for (const Cost& cost : measured.costs) json["costs"].push_back(json_of(cost));
  return json;
}

Json json_of(const Model& model, const Sweep& sweep) {
  Json slopes = Json::object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) slopes[sweep.axes[i].name] = model.fit.slopes[i];
  return {{"label", model.label},
          {"constant_ms", model.fit.constant},
          {"ms_per", slopes},
          {"r_squared", model.fit.r_squared}};
}

}  // namespace

std::string json_of(const Results& results) {
  Json techniques = Json::array(), points = Json::array(), models = Json::array();
  for (const Entry& entry : results.entries) {
    techniques.push_back({{"label", entry.label},
                          {"technique", entry.params.get_word("technique")},
                          {"params", io::to_json(entry.params)}});
  }
  for (const Measured& measured : results.points) points.push_back(json_of(measured, results.sweep));
  for (const Model& model : results.models) models.push_back(json_of(model, results.sweep));
  return io::text_of(
      io::document("bench", 1,
                   {{"version", results.version},
                    {"commit", results.commit},
                    {"command", results.command},
                    {"machine", {{"cpu", results.machine.cpu}, {"cores", results.machine.cores}}},
                    {"threads", results.threads ? Json(*results.threads) : Json()},
                    {"backend", results.backend},
                    {"device", io::to_json(results.device)},
                    {"timing", results.timing},
                    {"maps", maps_of(results)},
                    {"mask_details", has_floor(results.points.front())},
                    {"scene", results.scene},
                    {"measured_frames", results.frames.measured},
                    {"warmup_frames", results.frames.warmup},
                    {"techniques", techniques},
                    {"sweep", results.sweep.name.empty() ? Json() : Json(results.sweep.name)},
                    {"sweep_measures", results.sweep.name.empty() ? Json() : Json(subject_of(results.sweep))},
                    {"points", points},
                    {"models", models}}));
}

}  // namespace penumbra::bench
