// Results as JUnit XML, which the continuous integration of GitHub, GitLab, Jenkins and others shows.
#pragma once

#include <string>
#include <vector>

namespace plumb::report {

struct JunitCase {
  enum class Outcome { passed, failed, error };  ///< failed: differs; error: could not be judged
  std::string name;
  Outcome outcome = Outcome::passed;
  std::string message;  ///< one line; empty when passed
  std::string details;  ///< any number of lines
  double seconds = 0;
  std::string output = {};  ///< what one that passed says; may be empty
};

/// Returns one suite in a <testsuites>, elements and attributes as in Jenkins' junit-10.xsd. Bytes that are
/// not UTF-8 and characters that XML 1.0 forbids (section 2.2) become U+FFFD.
std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases);

}  // namespace plumb::report
