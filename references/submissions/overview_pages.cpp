#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "references/report/escape.hpp"
#include "references/report/own_page.hpp"
#include "references/submissions/overview.hpp"
#include "references/teaching/pages.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

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
.trouble,.not-judged{background:#dcdcdc}
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
  if (hint < 3 && !found.alike.empty())
    text +=
        definition("or", "one of " + std::to_string(found.alike.size()) + " others: the same picture here");
  if (hint >= 3) {
    text += definition("found", fault.wrong) + definition("right", fault.right);
    text += "<dt>lesson</dt><dd>" + lesson_link(fault) + "</dd>\n";
    for (const Fault* other : found.alike)
      text += "<dt>or</dt><dd>" + lesson_link(*other) + ": the same picture here</dd>\n";
  }
  std::array<char, 16> confidence{};
  std::snprintf(confidence.data(), confidence.size(), "%.2f", found.confidence);
  return text + definition("pixels", std::to_string(found.pixels)) +
         definition("confidence", confidence.data()) + "</dl>\n";
}

std::string tag(Judged verdict) {
  const std::string name = to_string(verdict);
  return "<span class=\"tag " + name + "\">" + name + "</span>";
}

/// A page is worth having without its pictures.
std::string figures_of(const JudgedPicture& picture, const Journal* journal) {
  try {
    return journal == nullptr ? std::string() : journal->figures_of(picture);
  } catch (const std::exception& error) {
    return "<p>The pictures are lost: " + html_escaped(error.what()) + "</p>";
  }
}

std::string section(const JudgedPicture& picture, HintLevel hint, const Journal* journal) {
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
  const std::string figures = figures_of(picture, journal);
  if (!figures.empty()) text += "<div class=pictures>" + figures + "</div>\n";
  if (!picture.printed.empty()) text += "<pre>" + html_escaped(picture.printed) + "</pre>\n";
  return text;
}

std::string cell(const JudgedPicture& picture, const std::string& file, HintLevel hint) {
  const std::string verdict = to_string(picture.verdict);
  std::string names;
  if (picture.diagnosis && picture.verdict == Judged::faults) {
    for (const FoundFault& found : picture.diagnosis->faults)
      names +=
          "<small>" + html_escaped(hint >= 3 ? std::string(found.fault->id) : named(*found.fault, hint)) +
          (found.alike.empty() ? "" : " or " + std::to_string(found.alike.size()) + " alike") + "</small>";
  }
  return "<td class=\"" + verdict + "\"><a href=\"" + file + "#" + html_escaped(picture.scene) + "\">" +
         verdict + "</a>" + names + "</td>";
}

std::string summary(const std::vector<JudgedPicture>& all) {
  std::map<Judged, std::size_t> counts;
  for (const JudgedPicture& picture : all) ++counts[picture.verdict];
  std::string text = "<p>";
  for (const auto& [verdict, count] : counts) text += tag(verdict) + " " + std::to_string(count) + " &ensp; ";
  text += "</p>\n";
  if (const std::size_t done = judged_count(all); done != all.size())
    text += "<p>The run was interrupted: " + std::to_string(all.size() - done) + " of " +
            std::to_string(all.size()) + " pictures were not judged. The same command goes on.</p>\n";
  return text;
}

std::string shuffle_text(const RunFacts& facts) {
  if (!facts.seed) return {};
  std::string text = "<p>The scenes are varied: --shuffle " + std::to_string(*facts.seed) +
                     "; they are in the report's directory scenes.";
  if (!facts.unvaried.empty()) text += " Judged as they are, for no variation shows the same faults:";
  for (const std::string& name : facts.unvaried) text += " " + html_escaped(name);
  return text + "</p>\n";
}

std::string limits_text(const RunFacts& facts) {
  return facts.not_enforced.empty() ? "" : "<p>Limits: " + html_escaped(facts.not_enforced) + ".</p>\n";
}

