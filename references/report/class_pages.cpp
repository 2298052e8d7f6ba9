#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>

#include "references/report/class_report.hpp"
#include "references/report/fault_pages.hpp"
#include "references/report/html/escape.hpp"
#include "references/report/html/own_page.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::report {
namespace {

/// Beside the pages of submissions: what was found in any, each with its formulas and a pair of pictures.
constexpr const char* lessons_page = "faults.html";

std::string lesson_link(const faults::Fault& fault) {
  return html::link(std::string(lessons_page) + "#" + std::string(fault.id), fault.id);
}

std::string confidence_text(double confidence) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%.2f", confidence);
  return text.data();
}

std::string fault_text(const diagnosis::FoundFault& found, HintLevel hint) {
  const faults::Fault& fault = *found.fault;
  std::vector<html::Definition> all{{"slide", html_escaped(fault.slide)}};
  if (hint >= 2) all.emplace_back("mistake", html_escaped(fault.explanation));
  if (hint < 3 && !found.alike.empty())
    all.emplace_back("or", "one of " + std::to_string(found.alike.size()) + " others: the same picture here");
  if (hint >= 3) {
    all.emplace_back("right", html::element("code", "right", html_escaped(fault.right)));
    all.emplace_back("yours", html::element("code", "yours", html_escaped(fault.wrong)));
    all.emplace_back("lesson", lesson_link(fault));
    for (const faults::Fault* other : found.alike)
      all.emplace_back("or", lesson_link(*other) + ": the same picture here");
  }
  all.emplace_back("pixels", std::to_string(found.pixels));
  all.emplace_back("confidence", confidence_text(found.confidence));
  return html::definitions(all);
}

std::string class_of(submissions::Judged verdict) {
  return std::string("badge verdict-") + submissions::to_string(verdict);
}

std::string tag(submissions::Judged verdict) {
  return html::element("span", class_of(verdict), submissions::to_string(verdict));
}

/// A page is worth having without its pictures.
std::string figures_of(const submissions::JudgedPicture& picture, const submissions::Journal* journal) {
  try {
    const auto pictures = journal == nullptr ? std::nullopt : journal->pictures_of(picture);
    return pictures ? html::figures(*pictures, picture.scene) : "";
  } catch (const std::exception& error) {
    return html::paragraph(std::string("The pictures are lost: ") + error.what());
  }
}

std::string diagnosis_text(const submissions::JudgedPicture& picture, HintLevel hint) {
  const diagnosis::Diagnosis& found = *picture.diagnosis;
  std::string text = html::paragraph(found.encoding.in_words() + "; " + std::to_string(found.pixels_over) +
                                     " of " + std::to_string(found.pixels) + " pixels remain unexplained");
  if (picture.verdict != submissions::Judged::faults) return text;
  for (const diagnosis::FoundFault& fault : found.faults) text += fault_text(fault, hint);
  return text;
}

std::string section(const submissions::JudgedPicture& picture, HintLevel hint,
                    const submissions::Journal* journal) {
  std::string text = "<section id=\"" + html_escaped(picture.scene) + "\">" +
                     html::element("h2", "", html_escaped(picture.scene) + " " + tag(picture.verdict)) + "\n";
  if (!picture.message.empty()) text += html::paragraph(picture.message);
  if (picture.diagnosis) text += diagnosis_text(picture, hint);
  text += figures_of(picture, journal);
  if (!picture.printed.empty()) text += html::element("pre", "", html_escaped(picture.printed)) + "\n";
  return text + "</section>\n";
}

std::string cell(const submissions::JudgedPicture& picture, const std::string& file, HintLevel hint) {
  std::string names;
  if (picture.diagnosis && picture.verdict == submissions::Judged::faults) {
    for (const diagnosis::FoundFault& found : picture.diagnosis->faults) {
      const std::string name = hint >= 3 ? std::string(found.fault->id) : named(*found.fault, hint);
      const std::string alike =
          found.alike.empty() ? "" : " or " + std::to_string(found.alike.size()) + " alike";
      names += html::element("small", "", html_escaped(name + alike));
    }
  }
  return html::element("td", "",
                       "<a class=\"" + class_of(picture.verdict) + "\" href=\"" + file + "#" +
                           html_escaped(picture.scene) + "\">" + submissions::to_string(picture.verdict) +
                           "</a>" + names);
}

