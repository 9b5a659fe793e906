#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::report {

// Escapes `text` for HTML, between tags and within quoted attributes. Invalid UTF-8 becomes U+FFFD; control characters
// that HTML forbids become spaces.
std::string escape(std::string_view text);

// RFC 4648, section 4, with padding.
std::string base64(std::span<const std::byte> bytes);

// A PNG file in memory and its size in pixels. Copies share the memory.
struct EncodedPicture {
  std::shared_ptr<const std::vector<std::byte>> png;
  int width = 0, height = 0;
};

EncodedPicture make_picture(std::vector<std::byte> png, int width, int height);

// Markup of a page. Untrusted text (names in scenes, paths, command lines) must go through text(), which escapes it, so
// that a scene named "<script>" remains a name. Pictures are kept separately from the markup, so that a page which
// shows one several times stores it once.
class Html {
 public:
  // A piece of markup, optionally followed by the attribute that makes an <img> show `picture`.
  struct Part {
    std::string markup;
    EncodedPicture picture;
  };

  Html() = default;
  explicit Html(std::string_view markup) { add(markup); }  // taken as it is

  Html& add(std::string_view markup);  // taken as it is
  Html& add(const Html& other);
  Html& text(std::string_view text);  // adds escaped text
  // Adds the source attribute of an <img> whose tag is still open.
  Html& source(const EncodedPicture& picture);

  const std::vector<Part>& parts() const { return parts_; }
  // The whole markup, with each picture as a data: URI wherever it is shown.
  std::string str() const;

 private:
  std::vector<Part> parts_;
};

// "data:image/png;base64,…"
std::string data_uri(const EncodedPicture& picture);

}  // namespace penumbra::report