std::string not_judged_text(const RunFacts& facts) {
  if (facts.of_no_scene.empty()) return {};
  std::string text = "<p>Pictures that are not judged, for they are of no scene or lie beside submissions:";
  for (const std::string& name : facts.of_no_scene) text += " " + html_escaped(name);
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
    if (found.contains(&fault)) text += teaching::section_of(fault, data_directory(Data::scenes));
  }
  return text;
}

/// Numbered, so that no name of a submission becomes one of a file.
std::string page_name(std::size_t number) { return "submission-" + std::to_string(number + 1) + ".html"; }

/// One submission: its row in the table and its page.
struct Row {
  const JudgedPicture* begin;
  const JudgedPicture* end;
  std::string file;

  std::string score() const {
    const auto right =
        std::count_if(begin, end, [](const JudgedPicture& p) { return p.verdict == Judged::right; });
    return std::to_string(right) + " of " + std::to_string(end - begin) + " right";
  }
};

std::vector<Row> rows_of(const std::vector<JudgedPicture>& all) {
  std::vector<Row> rows;
  const JudgedPicture* const end = all.data() + all.size();
  for (const JudgedPicture* at = all.data(); at != end; at = rows.back().end) {
    const auto* next =
        std::find_if(at, end, [&](const JudgedPicture& p) { return p.submission != at->submission; });
    rows.push_back({at, next, page_name(rows.size())});
  }
  return rows;
}

std::string table_row(const Row& row, HintLevel hint) {
  std::string text = "<tr><th><a href=\"" + row.file + "\">" + html_escaped(row.begin->submission) +
                     "</a><br><small>" + row.score() + "</small></th>";
  for (const JudgedPicture* at = row.begin; at != row.end; ++at) text += cell(*at, row.file, hint);
  return text + "</tr>\n";
}

std::string page_of(const Row& row, HintLevel hint, const RunFacts& facts) {
  std::string body =
      "<p><a href=\"index.html\">all submissions</a></p><p>" + row.score() + "</p>\n" + shuffle_text(facts);
  for (const JudgedPicture* at = row.begin; at != row.end; ++at) body += section(*at, hint, facts.journal);
  return teaching::page(row.begin->submission, body, style);
}

std::string table_of(const std::vector<Row>& rows, HintLevel hint) {
  std::string text = "<table><thead><tr><th>submission</th>";
  if (!rows.empty()) {
    for (const JudgedPicture* at = rows.front().begin; at != rows.front().end; ++at)
      text += "<th>" + html_escaped(at->scene) + "</th>";
  }
  text += "</tr></thead><tbody>\n";
  for (const Row& row : rows) text += table_row(row, hint);
  return text + "</tbody></table>\n";
}

/// Lessons show formulas, which are told at the last level alone: an earlier run's are taken away.
void write_lessons(const std::filesystem::path& file, const std::vector<JudgedPicture>& all, HintLevel hint) {
  const std::string text = hint >= 3 ? lessons(all) : "";
  if (text.empty()) {
    std::filesystem::remove(file);
    return;
  }
  write_file(file,
             teaching::page("What was found", "<p><a href=\"index.html\">all submissions</a></p>\n" + text));
}

}  // namespace

void write_overview(const std::string& directory, const std::vector<JudgedPicture>& all, HintLevel hint,
                    const RunFacts& facts) {
  const std::filesystem::path folder(directory);
  std::filesystem::create_directories(folder);
  const std::vector<Row> rows = rows_of(all);
  refuse_to_replace_others((folder / "index.html").string());
  refuse_to_replace_others((folder / lessons_page).string());
  for (const Row& row : rows) refuse_to_replace_others((folder / row.file).string());
  for (const Row& row : rows) write_file(folder / row.file, page_of(row, hint, facts));
  write_lessons(folder / lessons_page, all, hint);
  write_file(folder / "index.html", teaching::page("Tracers judged by plumb",
                                                   summary(all) + shuffle_text(facts) + limits_text(facts) +
                                                       not_judged_text(facts) + table_of(rows, hint),
                                                   style));
}

}  // namespace plumb::references
