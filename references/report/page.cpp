#include "references/report/page.hpp"

#include <string_view>

#include "references/report/escape.hpp"
#include "references/report/packing.hpp"
#include "references/report/web.hpp"
#include "references/system/digest.hpp"

namespace plumb::references {
namespace {

/// Names an inline element in a policy (Content Security Policy Level 3, section 2.3.1).
std::string hash_source(std::string_view text) {
  const std::string hex = sha256(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return "'sha256-" + base64(bytes) + "'";
}

std::string policy(bool has_side_files) {
  return "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; style-src " +
         hash_source(web::style) + "; script-src " + hash_source(web::script) +
         (has_side_files ? " 'self' file:" : "");
}

std::string value_of(std::string_view name, const std::string& title, const std::string& blocks,
                     bool has_side_files) {
  if (name == "title") return html_escaped(title);
  if (name == "policy") return policy(has_side_files);
  if (name == "style") return std::string(web::style);
  if (name == "script") return std::string(web::script);
  return blocks;
}

}  // namespace

std::string assembled_page(const std::string& title, const std::string& blocks, bool has_side_files) {
  std::string page;
  std::string_view rest = web::page;
  // One pass over the template: braces in a title or a scene are never taken for a place.
  for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const std::size_t close = rest.find("}}", open);
    page += rest.substr(0, open);
    page += value_of(rest.substr(open + 2, close - open - 2), title, blocks, has_side_files);
    rest.remove_prefix(close + 2);
  }
  return page + std::string(rest);
}

}  // namespace plumb::references
