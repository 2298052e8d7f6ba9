#include "references/report/class_report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "references/report/junit.hpp"

namespace plumb::report {
namespace {

/// What a spreadsheet evaluates begins with one of these (OWASP, "CSV Injection").
std::string csv_cell(std::string text) {
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos)
    text.insert(0, "'");
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + "\"";
}

std::string fault_list(const submissions::JudgedPicture& picture, HintLevel hint) {
  std::string list;
  if (!picture.diagnosis || picture.verdict != submissions::Judged::faults) return list;
  for (const diagnosis::FoundFault& found : picture.diagnosis->faults)
    list += (list.empty() ? "" : "; ") + found_in_words(found, hint);
  return list;
}

}  // namespace

std::string named(const faults::Fault& fault, HintLevel hint) {
  if (hint == 1) return "slide " + std::string(fault.slide);
  if (hint == 2) return std::string(fault.explanation);
  return std::string(fault.id) + ": " + std::string(fault.explanation);
}

std::string found_in_words(const diagnosis::FoundFault& found, HintLevel hint) {
  constexpr std::size_t most_named = 3;
  const std::size_t others = found.alike.size();
  std::string text = named(*found.fault, hint);
  if (others > 0 && hint < 3)
    text +=
        " (or " + std::to_string(others) + (others == 1 ? " other" : " others") + ": the same picture here)";
  if (others > 0 && hint >= 3) {
    text += " (or ";
    for (std::size_t i = 0; i < std::min(most_named, others); ++i)
      text += (i == 0 ? "" : ", ") + std::string(found.alike[i]->id);
    if (others > most_named) text += " or any of " + std::to_string(others - most_named) + " more";
    text += ": the same picture here)";
  }
  std::array<char, 32> confidence{};
  std::snprintf(confidence.data(), confidence.size(), " [confidence %.2f]", found.confidence);
  return text + confidence.data();
}

std::size_t judged_count(const std::vector<submissions::JudgedPicture>& all) {
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(),
      [](const submissions::JudgedPicture& p) { return p.verdict != submissions::Judged::not_judged; }));
}

std::string overview_csv(const std::vector<submissions::JudgedPicture>& all, HintLevel hint) {
  std::string csv = "submission,scene,verdict,faults,message,wall_seconds\r\n";
  for (const submissions::JudgedPicture& picture : all) {
    csv += csv_cell(picture.submission) + "," + csv_cell(picture.scene) + "," +
           submissions::to_string(picture.verdict) + "," + csv_cell(fault_list(picture, hint)) + "," +
           csv_cell(picture.message) + "," + std::to_string(picture.wall_seconds) + "\r\n";
  }
  return csv;
}

std::string overview_junit(const std::vector<submissions::JudgedPicture>& all, HintLevel hint) {
  std::vector<JunitCase> cases;
  for (const submissions::JudgedPicture& picture : all) {
    JunitCase one;
    one.name = picture.submission + "/" + picture.scene;
    one.seconds = picture.wall_seconds;
    if (picture.verdict == submissions::Judged::right) {
      one.output = picture.message;
    } else {
      const bool says_nothing = picture.verdict == submissions::Judged::trouble ||
                                picture.verdict == submissions::Judged::not_judged;
      one.outcome = says_nothing ? JunitCase::Outcome::error : JunitCase::Outcome::failed;
      const std::string faults = fault_list(picture, hint);
      const std::string why =
          picture.message + (picture.message.empty() || faults.empty() ? "" : "; ") + faults;
      one.message = std::string(submissions::to_string(picture.verdict)) + (why.empty() ? "" : ": " + why);
      one.details = picture.printed;
    }
    cases.push_back(one);
  }
  return junit_xml("plumb judge", cases);
}

}  // namespace plumb::report
