#include "tracer/image/decoder/rest.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace plumb::decoder {
namespace {

namespace fs = std::filesystem;

/// True if the thread sleeps. Its state stands behind its name, which is in parentheses.
bool sleeps(const fs::path& task) {
  std::string text;
  std::getline(std::ifstream(task / "stat"), text);
  const std::size_t end = text.rfind(") ");
  return end == std::string::npos || text[end + 2] == 'S';
}

bool is_alone() {
  const fs::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks)) == 1;
}

bool others_rest() {
  const std::string own = std::to_string(::gettid());
  const fs::directory_iterator tasks("/proc/self/task");
  return std::all_of(begin(tasks), end(tasks), [&own](const fs::directory_entry& task) {
    return task.path().filename() == own || sleeps(task.path());
  });
}

}  // namespace

void wait_until_others_rest() {
  if (is_alone()) return;
  constexpr int looks = 500, pause_us = 2000;
  constexpr int in_a_row = 3;  // because one that starts may sleep for a moment on its way
  int rested = 0;
  for (int look = 0; look < looks && rested < in_a_row; ++look) {
    rested = others_rest() ? rested + 1 : 0;
    if (rested < in_a_row) ::usleep(pause_us);
  }
}

}  // namespace plumb::decoder
