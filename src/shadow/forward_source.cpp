#include "forward_source.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <vector>

namespace penumbra::shadow {

namespace {

enum class Kind { name, other };

// A token of the text; comments, white space and numbers count as `other`.
struct Token {
  Kind kind = Kind::other;
  std::string_view text;
};

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool continues_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_blank(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; }) ||
         text.starts_with("//") || text.starts_with("/*");
}

// Length of the first token in the text.
std::size_t token_length(std::string_view text) {
  const auto up_to = [&](std::string_view end) {
    return std::min(text.find(end, 2), text.size() - end.size()) + end.size();
  };
  if (text.starts_with("//")) return std::min(text.find('\n'), text.size());
  if (text.starts_with("/*")) return text.size() < 4 ? text.size() : up_to("*/");
  // A number includes its suffix and exponent, which must not be taken for names.
  const bool word = continues_name(text.front());
  std::size_t length = 1;
  while (word && length < text.size() &&
         (continues_name(text[length]) || (!begins_name(text[0]) && text[length] == '.')))
    ++length;
  return length;
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  while (!text.empty()) {
    const std::size_t length = token_length(text);
    tokens.push_back({begins_name(text.front()) ? Kind::name : Kind::other, text.substr(0, length)});
    text.remove_prefix(length);
  }
  return tokens;
}

bool is_keyword(std::string_view name) {
  static constexpr std::array<std::string_view, 8> keywords{"layout", "in",    "out",       "uniform",
                                                            "buffer", "const", "precision", "struct"};
  return std::find(keywords.begin(), keywords.end(), name) != keywords.end();
}

// Finds the names that are declared at global scope: the name before "(", "{", "=", "[", "," or ";" outside of all
// brackets, in the members of a block, and after #define.
class Declarations {
 public:
  std::set<std::string_view> find(const std::vector<Token>& tokens) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (tokens[i].text == "#") {
        i = skip_directive(tokens, i);
      } else if (!is_blank(tokens[i].text)) {
        take(tokens[i]);
      }
    }
    return std::move(names_);
  }

 private:
  // The index of the directive's last token.
  std::size_t skip_directive(const std::vector<Token>& tokens, std::size_t i) {
    bool defines = false;
    for (; i + 1 < tokens.size() && tokens[i + 1].text != "\n"; ++i) {
      const Token& next = tokens[i + 1];
      if (next.kind != Kind::name) continue;
      if (defines) names_.insert(next.text);
      defines = next.text == "define";
    }
    return i;
  }

  void take(const Token& token) {
    if (token.kind == Kind::name) {
      block_ = block_ || (depth_ == 0 && (token.text == "uniform" || token.text == "buffer"));
      last_ = token.text;
      return;
    }
    const char c = token.text.front();
    const bool declares = depth_ == 0 || (block_ && depth_ == 1 && braces_ == 1);
    if (declares && !in_value_ && !last_.empty() && !is_keyword(last_) && std::string_view("({=[,;").find(c) != npos) {
      names_.insert(last_);
    }
    last_ = {};
    if (c == '{') ++braces_;
    if (c == '}') --braces_;
    if (c == '(' || c == '{' || c == '[') ++depth_;
    if (c == ')' || c == '}' || c == ']') --depth_;
    if (c == '=' && depth_ == 0) in_value_ = true;
    if (depth_ == 0 && (c == ',' || c == ';' || c == '}')) in_value_ = false;
    if (depth_ == 0 && c == ';') block_ = false;
  }

  static constexpr std::size_t npos = std::string_view::npos;
  std::set<std::string_view> names_;
  std::string_view last_;
  int depth_ = 0, braces_ = 0;
  bool block_ = false, in_value_ = false;
};

}  // namespace

std::string with_prefix(std::string_view glsl, std::string_view prefix) {
  const std::vector<Token> tokens = tokens_of(glsl);
  const std::set<std::string_view> names = Declarations().find(tokens);
  std::string result;
  for (const Token& token : tokens) {
    if (token.kind == Kind::name && names.contains(token.text) && !token.text.starts_with(prefix)) result += prefix;
    result += token.text;
  }
  return result;
}

std::string without_version(std::string_view glsl) {
  if (glsl.starts_with("#version")) glsl.remove_prefix(std::min(glsl.find('\n'), glsl.size() - 1) + 1);
  return std::string(glsl);
}

}  // namespace penumbra::shadow
