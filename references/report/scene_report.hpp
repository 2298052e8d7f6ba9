// Writes the report of verify and regress: a page with every scene.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "references/gates/regress.hpp"
#include "references/report/report_writer.hpp"

namespace plumb::report {

/// Adds scenes one by one and writes DIRECTORY/index.html at the end. Without a directory it does nothing.
class SceneReport {
 public:
  SceneReport(const std::string& directory, const std::string& title, double tolerance);

  /// `options` are those of plumb explain with which the picture was made, each with a blank before it;
  /// nothing when plumb did not make it.
  void add(const gates::SceneResult& result, const std::optional<std::string>& options);
  /// `approve_command` makes the picture the baseline; empty when there is nothing to approve.
  void add(const gates::RegressedScene& scene, const std::optional<std::string>& options,
           const std::string& approve_command);
  /// Throws std::runtime_error when the directory cannot be written.
  void finish();

 private:
  void add(const gates::SceneResult& result, const std::string& message,
           const std::optional<std::string>& options, const std::string& approve_command);

  std::unique_ptr<ReportWriter> writer_;
  double tolerance_;
};

}  // namespace plumb::report
