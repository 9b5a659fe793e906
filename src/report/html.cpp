#include "report/html.h"

#include <algorithm>
#include <cstdint>

#include "core/utf8.h"

namespace penumbra::report {

namespace {

std::string_view escaped(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return {};
  }
}

bool is_forbidden(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) {
      result += "\xef\xbf\xbd";
    } else if (length > 1) {
      result += text.substr(0, length);
    } else if (const std::string_view entity = escaped(text[0]); !entity.empty()) {
      result += entity;
    } else {
      result += is_forbidden(text[0]) ? ' ' : text[0];
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

std::string base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) result += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return result;
}

EncodedPicture make_picture(std::vector<std::byte> png, int width, int height) {
  return {std::make_shared<const std::vector<std::byte>>(std::move(png)), width, height};
}

std::string data_uri(const EncodedPicture& picture) { return "data:image/png;base64," + base64(*picture.png); }

Html& Html::add(std::string_view markup) {
  if (parts_.empty() || parts_.back().picture.png) parts_.emplace_back();
  parts_.back().markup += markup;
  return *this;
}

Html& Html::add(const Html& other) {
  for (const Part& part : other.parts_) {
    add(part.markup);
    if (part.picture.png) source(part.picture);
  }
  return *this;
}

Html& Html::text(std::string_view text) { return add(escape(text)); }

Html& Html::source(const EncodedPicture& picture) {
  add("");
  parts_.back().picture = picture;
  return *this;
}

std::string Html::str() const {
  std::string result;
  for (const Part& part : parts_) {
    result += part.markup;
    if (part.picture.png) result += " src='" + data_uri(part.picture) + "'";
  }
  return result;
}

}  // namespace penumbra::report
