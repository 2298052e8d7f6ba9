#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

#include "references/cli/commands.hpp"
#include "references/cli/manual.hpp"
#include "references/cli/options.hpp"
#include "references/cli/own_inputs.hpp"
#include "references/cli/slips.hpp"
#include "tracer/system/leftovers.hpp"

namespace plumb::cli {
namespace {

int run(int argc, char** argv) {
  CLI::App app(
      "plumb tells whether a ray tracer is right: it renders a course scene, has POV-Ray render the same "
      "scene, and compares every pixel.");
  app.set_version_flag("--version", "plumb " PLUMB_VERSION);
  app.require_subcommand(0, 1);  // so that an unknown word is named
  app.footer("Example: plumb verify tests/scenes/*.sdf\nExit codes: 0 agrees, 1 differs, 2 trouble.");
  const std::vector<Command> commands{
      add_render(app), add_export(app),     add_verify(app),   add_compare(app), add_explain(app),
      add_lint(app),   add_references(app), add_regress(app),  add_needs(app),   add_stability(app),
      add_chart(app),  add_faults(app),     add_diagnose(app), add_judge(app),   add_manual(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    if (code != 0 && !likely_slip(app).empty()) std::fprintf(stderr, "%s\n", likely_slip(app).c_str());
    return code == 0 ? exit_agrees : exit_trouble;
  }
  std::error_code no_directory;
  remove_leftovers(std::filesystem::temp_directory_path(no_directory).string());
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    refuse_to_overwrite_inputs(*command.app);
    return command.run();
  }
  std::fputs(app.help().c_str(), stderr);
  return exit_trouble;
}

}  // namespace
}  // namespace plumb::cli

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file too large is then an error of write(), with a message
  try {
    const int code = plumb::cli::run(argc, argv);
    plumb::cli::flush_output();
    return code;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "out of memory; choose a smaller size\n");
    return plumb::cli::exit_trouble;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return plumb::cli::exit_trouble;
  }
}