std::string summary(const std::vector<submissions::JudgedPicture>& all) {
  std::map<submissions::Judged, std::size_t> counts;
  for (const submissions::JudgedPicture& picture : all) ++counts[picture.verdict];
  std::string tags;
  for (const auto& [verdict, count] : counts)
    tags += html::element("span", "group", tag(verdict) + " " + std::to_string(count));
  std::string text = html::element("div", "group", tags) + "\n";
  if (const std::size_t done = judged_count(all); done != all.size())
    text +=
        html::paragraph("The run was interrupted: " + std::to_string(all.size() - done) + " of " +
                        std::to_string(all.size()) + " pictures were not judged. The same command goes on.");
  return text;
}

std::string shuffle_text(const RunFacts& facts) {
  if (!facts.seed) return {};
  std::string text = "The scenes are varied: --shuffle " + std::to_string(*facts.seed) +
                     "; they are in the report's directory scenes.";
  if (!facts.unvaried.empty()) text += " Judged as they are, for no variation shows the same faults:";
  for (const std::string& name : facts.unvaried) text += " " + name;
  return html::paragraph(text);
}

std::string limits_text(const RunFacts& facts) {
  return facts.not_enforced.empty() ? "" : html::paragraph("Limits: " + facts.not_enforced + ".");
}

std::string not_judged_text(const RunFacts& facts) {
  if (facts.of_no_scene.empty()) return {};
  std::string text = "Pictures that are not judged, for they are of no scene or lie beside submissions:";
  for (const std::string& name : facts.of_no_scene) text += " " + name;
  return html::paragraph(text);
}

/// All faults of which a page names one, in the catalogue's order.
std::vector<const faults::Fault*> faults_found(const std::vector<submissions::JudgedPicture>& all) {
  std::set<const faults::Fault*> named;
  for (const submissions::JudgedPicture& picture : all) {
    if (!picture.diagnosis || picture.verdict != submissions::Judged::faults) continue;
    for (const diagnosis::FoundFault& one : picture.diagnosis->faults) {
      named.insert(one.fault);
      named.insert(one.alike.begin(), one.alike.end());
    }
  }
  std::vector<const faults::Fault*> found;
  for (const faults::Fault& fault : faults::fault_catalogue()) {
    if (named.contains(&fault)) found.push_back(&fault);
  }
  return found;
}

/// Numbered, so that no name of a submission becomes one of a file.
std::string page_name(std::size_t number) { return "submission-" + std::to_string(number + 1) + ".html"; }

/// Of these pictures, in one sentence.
std::string conclusion_of_pictures(const submissions::JudgedPicture* begin,
                                   const submissions::JudgedPicture* end) {
  const auto count = [&](std::initializer_list<submissions::Judged> verdicts) {
    return static_cast<std::size_t>(std::count_if(begin, end, [&](const submissions::JudgedPicture& p) {
      return std::find(verdicts.begin(), verdicts.end(), p.verdict) != verdicts.end();
    }));
  };
  const auto all = static_cast<std::size_t>(end - begin);
  const std::size_t right = count({submissions::Judged::right}),
                    apart = count({submissions::Judged::right_apart}),
                    faults = count({submissions::Judged::faults}),
                    open = count({submissions::Judged::not_judged, submissions::Judged::trouble});
  std::string text = right == all ? (all == 1 ? "The picture is right"
                                              : "All " + std::to_string(all) + " pictures are right")
                                  : std::to_string(right) + " of " + std::to_string(all) +
                                        (all == 1     ? " picture is right"
                                         : right == 1 ? " pictures is right"
                                                      : " pictures are right");
  const auto add = [&](std::size_t number, const std::string& one, const std::string& several) {
    if (number > 0) text += "; " + std::to_string(number) + (number == 1 ? one : several);
  };
  add(apart, " is right apart from a few pixels", " are right apart from a few pixels");
  if (faults > 0) text += "; known mistakes explain " + std::to_string(faults);
  const std::string how = faults > 0 ? " wrong otherwise or missing" : " wrong or missing";
  add(all - right - apart - faults - open, " is" + how, " are" + how);
  add(open, " was not judged", " were not judged");
  return text + ".";
}

