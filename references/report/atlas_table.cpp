#include "references/report/atlas.hpp"

#include <array>
#include <cstdio>

namespace plumb::report {
namespace {

std::string line(const std::array<std::string, 7>& cells) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%-22s %-12s %9s %9s %9s %9s %9s\n", cells[0].c_str(),
                cells[1].c_str(), cells[2].c_str(), cells[3].c_str(), cells[4].c_str(), cells[5].c_str(),
                cells[6].c_str());
  return text.data();
}

}  // namespace

std::string value_text(const std::optional<double>& value) {
  std::array<char, 16> text{};
  if (value) std::snprintf(text.data(), text.size(), "%.1e", *value);
  return value ? text.data() : "-";
}

std::string table_of(const std::vector<studies::stability::Condition>& conditions) {
  std::string text;
  for (const studies::stability::Condition& condition : conditions) {
    text += condition.name + ": " + condition.unit + ", first value at which a ray fails\n";
    text += line({"method", "real", "missed", "16 ulp", "1e-6", "1 %", "itself"});
    for (const studies::stability::Row& row : condition.rows) {
      if (!row.unavailable.empty()) {
        text += row.method + ": not measured: " + row.unavailable + "\n";
        continue;
      }
      const studies::stability::Breaks& b = row.breaks;
      text += line({row.method, row.real, value_text(b.missed), value_text(b.ulp16), value_text(b.e6),
                    value_text(b.percent), value_text(b.self_shadow)});
    }
    text += "\n";
  }
  return text;
}

}  // namespace plumb::report
