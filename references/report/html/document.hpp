// Pages to be read, and the parts that they are made of. What is called text here is escaped; HTML is not.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb::report::html {

/// A page in which nothing runs, whatever a name holds.
struct Document {
  std::string title;       ///< text
  std::string conclusion;  ///< text: what was found, in one sentence; it stands first
  std::string body;        ///< HTML
  std::string back;        ///< HTML: a link to the page above this one; may be empty
};

/// The whole page; it needs no other file.
std::string page(const Document& document);

/// The paragraph with which a page begins, of text.
std::string conclusion(std::string_view text);

/// <TAG class=CLASS>, with HTML inside; without a class where that is empty.
std::string element(std::string_view tag, std::string_view class_name, std::string_view inner);

/// A paragraph of text.
std::string paragraph(std::string_view text, std::string_view class_name = "");

/// A link, of text.
std::string link(std::string_view address, std::string_view text);

/// A term, which is text, and what is said of it, which is HTML.
using Definition = std::pair<std::string_view, std::string>;
std::string definitions(const std::vector<Definition>& all);

/// A table that scrolls in a box of its own where it is wider than the page. `name`, which is text, says what
/// it holds; each cell of `head` and the `rows` are HTML.
std::string table(std::string_view name, const std::vector<std::string>& head, std::string_view rows);

/// <img>, of a PNG in base64; `alternative` is text that says what is seen.
std::string image(std::string_view png, std::string_view alternative);

/// By how much the picture of a difference is brighter than the difference.
inline constexpr int difference_gain = 4;

/// PNG files in base64: what is right, what was handed in, and where they differ.
struct ThreePictures {
  std::string right;
  std::string yours;
  std::string difference;
};

/// The three side by side, in the words that all pages have for them. `subject` is text: what they show.
/// `remark` is text that follows "yours", e.g. ", with this mistake"; `remark_on_right` follows "right".
std::string figures(const ThreePictures& pictures, std::string_view subject, std::string_view remark = "",
                    std::string_view remark_on_right = "");

}  // namespace plumb::report::html
