#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace penumbra {

// A parameter's value: a switch, an integer, a real number or one of a list of words.
using ParamValue = std::variant<bool, int, float, std::string>;

// How a value reaches GLSL. Either way the shader reads an identifier of the parameter's name with '.'
// replaced by '_': a std140 uniform block member, or a preprocessor constant compiled in (loops unroll, branches fold).
// Switches are int 0 or 1, words the int index into `choices`; `host` values do not reach GLSL at all.
enum class ParamBinding { uniform, compiled, host };

// One parameter, declared once. GLSL constant, preset key, --set, viewer widget, `penumbra help` and the
// table in docs/techniques.md all come from this row.
struct Param {
  std::string name;  // "pcss.filter_taps": lower case, [a-z0-9_.]
  ParamValue default_value;
  double min = 0.0;  // range, inclusive; ignored for bool and words
  double max = 1.0;
  std::string unit;  // "m", "deg", "px", "taps"; empty for none
  std::string help;  // one sentence
  ParamBinding binding = ParamBinding::uniform;
  std::vector<std::string> choices;  // the allowed words when default_value is a string
  // Names that it had in earlier versions: the error for using one of them gives the present name.
  std::vector<std::string> former_names = {};
};

// "bool", "int", "float" or "a|b|c".
std::string type_name(const Param& param);
// The value as --set takes it, with the fewest digits that read back the same.
std::string to_text(const ParamValue& value);
// Parses and range-checks; throws Error that names the parameter, the text and what is allowed.
ParamValue parse_value(const Param& param, std::string_view text);
// Checks type and range of a typed value (a preset's); ints convert to float. Throws Error as parse_value.
ParamValue checked_value(const Param& param, const ParamValue& value);

// Values that between them reach every branch that a compiled parameter can open: both switches, every word, both
// values of an integer that has two, and another number's default.
std::vector<ParamValue> representative_values(const Param& param);

// The declared rows and their present values. Copyable: a preset is a copy with changes; copies share the rows.
class ParamSet {
 public:
  ParamSet() = default;
  // Throws std::logic_error on a duplicate or ill-formed row: that is a bug.
  explicit ParamSet(std::vector<Param> rows);

  std::span<const Param> rows() const;
  std::vector<std::string> names() const;
  bool contains(std::string_view name) const;
  // The row that had this name in an earlier version; null: none had.
  const Param* renamed_from(std::string_view former_name) const;
  // All of these throw Error for an unknown name: with the present name for a former one, else with near names.
  const Param& row(std::string_view name) const;
  const ParamValue& value(std::string_view name) const;

  bool get_bool(std::string_view name) const;
  int get_int(std::string_view name) const;
  float get_float(std::string_view name) const;
  const std::string& get_word(std::string_view name) const;

  void set(std::string_view name, const ParamValue& value);
  void set_text(std::string_view name, std::string_view text);
  // "name=value", as --set takes it. Throws Error also as parse_value(), as set() and set_text() do.
  void assign(std::string_view assignment);
  void reset(std::string_view name);
  bool is_default(std::string_view name) const;

  // Whether both have the same names, in the same order, with the same values. Quick for copies of one set.
  bool operator==(const ParamSet& other) const;

 private:
  struct Declared {
    std::vector<Param> rows;
    std::map<std::string, size_t, std::less<>> index;
  };
  size_t index_of(std::string_view name) const;

  std::shared_ptr<const Declared> declared_;
  std::vector<ParamValue> values_;
};

// A parameter's identifier in GLSL: its name with '.' replaced by '_'.
std::string glsl_name(const Param& param);

// GLSL text: for every word of a parameter its index ("const int sun_shape_disc = 0;"), and one std140 block `Params`
// at `binding_point` for the uniform rows.
std::string glsl_declarations(const ParamSet& params, int binding_point);

// The values that `params` has for those of `rows` that are compiled, as preprocessor constants.
struct GlslConstant {
  std::string name, value;
};
std::vector<GlslConstant> compiled_constants(const ParamSet& params, std::span<const Param> rows);

// The bytes of the block `Params`, std140: every uniform row is a 4-byte scalar, in row order.
std::vector<std::byte> uniform_bytes(const ParamSet& params);

}  // namespace penumbra
