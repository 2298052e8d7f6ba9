#include "references/report/html/document.hpp"

#include "references/report/html/escape.hpp"
#include "references/report/html/template.hpp"

namespace plumb::report::html {
namespace {

std::string figure(std::string_view png, std::string_view subject, const std::string& caption) {
  return "<figure>" + image(png, std::string(subject) + ": " + caption) +
         element("figcaption", "", html_escaped(caption)) + "</figure>";
}

}  // namespace

std::string conclusion(std::string_view text) { return paragraph(text, "conclusion"); }

std::string page(const Document& document) {
  const std::string title = element("h1", "title", html_escaped(document.title)) +
                            paragraph("plumb " PLUMB_VERSION, "muted subtitle");
  return filled_template(document.title,
                         "<header class=\"top\">" + element("div", "titles", title) + document.back +
                             "</header>\n<main id=\"main\" class=\"document\" tabindex=\"-1\">\n" +
                             conclusion(document.conclusion) + "\n" + document.body + "</main>");
}

std::string element(std::string_view tag, std::string_view class_name, std::string_view inner) {
  const std::string name(tag);
  const std::string attribute = class_name.empty() ? "" : " class=\"" + std::string(class_name) + "\"";
  return "<" + name + attribute + ">" + std::string(inner) + "</" + name + ">";
}

std::string paragraph(std::string_view text, std::string_view class_name) {
  return element("p", class_name, html_escaped(text)) + "\n";
}

std::string link(std::string_view address, std::string_view text) {
  return "<a href=\"" + html_escaped(address) + "\">" + html_escaped(text) + "</a>";
}

std::string definitions(const std::vector<Definition>& all) {
  std::string list;
  for (const auto& [term, said] : all)
    list += element("dt", "", html_escaped(term)) + element("dd", "", said) + "\n";
  return element("dl", "", list);
}

std::string table(std::string_view name, const std::vector<std::string>& head, std::string_view rows) {
  std::string heads;
  for (const std::string& cell : head) heads += "<th scope=\"col\">" + cell + "</th>";
  return "<div class=\"scrolls\" role=\"region\" tabindex=\"0\" aria-label=\"" + html_escaped(name) +
         "\"><table><thead><tr>" + heads + "</tr></thead><tbody>\n" + std::string(rows) +
         "</tbody></table></div>\n";
}

std::string image(std::string_view png, std::string_view alternative) {
  return "<img alt=\"" + html_escaped(alternative) + "\" src=\"data:image/png;base64," + std::string(png) +
         "\">";
}

std::string figures(const ThreePictures& pictures, std::string_view subject, std::string_view remark,
                    std::string_view remark_on_right) {
  const std::string difference = "difference, " + std::to_string(difference_gain) + " times as bright";
  return element("div", "figures",
                 figure(pictures.right, subject, "right" + std::string(remark_on_right)) +
                     figure(pictures.yours, subject, "yours" + std::string(remark)) +
                     figure(pictures.difference, subject, difference)) +
         "\n";
}

}  // namespace plumb::report::html
