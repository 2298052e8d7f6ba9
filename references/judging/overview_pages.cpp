#include <filesystem>
#include <map>
#include <set>

#include "references/judging/overview.hpp"
#include "references/report/escape.hpp"
#include "references/teaching/pages.hpp"
#include "tracer/image/files.hpp"

namespace plumb::references {
namespace {

/// Colour-blind safe (Okabe and Ito, 2008), and each verdict is written out, too.
constexpr const char* style = R"(
body{max-width:1500px}table{border-collapse:collapse;margin:1rem 0}
th,td{padding:.25rem .55rem;text-align:left;font-weight:normal;vertical-align:top}
thead th{position:sticky;top:0;background:var(--raised)}tbody th{background:var(--raised);white-space:nowrap}
td,.tag{color:#1c1c1c}td a{color:inherit;text-decoration:none;display:block}td a:hover{text-decoration:underline}
td small{display:block;opacity:.85;max-width:22rem}.tag{padding:.1rem .5rem;border-radius:.25rem}
.right{background:#bfe8d6}.faults{background:#ffe3a3}.unexplained{background:#f3c9df}
.wrong-size,.no-image,.unreadable{background:#d6e4f5}
.crashed,.timed-out,.too-much-cpu,.too-much-memory,.too-many-processes,.too-much-output{background:#f0b9a0}
.pictures{max-width:64rem}pre{background:var(--raised);padding:.6rem;overflow:auto;max-height:14rem;white-space:pre-wrap}
)";

/// Beside the pages of submissions: what was found in any, each with its formulas and a pair of pictures.
constexpr const char* lessons_page = "faults.html";

std::string definition(std::string_view term, std::string_view text) {
  return "<dt>" + html_escaped(term) + "</dt><dd>" + html_escaped(text) + "</dd>\n";
}

std::string lesson_link(const Fault& fault) {
  const std::string id = html_escaped(fault.id);
  return "<a href=\"" + std::string(lessons_page) + "#" + id + "\">" + id + "</a>";
}

std::string fault_text(const FoundFault& found, HintLevel hint) {
  const Fault& fault = *found.fault;
  std::string text = "<dl>\n" + definition("slide", fault.slide);
  if (hint >= 2) text += definition("mistake", fault.explanation);
  if (hint >= 3) {
    text += definition("found", fault.wrong) + definition("right", fault.right);
    text += "<dt>lesson</dt><dd>" + lesson_link(fault) + "</dd>\n";
    for (const Fault* other : found.alike)
      text += "<dt>or</dt><dd>" + lesson_link(*other) + ": the same picture here</dd>\n";
  }
  return text + definition("pixels", std::to_string(found.pixels)) + "</dl>\n";
}

std::string tag(Judged verdict) {
  const std::string name = to_string(verdict);
  return "<span class=\"tag " + name + "\">" + name + "</span>";
}

std::string section(const JudgedPicture& picture, HintLevel hint) {
  std::string text = "<h2 id=\"" + html_escaped(picture.scene) + "\">" + html_escaped(picture.scene) + " " +
                     tag(picture.verdict) + "</h2>\n";
  if (!picture.message.empty()) text += "<p>" + html_escaped(picture.message) + "</p>\n";
  if (picture.diagnosis) {
    text += "<p>" + html_escaped(picture.diagnosis->encoding.in_words()) + "; " +
            std::to_string(picture.diagnosis->pixels_over) + " of " +
            std::to_string(picture.diagnosis->pixels) + " pixels remain unexplained</p>\n";
    if (picture.verdict == Judged::faults) {
      for (const FoundFault& found : picture.diagnosis->faults) text += fault_text(found, hint);
    }
  }
  if (!picture.figures.empty()) text += "<div class=pictures>" + picture.figures + "</div>\n";
  if (!picture.printed.empty()) text += "<pre>" + html_escaped(picture.printed) + "</pre>\n";
  return text;
}

std::string cell(const JudgedPicture& picture, const std::string& file, HintLevel hint) {
  const std::string verdict = to_string(picture.verdict);
  std::string names;
  if (picture.diagnosis && picture.verdict == Judged::faults) {
    for (const FoundFault& found : picture.diagnosis->faults)
      names += "<small>" +
               html_escaped(hint >= 3 ? std::string(found.fault->id) : named(*found.fault, hint)) +
               "</small>";
  }
  return "<td class=\"" + verdict + "\"><a href=\"" + file + "#" + html_escaped(picture.scene) + "\">" +
         verdict + "</a>" + names + "</td>";
}

std::string summary(const std::vector<JudgedPicture>& all) {
  std::map<Judged, std::size_t> counts;
  for (const JudgedPicture& picture : all) ++counts[picture.verdict];
  std::string text = "<p>";
  for (const auto& [verdict, count] : counts) text += tag(verdict) + " " + std::to_string(count) + " &ensp; ";
  return text + "</p>\n";
}

/// All faults of which a page names one, in the catalogue's order.
std::string lessons(const std::vector<JudgedPicture>& all) {
  std::set<const Fault*> found;
  for (const JudgedPicture& picture : all) {
    if (!picture.diagnosis || picture.verdict != Judged::faults) continue;
    for (const FoundFault& one : picture.diagnosis->faults) {
      found.insert(one.fault);
      found.insert(one.alike.begin(), one.alike.end());
    }
  }
  std::string text;
  for (const Fault& fault : fault_catalogue()) {
    if (found.contains(&fault)) text += teaching::section_of(fault, PLUMB_SOURCE_DIRECTORY "/tests/scenes");
  }
  return text;
}

/// Numbered, so that no name of a submission becomes one of a file.
std::string page_name(std::size_t number) { return "submission-" + std::to_string(number + 1) + ".html"; }

}  // namespace

void write_overview(const std::string& directory, const std::vector<JudgedPicture>& all, HintLevel hint) {
  const std::filesystem::path folder(directory);
  std::filesystem::create_directories(folder);
  std::string head = "<tr><th>submission</th>";
  std::string rows;
  std::size_t number = 0;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end, ++number) {
    const std::string& name = all[begin].submission;
    std::string row;
    std::string sections;
    std::size_t right = 0;
    for (end = begin; end < all.size() && all[end].submission == name; ++end) {
      if (number == 0) head += "<th>" + html_escaped(all[end].scene) + "</th>";
      row += cell(all[end], page_name(number), hint);
      sections += section(all[end], hint);
      right += all[end].verdict == Judged::right ? 1 : 0;
    }
    const std::string score = std::to_string(right) + " of " + std::to_string(end - begin) + " right";
    const std::string file = page_name(number);
    rows.append("<tr><th><a href=\"").append(file).append("\">").append(html_escaped(name));
    rows.append("</a><br><small>").append(score).append("</small></th>").append(row).append("</tr>\n");
    std::string body = "<p><a href=\"index.html\">all submissions</a></p><p>";
    body.append(score).append("</p>\n").append(sections);
    write_file(folder / file, teaching::page(name, body, style));
  }
  // Lessons show formulas, which are told at the last level alone: an earlier run's are taken away.
  const std::string text = hint >= 3 ? lessons(all) : "";
  if (text.empty())
    std::filesystem::remove(folder / lessons_page);
  else
    write_file(
        folder / lessons_page,
        teaching::page("What was found", "<p><a href=\"index.html\">all submissions</a></p>\n" + text));
  write_file(folder / "index.html", teaching::page("Tracers judged by plumb",
                                                   summary(all) + "<table><thead>" + head +
                                                       "</tr></thead><tbody>\n" + rows + "</tbody></table>\n",
                                                   style));
}

}  // namespace plumb::references
