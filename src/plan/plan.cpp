#include "plan/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/read_file.h"
#include "io/output_file.h"
#include "plan/json_reader.h"

namespace penumbra::plan {

namespace {

using io::Json;

constexpr const char* format = "penumbra.plan/1";

// The arguments, with null in the place of -o's value.
Json json_of_arguments(const Plan& plan) {
  Json list = Json::array();
  for (std::size_t i = 0; i < plan.arguments.size(); ++i)
    list.push_back(i == plan.output ? Json() : Json(plan.arguments[i]));
  return list;
}

Json json_of(const PlannedScene& scene) {
  Json files = Json::array();
  for (const PlannedFile& file : scene.files) {
    Json one{{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash.text()}};
    if (!file.shader.empty()) one["shader"] = file.shader;
    files.push_back(std::move(one));
  }
  Json json{{"path", scene.path.empty() ? Json() : Json(scene.path)}};
  json.update(scene.view);
  json["files"] = std::move(files);
  return json;
}

Json json_of(const PlannedItem& item, const Json& what) {
  Json json{{"key", item.key.text()}, {"scene", item.scene}};
  json.update(what);
  json["seconds"] = item.estimate.seconds;
  json["memory_mib"] = item.estimate.memory_mib;
  return json;
}

io::Key key_in(const Json& json, const char* name) {
  const std::optional<io::Key> key = io::key_from(text_in(json, name));
  if (!key) fail("\"{}\" is no key of 32 hexadecimal digits", name);
  return *key;
}

void read_arguments(Plan& plan, const Json& json) {
  const Json& list = array_in(json, "arguments");
  std::size_t outputs = 0;
  for (const Json& argument : list) {
    if (argument.is_null()) {
      plan.output = plan.arguments.size();
      ++outputs;
      plan.arguments.emplace_back();
    } else {
      plan.arguments.push_back(text_of_value(argument, "arguments"));
    }
  }
  if (outputs != 1) fail("\"arguments\" has not one null for the value of -o");
}

PlannedScene scene_of(const Json& json) {
  PlannedScene scene;
  if (!member_of(json, "path").is_null()) scene.path = text_in(json, "path");
  for (const Json& file : array_in(json, "files")) {
    scene.files.push_back({.path = text_in(file, "path"),
                           .bytes = whole_in(file, "bytes", SIZE_MAX),
                           .hash = key_in(file, "hash"),
                           .shader = file.contains("shader") ? text_in(file, "shader") : ""});
  }
  return scene;
}

PlannedItem item_of(const Json& json) {
  return {.key = key_in(json, "key"),
          .scene = whole_in(json, "scene", most_items),
          .estimate = {.seconds = number_in(json, "seconds"), .memory_mib = number_in(json, "memory_mib")}};
}

// Items are taken out of the document while it is parsed, since there may be very many. `within`: of which array's
// elements, in the outermost object, the parser has come to.
class ItemTaker {
 public:
  explicit ItemTaker(std::vector<PlannedItem>& items) : items_(items) {}

  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    constexpr int member = 1, element = 2;
    if (event == Json::parse_event_t::key && depth == member) key_ = parsed.get<std::string>();
    if (event == Json::parse_event_t::value && depth == member && key_ == "format") format_ = parsed;
    in_items_ = key_ == "items";
    if (!in_items_ || depth != element || event != Json::parse_event_t::object_end) return true;
    if (items_.size() == most_items) fail("it has more than {} items", most_items);
    if (items_.empty() && format_) check_format(Json{{"format", *format_}}, format);
    try {
      items_.push_back(item_of(parsed));
    } catch (const Error& error) {
      fail("item {}: {}", items_.size(), error.what());
    }
    return false;
  }

 private:
  std::vector<PlannedItem>& items_;
  std::string key_;             // of the outermost object
  std::optional<Json> format_;  // its "format", if that comes before the items
  bool in_items_ = false;
};

void check_program(const Json& json, const Program& program) {
  const std::string version = text_in(json, "version"), commit = text_in(json, "commit");
  if (version != program.version || commit != program.commit)
    fail("{}, commit {}, made it; this is {}, commit {}: plan again", version, commit, program.version, program.commit);
  if (key_in(json, "build") != program.build)
    fail("another build of {}, commit {}, made it: plan again", version, commit);
}

Plan parsed_plan(std::span<const std::byte> bytes, const Program& program) {
  Plan plan{.program = program};
  const Json json = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, ItemTaker(plan.items));
  check_format(json, format);
  check_program(json, program);
  plan.command = text_in(json, "command");
  read_arguments(plan, json);
  for (const Json& scene : array_in(json, "scenes")) plan.scenes.push_back(scene_of(scene));
  if (!array_in(json, "items").empty()) fail("\"items\" has something that is no item");
  if (plan.items.empty()) fail("it has no items");
  for (const PlannedItem& item : plan.items) {
    if (item.scene >= plan.scenes.size()) fail("an item is of scene {}, which it does not have", item.scene);
  }
  return plan;
}

}  // namespace

cli::Arguments Plan::arguments_with(const std::string& output_value) const {
  cli::Arguments all = arguments;
  all[output] = output_value;
  return all;
}

Estimate Plan::largest() const {
  Estimate most;
  for (const PlannedItem& item : items) {
    most.seconds = std::max(most.seconds, item.estimate.seconds);
    most.memory_mib = std::max(most.memory_mib, item.estimate.memory_mib);
  }
  return most;
}

double Plan::total_seconds() const {
  double sum = 0;
  for (const PlannedItem& item : items) sum += item.estimate.seconds;
  return sum;
}

Plan read_plan(const std::filesystem::path& path, const Program& program) {
  try {
    return parsed_plan(read_file(path, largest_plan), program);
  } catch (const Error& error) {
    fail("cannot use the plan {}: {}", io::quoted(path), error.what());
  }
}

std::string text_of(const Plan& plan, const std::vector<Json>& what) {
  const Estimate most = plan.largest();
  Json scenes = Json::array();
  for (const PlannedScene& scene : plan.scenes) scenes.push_back(json_of(scene));
  const Json head = {{"format", format},
                     {"version", plan.program.version},
                     {"commit", plan.program.commit},
                     {"build", plan.program.build.text()},
                     {"command", plan.command},
                     {"arguments", json_of_arguments(plan)},
                     {"estimate",
                      {{"items", plan.items.size()},
                       {"seconds", std::llround(std::ceil(most.seconds))},
                       {"memory_mib", std::llround(std::ceil(most.memory_mib))},
                       {"total_seconds", std::llround(std::ceil(plan.total_seconds()))}}},
                     {"scenes", scenes}};
  std::string text = io::text_of(head);
  text.resize(text.rfind('\n', text.size() - 2));  // without the closing brace
  text += ",\n  \"items\": [";
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    text += i == 0 ? "\n    " : ",\n    ";
    text += json_of(plan.items[i], what[i]).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + "\n  ]\n}\n";
}

std::filesystem::path results_folder(const std::filesystem::path& plan) {
  return std::filesystem::path(plan).replace_extension(".results");
}

}  // namespace penumbra::plan
