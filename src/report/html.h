#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::report {

// `text` for use in HTML, between tags and within quoted attributes. Bytes that are no UTF-8 become U+FFFD, control
// characters that HTML forbids become spaces.
std::string escape(std::string_view text);

// RFC 4648, section 4, with padding.
std::string base64(std::span<const std::byte> bytes);

// A PNG file in memory and its size in pixels. Copies share the file.
struct EncodedPicture {
  std::shared_ptr<const std::vector<std::byte>> png;
  int width = 0, height = 0;
};

EncodedPicture make_picture(std::vector<std::byte> png, int width, int height);

// Markup of a page. What others wrote (names in scenes, paths, command lines) becomes markup by text() alone, so a
// scene named "<script>" stays a name. Pictures are kept beside the markup: a page that shows one several times holds
// it once.
class Html {
 public:
  // Markup, and behind it, unless empty, the attribute that makes an <img> show `picture`.
  struct Part {
    std::string markup;
    EncodedPicture picture;
  };

  Html() = default;
  explicit Html(std::string_view markup) { add(markup); }  // taken as it is

  Html& add(std::string_view markup);  // taken as it is
  Html& add(const Html& other);
  Html& text(std::string_view text);  // escaped
  // The attribute of an <img> whose tag is still open.
  Html& source(const EncodedPicture& picture);

  const std::vector<Part>& parts() const { return parts_; }
  // All of it, each picture as a data: URI wherever it is shown.
  std::string str() const;

 private:
  std::vector<Part> parts_;
};

// "data:image/png;base64,…"
std::string data_uri(const EncodedPicture& picture);

}  // namespace penumbra::report
