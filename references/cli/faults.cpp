#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/progress.hpp"
#include "references/faults/fault.hpp"
#include "references/report/fault_pages.hpp"
#include "references/report/faults_json.hpp"
#include "references/report/html/own_page.hpp"
#include "references/report/results_json.hpp"
#include "references/teaching/document.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"
#include "tracer/text/words.hpp"

namespace plumb::cli {
namespace {

using Json = nlohmann::ordered_json;

void print(const faults::Fault& fault) {
  std::printf("%.*s (%d, %.*s; %.*s)\n    %.*s\n    wrong: %.*s\n    right: %.*s\n",
              static_cast<int>(fault.id.size()), fault.id.data(), fault.catalogue,
              static_cast<int>(fault.slide.size()), fault.slide.data(),
              static_cast<int>(fault.how_common.size()), fault.how_common.data(),
              static_cast<int>(fault.explanation.size()), fault.explanation.data(),
              static_cast<int>(fault.wrong.size()), fault.wrong.data(), static_cast<int>(fault.right.size()),
              fault.right.data());
}

struct Options {
  std::string json;
  std::string corpus;
  std::string report;
};

void write_pages(const std::string& directory) {
  Progress progress("pictures of faults");
  const std::string page =
      report::faults_page(data_directory(Data::scenes), [&](double fraction) { progress.show(fraction); });
  std::filesystem::create_directories(directory);
  report::refuse_to_replace_others(directory + "/index.html");
  write_file(directory + "/index.html", page);
}

int run_faults(const Options& options) {
  Json json = report::faults_json();
  if (!options.corpus.empty()) {
    Progress progress("faults in scenes");
    const teaching::Matrix matrix(teaching::lessons_in(options.corpus),
                                  [&](double fraction) { progress.show(fraction); });
    const teaching::TeachingSet set = teaching::teaching_set(matrix);
    progress.clear();
    if (options.json != "-") std::fputs(teaching::markdown_of(matrix, set).c_str(), stdout);
    json["corpus"] = report::corpus_json(matrix, set);
  } else if (options.json != "-" && options.report.empty()) {
    for (const faults::Fault& fault : faults::fault_catalogue()) print(fault);
  }
  if (!options.json.empty()) report::write_json(options.json, json);
  if (!options.report.empty()) {
    write_pages(options.report);
    if (options.json != "-") say_report(options.report);
  }
  return exit_agrees;
}

}  // namespace

std::vector<const faults::Fault*> faults_named(const std::string& ids) {
  std::vector<const faults::Fault*> faults;
  for (std::size_t begin = 0; begin <= ids.size();) {
    const std::size_t end = std::min(ids.find(',', begin), ids.size());
    const std::string id = ids.substr(begin, end - begin);
    const faults::Fault* fault = faults::find_fault(id);
    if (fault == nullptr) {
      std::vector<std::string_view> known;
      for (const faults::Fault& f : faults::fault_catalogue()) known.push_back(f.id);
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

Command faults_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "faults",
      .purpose = "List the mistakes that real ray tracers contain, each with the formula that it gets wrong.",
      .footer =
          "Example: plumb faults --corpus tests/scenes > tests/scenes/TEACHING.md\n"
          "The number is that of the catalogue's entry; then the slide, and how many of the tracers whose "
          "source was read have it.\nExit codes: 0 done, 2 trouble.",
      .options = {output_option("--json", options->json, "write the list as JSON"),
                  {"--corpus",
                   &options->corpus,
                   "print which scenes of this directory show which fault, and the fewest that tell all "
                   "apart",
                   {.value = "DIR"}},
                  {"--report",
                   &options->report,
                   "write a page with both formulas and a pair of pictures for each fault",
                   {.value = "DIR"}}},
      .run = [options](auto&) { return run_faults(*options); }};
}

}  // namespace plumb::cli