/// One submission: its row in the table and its page.
struct Row {
  const submissions::JudgedPicture* begin;
  const submissions::JudgedPicture* end;
  std::string file;

  std::string score() const {
    const auto right = std::count_if(begin, end, [](const submissions::JudgedPicture& p) {
      return p.verdict == submissions::Judged::right;
    });
    return std::to_string(right) + " of " + std::to_string(end - begin) + " right";
  }
};

std::vector<Row> rows_of(const std::vector<submissions::JudgedPicture>& all) {
  std::vector<Row> rows;
  const submissions::JudgedPicture* const end = all.data() + all.size();
  for (const submissions::JudgedPicture* at = all.data(); at != end; at = rows.back().end) {
    const auto* next = std::find_if(
        at, end, [&](const submissions::JudgedPicture& p) { return p.submission != at->submission; });
    rows.push_back({at, next, page_name(rows.size())});
  }
  return rows;
}

std::string table_row(const Row& row, HintLevel hint) {
  std::string text = "<tr><th scope=\"row\">" + html::link(row.file, row.begin->submission) +
                     html::element("small", "", row.score()) + "</th>";
  for (const submissions::JudgedPicture* at = row.begin; at != row.end; ++at)
    text += cell(*at, row.file, hint);
  return text + "</tr>\n";
}

std::string link_to_all() { return html::link("index.html", "← All submissions"); }

std::string page_of(const Row& row, HintLevel hint, const RunFacts& facts) {
  std::string body = shuffle_text(facts);
  for (const submissions::JudgedPicture* at = row.begin; at != row.end; ++at)
    body += section(*at, hint, facts.journal);
  return html::page({row.begin->submission, conclusion_of_pictures(row.begin, row.end), body, link_to_all()});
}

std::string table_of(const std::vector<Row>& rows, HintLevel hint) {
  std::vector<std::string> head{"submission"};
  if (!rows.empty()) {
    for (const submissions::JudgedPicture* at = rows.front().begin; at != rows.front().end; ++at)
      head.push_back(html_escaped(at->scene));
  }
  std::string text;
  for (const Row& row : rows) text += table_row(row, hint);
  return html::table("Verdicts, a row a submission, a column a scene", head, text);
}

/// Lessons show formulas, which are told at the last level alone: an earlier run's are taken away.
void write_lessons(const std::filesystem::path& file, const std::vector<submissions::JudgedPicture>& all,
                   HintLevel hint) {
  const std::vector<const faults::Fault*> found =
      hint >= 3 ? faults_found(all) : std::vector<const faults::Fault*>();
  if (found.empty()) {
    std::filesystem::remove(file);
    return;
  }
  std::string text;
  for (const faults::Fault* fault : found) text += section_of(*fault, data_directory(Data::scenes));
  const std::string count = std::to_string(found.size());
  write_file(file, html::page({"What was found",
                               found.size() == 1
                                   ? "1 known mistake may explain these pictures; here it is."
                                   : count + " known mistakes may explain these pictures; here they are.",
                               text, link_to_all()}));
}

}  // namespace

void write_overview(const std::string& directory, const std::vector<submissions::JudgedPicture>& all,
                    HintLevel hint, const RunFacts& facts) {
  const std::filesystem::path folder(directory);
  std::filesystem::create_directories(folder);
  const std::vector<Row> rows = rows_of(all);
  refuse_to_replace_others((folder / "index.html").string());
  refuse_to_replace_others((folder / lessons_page).string());
  for (const Row& row : rows) refuse_to_replace_others((folder / row.file).string());
  for (const Row& row : rows) write_file(folder / row.file, page_of(row, hint, facts));
  write_lessons(folder / lessons_page, all, hint);
  const std::string body =
      summary(all) + shuffle_text(facts) + limits_text(facts) + not_judged_text(facts) + table_of(rows, hint);
  write_file(folder / "index.html",
             html::page({"Tracers judged by plumb",
                         conclusion_of_pictures(all.data(), all.data() + all.size()), body, ""}));
}

}  // namespace plumb::report
