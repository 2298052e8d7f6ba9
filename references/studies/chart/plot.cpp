#include "references/studies/chart/plot.hpp"

#include <filesystem>
#include <stdexcept>

#include "references/system/process.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/installation.hpp"

namespace plumb::studies {
namespace {

/// Runs plot.py in a directory; what it says when it fails is the message.
void run_plot(std::vector<std::string> command, const std::vector<std::string>& arguments,
              const std::string& directory) {
  const std::string python = command.front();
  command.insert(command.end(), {"-B", data_directory(Data::chart) + "/plot.py"});
  command.insert(command.end(), arguments.begin(), arguments.end());
  system::ProcessLimits limits;
  limits.seconds = 120;
  const system::ProcessResult result = system::run_process(command, directory, limits);
  if (!result.timed_out && result.signal == 0 && result.exit_code == 0) return;
  constexpr int not_started = 127;
  if (result.exit_code == not_started)
    throw std::runtime_error(python + ": cannot be started; install it (apt-get install python3-matplotlib)");
  if (result.timed_out) throw std::runtime_error("plot.py took longer than 120 s");
  throw std::runtime_error("plot.py cannot draw the chart: " + result.output);
}

}  // namespace

void check_plotting(const std::vector<std::string>& python) {
  const system::TemporaryDirectory directory;
  run_plot(python, {"--check"}, directory.path());
}

void plot_chart(const std::string& json, const std::vector<std::string>& files,
                const std::vector<std::string>& python) {
  const system::TemporaryDirectory directory;
  write_file(directory.path() + "/chart.json", json);
  std::vector<std::string> arguments{"chart.json"};
  for (const std::string& file : files)
    arguments.push_back("chart" + std::filesystem::path(file).extension().string());
  run_plot(python, arguments, directory.path());
  for (std::size_t i = 0; i < files.size(); ++i)
    write_file(files[i], read_file(directory.path() + "/" + arguments[i + 1]));
}

}  // namespace plumb::studies
