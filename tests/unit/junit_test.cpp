// JUnit XML of hostile text, read back by Python's parser.
#include "references/report/junit.hpp"

#include <nlohmann/json.hpp>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using Json = nlohmann::json;
using report::JunitCase;
using Outcome = JunitCase::Outcome;

/// [tag, attributes, text, children] of the top element; not accepted by Json::parse when it is no XML.
Json parsed(const std::string& xml) {
  const Workplace workplace;
  workplace.file("junit.xml", xml);
  workplace.file("read.py",
                 "import json, xml.etree.ElementTree as tree\n"
                 "def element(e): return [e.tag, e.attrib, e.text or '', [element(c) for c in e]]\n"
                 "print(json.dumps(element(tree.parse('junit.xml').getroot())))\n");
  const auto result = run_shell("python3 read.py", workplace.directory());
  EXPECT_EQ(result.exit_code, 0) << result.output << xml;
  return Json::parse(result.output);
}

const Json& attribute(const Json& element, const char* name) { return element.at(1).at(name); }

TEST(Junit, CountsEachOutcomeInBothHeads) {
  const Json suites = parsed(report::junit_xml("scenes", {{"a", Outcome::passed, "", "", 0.25},
                                                          {"b", Outcome::failed, "m", "d", 0.5},
                                                          {"c", Outcome::failed, "m", "d", 0},
                                                          {"d", Outcome::error, "m", "d", 1}}));
  EXPECT_EQ(suites.at(0), "testsuites");
  const Json& suite = suites.at(3).at(0);
  EXPECT_EQ(suite.at(0), "testsuite");
  EXPECT_EQ(attribute(suite, "name"), "scenes");
  for (const Json* const head : {&suites, &suite}) {
    EXPECT_EQ(attribute(*head, "tests"), "4");
    EXPECT_EQ(attribute(*head, "failures"), "2");
    EXPECT_EQ(attribute(*head, "errors"), "1");
    EXPECT_EQ(attribute(*head, "time"), "1.750000");
  }
  ASSERT_EQ(suite.at(3).size(), 4U);
  EXPECT_EQ(attribute(suite.at(3).at(0), "time"), "0.250000");
  EXPECT_TRUE(suite.at(3).at(0).at(3).empty());
  EXPECT_EQ(suite.at(3).at(1).at(3).at(0).at(0), "failure");
  EXPECT_EQ(suite.at(3).at(3).at(3).at(0).at(0), "error");
}

TEST(Junit, HostileTextComesBackAsItWas) {
  const std::string hostile = "<a b=\"c\"> & 'd' ]]> --> &amp; \t \r\n \xC3\xA4 \xF0\x9F\x8E\xB1\n end";
  const Json suites = parsed(report::junit_xml(hostile, {{hostile, Outcome::failed, hostile, hostile, 0}}));
  const Json& test = suites.at(3).at(0).at(3).at(0);
  EXPECT_EQ(attribute(test, "name"), hostile);
  EXPECT_EQ(attribute(test, "classname"), hostile);
  EXPECT_EQ(attribute(test.at(3).at(0), "message"), hostile);
  EXPECT_EQ(test.at(3).at(0).at(2), hostile);
}

/// XML 1.0, section 2.2, and bytes that are no UTF-8: Latin-1, a surrogate, a cut-off sequence.
TEST(Junit, WhatXmlForbidsIsReplaced) {
  const std::string replacement = "\xEF\xBF\xBD";
  std::string controls;
  for (char c = 0; c < ' '; ++c) {
    if (c != '\t' && c != '\n' && c != '\r') controls += c;
  }
  for (const std::string& forbidden : {controls, std::string("\xEF\xBF\xBE\xEF\xBF\xBF"), std::string("\xE4"),
                                       std::string("\xED\xA0\x80"), std::string("\xC3")}) {
    const Json suites =
        parsed(report::junit_xml("s", {{"x" + forbidden + "y", Outcome::error, "", forbidden, 0}}));
    const std::string name = attribute(suites.at(3).at(0).at(3).at(0), "name");
    EXPECT_TRUE(name.starts_with("x" + replacement)) << name;
    EXPECT_TRUE(name.ends_with("y")) << name;
  }
}

}  // namespace
}  // namespace plumb::tests
