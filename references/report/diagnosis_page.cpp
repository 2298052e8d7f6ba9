#include "references/report/diagnosis_page.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "references/report/fault_pages.hpp"
#include "references/report/html/escape.hpp"
#include "references/report/html/own_page.hpp"
#include "references/teaching/picture.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::report {
namespace {

using teaching::Picture;

Picture picture_with(const Diagnosed& d, const std::vector<const faults::Fault*>& faults) {
  return teaching::picture_of(faults::render_with(d.shot.scene, d.shot.camera, job_of(d.shot), faults),
                              d.diagnosis.encoding);
}

std::string pictures_of(const Diagnosed& d) {
  std::vector<const faults::Fault*> faults;
  for (const diagnosis::FoundFault& found : d.diagnosis.faults) faults.push_back(found.fault);
  std::sort(faults.begin(), faults.end());
  const Picture seen = teaching::picture_of(d.seen);
  const auto against = [&](const std::vector<const faults::Fault*>& with, const char* remark) {
    return html::figures(teaching::three_pictures(picture_with(d, with), seen), d.image, "", remark);
  };
  return against({}, "") + (faults.empty() ? "" : against(faults, ", with the mistakes below"));
}

std::string figures_of(const diagnosis::FoundFault& found) {
  char text[96];
  std::snprintf(text, sizeof text, "confidence %.2f, %zu pixels tell of it", found.confidence, found.pixels);
  std::string words(text);
  if (!found.alike.empty())
    words += "; so many other mistakes give the same picture here: " + std::to_string(found.alike.size());
  return html::paragraph(words, "muted");
}

std::string section(std::string_view title, const std::string& inner) {
  return html::element("section", "", html::element("h3", "", html_escaped(title)) + inner) + "\n";
}

/// `hint` as on the terminal: 1 the slide, 2 the mistake, 3 formulas and pictures.
std::string told(const diagnosis::FoundFault& found, int hint) {
  const faults::Fault& fault = *found.fault;
  const std::string slide = "slide “" + std::string(fault.slide) + "”";
  if (hint == 1) return section("Look at the " + slide, figures_of(found));
  if (hint == 2)
    return section(fault.explanation, html::paragraph("See the " + slide + ".") + figures_of(found));
  const std::string scenes = data_directory(Data::scenes);
  std::string text = section_of(fault, scenes, figures_of(found));
  for (const faults::Fault* other : found.alike)
    text += html::paragraph("It may be this instead, which gives the same picture here:") +
            section_of(*other, scenes);
  return text;
}

std::string settled_by(const TellApart& group) {
  std::string text = "To tell";
  for (const faults::Fault* fault : group.faults)
    text += " " + html::element("code", "", html_escaped(fault->id));
  text += " apart, ";
  text += group.scene ? "render and diagnose " +
                            html::element("code", "", "tests/scenes/" + html_escaped(*group.scene))
                      : "none of plumb's scenes helps";
  return section("What this picture leaves open", html::element("p", "", text + "."));
}

/// What is certain beside the mistakes, and what is none.
std::string certain_of(const diagnosis::Diagnosis& found) {
  std::string text;
  std::string right;
  if (found.certain.camera == diagnosis::Certainty::right) right += "The camera is right. ";
  if (found.certain.shadows == diagnosis::Certainty::right) right += "The shadows are right. ";
  if (found.certain.shading == diagnosis::Certainty::right) right += "The other shading is right. ";
  if (!right.empty()) text += html::paragraph(right);
  for (const diagnosis::Habit& habit : found.habits)
    text += html::paragraph(habit.title + " That is no mistake of a formula.");
  return text;
}

/// What was found, in one sentence.
std::string conclusion_of_diagnosis(const Diagnosed& d) {
  const diagnosis::Diagnosis& found = d.diagnosis;
  std::string summary = diagnosis::summary_of(found);
  if (found.verdict == diagnosis::PictureVerdict::right) return "The picture is right.";
  if (found.verdict == diagnosis::PictureVerdict::right_apart) return "The picture is " + summary + ".";
  if (found.verdict == diagnosis::PictureVerdict::unexplained)
    return "No set of known mistakes explains it: " + summary + ".";
  const std::size_t count = found.faults.size();
  const std::string explains =
      std::to_string(count) + (count == 1 ? " mistake explains " : " mistakes explain ");
  if (found.explains_all()) return explains + "it.";
  constexpr std::string_view of_a_part = "explains a part; ";  // which the sentence says itself
  if (summary.starts_with(of_a_part)) summary.erase(0, of_a_part.size());
  return explains + "a part of it: " + summary + ".";
}

}  // namespace

void write_diagnosis(const std::string& directory, const Diagnosed& d, int hint) {
  std::string body = html::paragraph(d.diagnosis.encoding.in_words(), "muted");
  if (!d.not_looked_at.empty()) body += html::paragraph("Not looked at: " + d.not_looked_at + ".");
  body += certain_of(d.diagnosis) + pictures_of(d);
  if (d.diagnosis.verdict == diagnosis::PictureVerdict::faults) {
    for (const diagnosis::FoundFault& found : d.diagnosis.faults) body += told(found, hint);
    for (const TellApart& group : d.tell_apart) body += hint == 3 ? settled_by(group) : "";
  }
  std::filesystem::create_directories(directory);
  refuse_to_replace_others(directory + "/diagnose.html");
  write_file(directory + "/diagnose.html",
             html::page({"Diagnosis of " + d.image, conclusion_of_diagnosis(d), body, ""}));
}

}  // namespace plumb::report
