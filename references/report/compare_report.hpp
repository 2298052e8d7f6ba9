// Writes the report of image files that were compared.
#pragma once

#include <string>

#include "references/gates/findings.hpp"
#include "references/report/report_writer.hpp"
#include "references/report/results_json.hpp"

namespace plumb::report {

class CompareReport {
 public:
  /// All functions throw std::runtime_error when the directory cannot be written.
  CompareReport(const std::string& directory, const std::string& title, const std::string& subtitle);

  /// Gives the rows of the findings back; `result` is what --json says. One channel is shown as grey, alpha
  /// is dropped: returns what the page does not show; empty when it shows all.
  std::string add(const std::string& name, gates::Findings&& findings, const Json& result);
  /// A pair that could not be compared.
  void add_trouble(const std::string& name, const Json& result);
  void finish() { writer_.finish(); }

 private:
  ReportWriter writer_;
};

}  // namespace plumb::report
