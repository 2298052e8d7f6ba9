// The process that decodes other people's files: it answers any number of threads, and is started again when
// somebody kills it.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

#include "tests/support/run.hpp"
#include "tracer/image/confined_decoder.hpp"
#include "tracer/image/decoded_message.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;

/// A BMP of 4 x 1 pixels of 24 bits, blue first, whose first pixel has this red.
std::string bitmap(unsigned char red) {
  std::string bytes = "BM";
  const auto put = [&bytes](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i);
  };
  put(54 + 12, 4), put(0, 4), put(54, 4);
  put(40, 4), put(4, 4), put(1, 4), put(1, 2), put(24, 2), put(0, 4), put(12, 4);
  for (int i = 0; i < 4; ++i) put(0, 4);
  return bytes + std::string(2, '\0') + static_cast<char>(red) + std::string(9, '\0');
}

int first_red(const std::string& path) {
  const PixelRows rows = open_image(path);
  EXPECT_TRUE(rows.is_bytes);
  return std::to_integer<int>(rows.row(0)[0]);
}

/// Of this process.
std::vector<pid_t> decoders() {
  std::vector<pid_t> found;
  for (const auto& task : fs::directory_iterator("/proc/self/task")) {
    std::ifstream children(task.path() / "children");
    for (pid_t child = 0; children >> child;) {
      std::string name;
      std::getline(std::ifstream("/proc/" + std::to_string(child) + "/comm"), name);
      if (name == decoder_name) found.push_back(child);
    }
  }
  return found;
}

TEST(ConfinedDecoder, AnswersEachThreadWithItsOwnFile) {
  const Workplace place;
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&place, thread] {
      for (int i = 0; i < 6; ++i) {
        const int red = thread * 6 + i;
        const std::string whole = bitmap(static_cast<unsigned char>(red));
        const std::string name = std::to_string(red);
        EXPECT_EQ(first_red(place.file(name + ".bmp", whole)), red);
        EXPECT_THROW(open_image(place.file(name + "cut.bmp", whole.substr(0, 40))), std::runtime_error);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(decoders().size(), 1U);
}

TEST(ConfinedDecoder, IsStartedAgainWhenItWasKilled) {
  const Workplace place;
  const std::string path = place.file("a.bmp", bitmap(7));
  EXPECT_EQ(first_red(path), 7);
  const std::vector<pid_t> before = decoders();
  ASSERT_EQ(before.size(), 1U);
  kill(before[0], SIGKILL);
  siginfo_t ended{};
  waitid(P_PID, static_cast<id_t>(before[0]), &ended, WEXITED | WNOWAIT);
  EXPECT_EQ(first_red(path), 7);
  EXPECT_NE(decoders(), before);
}

TEST(ConfinedDecoder, HoldsNoFileOfOurs) {
  const Workplace place;
  const std::string ours = place.file("ours.txt", "secret");
  const Descriptor inherited(::open(ours.c_str(), O_RDWR));  // stays open in programs that are started
  ASSERT_GE(inherited.number(), 0);
  for (const pid_t before : decoders()) {
    kill(before, SIGKILL);
    siginfo_t ended{};
    waitid(P_PID, static_cast<id_t>(before), &ended, WEXITED | WNOWAIT);
  }
  EXPECT_EQ(first_red(place.file("a.bmp", bitmap(7))), 7);
  const std::vector<pid_t> now = decoders();
  ASSERT_EQ(now.size(), 1U);
  std::vector<std::string> held;
  for (const auto& file : fs::directory_iterator("/proc/" + std::to_string(now[0]) + "/fd"))
    held.push_back(fs::read_symlink(file.path()));
  ASSERT_GE(held.size(), 3U);
  EXPECT_EQ(std::count(held.begin(), held.end(), ours), 0);
  EXPECT_EQ(fs::read_symlink("/proc/" + std::to_string(now[0]) + "/fd/1"), "/dev/null");
}

TEST(ReadToEnd, EndsWithTheLastWriterOrInTime) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const Descriptor from(ends[0]);
  auto to = std::make_unique<Descriptor>(ends[1]);
  ASSERT_EQ(::write(to->number(), "ab", 2), 2);
  try {
    read_to_end(from.number(), std::chrono::milliseconds(20));
    ADD_FAILURE() << "somebody may still write";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code().value(), ETIMEDOUT);
  }
  ASSERT_EQ(::write(to->number(), "cd", 2), 2);
  to.reset();
  EXPECT_EQ(read_to_end(from.number(), std::chrono::seconds(10)), "cd");
}

}  // namespace
}  // namespace plumb::tests
