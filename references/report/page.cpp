#include "references/report/page.hpp"

#include "references/report/html/document.hpp"
#include "references/report/html/template.hpp"
#include "references/report/html/web.hpp"

namespace plumb::report {

std::string assembled_page(const std::string& title, const std::string& conclusion, const std::string& blocks,
                           bool has_side_files) {
  const std::string body = "<div id=\"app\"></div>\n<noscript>" + html::conclusion(conclusion) +
                           "<p>This report shows its pictures with JavaScript; it loads nothing from a "
                           "network.</p></noscript>\n" +
                           blocks + "<script>" + std::string(web::script) + "</script>";
  return html::filled_template(title, body,
                               html::hash_source(web::script) + (has_side_files ? " 'self' file:" : ""));
}

}  // namespace plumb::report
