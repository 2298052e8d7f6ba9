#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "references/cli/commands.hpp"
#include "references/cli/options.hpp"
#include "references/cli/own_inputs.hpp"
#include "tracer/system/leftovers.hpp"

namespace plumb::cli {
namespace {

int run(int argc, char** argv) {
  const Program plumb{
      "plumb tells whether a ray tracer is right: it renders a course scene, has POV-Ray render the same "
      "scene, and compares every pixel.",
      "plumb " PLUMB_VERSION,
      "Example: plumb verify tests/scenes/*.sdf\nExit codes: 0 agrees, 1 differs, 2 trouble.",
      all_commands()};
  const Request request = understood(plumb, argc, argv);
  if (request.command == nullptr) return request.exit_code;
  std::error_code no_directory;
  remove_leftovers(std::filesystem::temp_directory_path(no_directory).string());
  refuse_to_overwrite_inputs(request);
  return request.run();
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
