#include "references/report/html/template.hpp"

#include "references/report/html/escape.hpp"
#include "references/report/html/packing.hpp"
#include "references/report/html/web.hpp"
#include "references/system/digest.hpp"

namespace plumb::report::html {
namespace {

std::string policy(std::string_view script_sources) {
  const std::string scripts = script_sources.empty() ? "" : "; script-src " + std::string(script_sources);
  return "default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; style-src " +
         hash_source(web::style) + scripts;
}

std::string value_of(std::string_view name, std::string_view title, std::string_view body,
                     std::string_view script_sources) {
  if (name == "title") return html_escaped(title);
  if (name == "policy") return policy(script_sources);
  return std::string(name == "style" ? web::style : body);
}

}  // namespace

std::string hash_source(std::string_view text) {
  const std::string hex = system::sha256(text);
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return "'sha256-" + base64(bytes) + "'";
}

std::string filled_template(std::string_view title, std::string_view body, std::string_view script_sources) {
  std::string page;
  std::string_view rest = web::page;
  // One pass over the template: braces in a title or a scene are never taken for a place.
  for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const std::size_t close = rest.find("}}", open);
    page += rest.substr(0, open);
    page += value_of(rest.substr(open + 2, close - open - 2), title, body, script_sources);
    rest.remove_prefix(close + 2);
  }
  return page + std::string(rest);
}

}  // namespace plumb::report::html
