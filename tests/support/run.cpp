#include "tests/support/run.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "tracer/system/installation.hpp"

namespace plumb::tests {
namespace {

constexpr unsigned longest_run_seconds = 120;

[[noreturn]] void become(const std::vector<std::string>& arguments, const std::string& directory,
                         const std::vector<std::string>& environment) {
  const auto redirect = [&](const char* name, int to) {
    const int file = open((directory + "/" + name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, to);
  };
  redirect(".out", 1);
  redirect(".err", 2);
  if (chdir(directory.c_str()) != 0) _exit(126);
  setenv("PLUMB_CACHE", (directory + "/.cache").c_str(), 1);
  setenv("LSAN_OPTIONS", leak_options().c_str(), 1);
  for (const std::string& pair : environment) putenv(const_cast<char*>(pair.c_str()));
  std::vector<char*> pointers{const_cast<char*>(PLUMB_BINARY)};
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  alarm(longest_run_seconds);
  execv(PLUMB_BINARY, pointers.data());
  _exit(127);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

Outcome run_plumb(const std::vector<std::string>& arguments, const std::string& directory,
                  const std::vector<std::string>& environment) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) become(arguments, directory, environment);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                  read_file(directory + "/.out"), read_file(directory + "/.err"),
                  seconds(usage.ru_utime) + seconds(usage.ru_stime)};
  return outcome;
}

std::string Workplace::file(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

std::string leak_options() { return "suppressions=" + source_path("tests/support/leaks_of_others.txt"); }

std::string source_path(const std::string& relative) { return source_directory() + "/" + relative; }

}  // namespace plumb::tests
