#include "references/cli/diagnose_report.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "references/report/escape.hpp"
#include "references/report/own_page.hpp"
#include "references/teaching/pages.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::cli {
namespace {

namespace teaching = references::teaching;
using references::Fault;
using references::html_escaped;
using teaching::Picture;

Picture picture_with(const Diagnosed& d, const std::vector<const Fault*>& faults) {
  return teaching::picture_of(references::render_with(d.shot.scene, d.shot.camera, job_of(d.shot), faults),
                              d.diagnosis.encoding);
}

std::string pictures_of(const Diagnosed& d) {
  std::vector<const Fault*> faults;
  for (const references::FoundFault& found : d.diagnosis.faults) faults.push_back(found.fault);
  std::sort(faults.begin(), faults.end());
  const Picture seen = teaching::picture_of(d.seen);
  const Picture right = picture_with(d, {});
  std::string html =
      "<div class=pictures>" + teaching::figure(seen, "the picture that was handed over") +
      teaching::figure(right, "right") +
      teaching::figure(teaching::difference_of(seen, right), "where they differ, 4 times as bright") +
      "</div>";
  if (faults.empty()) return html;
  const Picture wrong = picture_with(d, faults);
  return html + "<div class=pictures>" + teaching::figure(seen, "the picture that was handed over") +
         teaching::figure(wrong, "ours with the mistakes below") +
         teaching::figure(teaching::difference_of(seen, wrong), "what remains, 4 times as bright") + "</div>";
}

std::string figures_of(const references::FoundFault& found) {
  char text[96];
  std::snprintf(text, sizeof text, "confidence %.2f, %zu pixels are right with it and not without",
                found.confidence, found.pixels);
  std::string words(text);
  if (!found.alike.empty())
    words += "; so many other mistakes give the same picture here: " + std::to_string(found.alike.size());
  return "<p class=muted>" + words + "</p>";
}

/// `hint` as on the terminal: 1 the slide, 2 the mistake, 3 formulas and pictures.
std::string told(const references::FoundFault& found, int hint) {
  const Fault& fault = *found.fault;
  if (hint == 1)
    return "<section><h3>Look at the slide &ldquo;" + html_escaped(fault.slide) + "&rdquo;</h3>" +
           figures_of(found) + "</section>";
  if (hint == 2)
    return "<section><h3>" + html_escaped(fault.explanation) + "</h3><p>Slide &ldquo;" +
           html_escaped(fault.slide) + "&rdquo;</p>" + figures_of(found) + "</section>";
  const std::string scenes = data_directory(Data::scenes);
  std::string html = teaching::section_of(fault, scenes, figures_of(found));
  for (const Fault* other : found.alike)
    html += "<p>It may be this instead, which gives the same picture here:</p>" +
            teaching::section_of(*other, scenes);
  return html;
}

std::string settled_by(const TellApart& group) {
  std::string html = "<section><h3>What this picture leaves open</h3><p>To tell";
  for (const Fault* fault : group.faults) html += " <code>" + html_escaped(fault->id) + "</code>";
  return html + " apart, " +
         (group.scene ? "render and diagnose <code>tests/scenes/" + html_escaped(*group.scene) + "</code>"
                      : "none of plumb's scenes helps") +
         ".</p></section>\n";
}

std::string verdict_of(const Diagnosed& d) {
  using references::PictureVerdict;
  const references::Diagnosis& found = d.diagnosis;
  const std::string encoding = "<p class=muted>" + html_escaped(found.encoding.in_words()) + "</p>";
  const std::string summary = html_escaped(references::summary_of(found));
  if (found.verdict == PictureVerdict::right) return "<p>The picture is right.</p>" + encoding;
  if (found.verdict == PictureVerdict::right_apart)
    return "<p>The picture is " + summary + ".</p>" + encoding;
  if (found.verdict == PictureVerdict::unexplained)
    return "<p>No set of known mistakes explains it: " + summary + ".</p>" + encoding;
  const std::size_t count = found.faults.size();
  return "<p>" + std::to_string(count) + (count == 1 ? " mistake explains " : " mistakes explain ") +
         (found.explains_all() ? "it" : "a part of it: " + summary) + ".</p>" + encoding;
}

}  // namespace

void write_diagnosis(const std::string& directory, const Diagnosed& d, int hint) {
  std::string html = verdict_of(d);
  if (!d.not_looked_at.empty()) html += "<p>Not looked at: " + html_escaped(d.not_looked_at) + ".</p>";
  html += pictures_of(d);
  if (d.diagnosis.verdict == references::PictureVerdict::faults) {
    for (const references::FoundFault& found : d.diagnosis.faults) html += told(found, hint);
    for (const TellApart& group : d.tell_apart) html += hint == 3 ? settled_by(group) : "";
  }
  std::filesystem::create_directories(directory);
  references::refuse_to_replace_others(directory + "/diagnose.html");
  write_file(directory + "/diagnose.html", teaching::page("What is wrong with " + d.image, html));
}

}  // namespace plumb::cli
