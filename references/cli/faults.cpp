#include <algorithm>
#include <cstdio>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/report.hpp"
#include "references/faults/fault.hpp"
#include "tracer/scene/lexer.hpp"

namespace plumb::cli {
namespace {

Json to_json(const references::Fault& fault) {
  return {{"id", fault.id},
          {"catalogue", fault.catalogue},
          {"slide", fault.slide},
          {"title", fault.explanation},
          {"wrong", fault.wrong},
          {"right", fault.right},
          {"how_common", fault.how_common},
          {"scene", fault.shown_by}};
}

void print(const references::Fault& fault) {
  std::printf("%.*s (%d, %.*s; %.*s)\n    %.*s\n    wrong: %.*s\n    right: %.*s\n",
              static_cast<int>(fault.id.size()), fault.id.data(), fault.catalogue,
              static_cast<int>(fault.slide.size()), fault.slide.data(),
              static_cast<int>(fault.how_common.size()), fault.how_common.data(),
              static_cast<int>(fault.explanation.size()), fault.explanation.data(),
              static_cast<int>(fault.wrong.size()), fault.wrong.data(), static_cast<int>(fault.right.size()),
              fault.right.data());
}

int run_faults(const std::string& json) {
  Json all = Json::array();
  for (const references::Fault& fault : references::fault_catalogue()) {
    if (json != "-") print(fault);
    all.push_back(to_json(fault));
  }
  if (!json.empty()) write_json(json, {{"tool", "plumb"}, {"version", PLUMB_VERSION}, {"faults", all}});
  return exit_agrees;
}

}  // namespace

std::vector<const references::Fault*> faults_named(const std::string& ids) {
  std::vector<const references::Fault*> faults;
  for (std::size_t begin = 0; begin <= ids.size();) {
    const std::size_t end = std::min(ids.find(',', begin), ids.size());
    const std::string id = ids.substr(begin, end - begin);
    const references::Fault* fault = references::find_fault(id);
    if (fault == nullptr) {
      std::vector<std::string_view> known;
      for (const references::Fault& f : references::fault_catalogue()) known.push_back(f.id);
      const auto near = nearest_name(id, known);
      throw std::invalid_argument("--fault: found " + in_quotes(id) +
                                  ", expected an id that plumb faults lists" +
                                  (near ? "; did you mean " + *near + "?" : ""));
    }
    if (std::find(faults.begin(), faults.end(), fault) == faults.end()) faults.push_back(fault);
    begin = end + 1;
  }
  // In the order of the catalogue, so that a set has one picture however it is written.
  std::sort(faults.begin(), faults.end());
  return faults;
}

Command add_faults(CLI::App& plumb) {
  CLI::App* app = plumb.add_subcommand(
      "faults", "List the mistakes that real ray tracers contain, each with the formula that it gets wrong.");
  auto json = std::make_shared<std::string>();
  app->add_option("--json", *json, "write the list as JSON; - is standard output")->type_name("FILE");
  app->footer(
      "Example: plumb faults --json faults.json\nThe number is that of the catalogue's entry; then the "
      "slide, and "
      "how many of the tracers whose source was read have it.\nExit code: 0.");
  return {app, [json] { return run_faults(*json); }};
}

}  // namespace plumb::cli
