// Commands without a shell, files that are taken safely, tables that a name cannot break.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "references/report/class_report.hpp"
#include "references/submissions/collect.hpp"
#include "references/submissions/command_line.hpp"
#include "references/submissions/sandbox/process_tree.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using submissions::Found;
using Words = std::vector<std::string>;

TEST(SplitCommand, HonoursQuotesAndKnowsNothingOfShells) {
  EXPECT_EQ(submissions::split_command("a  'b c' \"d \\\" e\" f\\ g ''"),
            (Words{"a", "b c", "d \" e", "f g", ""}));
  EXPECT_EQ(submissions::split_command("a $HOME *;|&"), (Words{"a", "$HOME", "*;|&"}));
  EXPECT_EQ(submissions::split_command("a 'b'\"c\"d"), (Words{"a", "bcd"}));
}

TEST(SplitCommand, RefusesAnOpenQuoteAndNoProgram) {
  for (const char* const bad : {"", "  ", "a 'b", "a \"b", "''"})
    EXPECT_THROW(submissions::split_command(bad), std::invalid_argument) << bad;
}

TEST(Substituted, ReplacesWithinArgumentsOnce) {
  EXPECT_EQ(submissions::substituted({"--in={scene}", "{image}", "{other}", "{"},
                                     {{"scene", "{image}"}, {"image", "i"}}),
            (Words{"--in={image}", "i", "{other}", "{"}));
}

Found take(const Workplace& workplace, const std::string& name) {
  return submissions::take_file(workplace.path("in"), name, 10, workplace.path("taken"));
}

TEST(TakeFile, TakesRegularFilesAlone) {
  const Workplace workplace;
  std::filesystem::create_directories(workplace.path("in/d"));
  workplace.file("secret", "secret");
  workplace.file("in/a", "picture");
  workplace.file("in/d/b", "deep");
  workplace.file("in/large", std::string(11, 'x'));
  std::filesystem::create_symlink(workplace.path("secret"), workplace.path("in/link"));
  std::filesystem::create_symlink(workplace.directory(), workplace.path("in/up"));
  ASSERT_EQ(mkfifo(workplace.path("in/pipe").c_str(), 0600), 0);
  EXPECT_EQ(take(workplace, "large"), Found::too_large);
  EXPECT_EQ(take(workplace, "link"), Found::not_a_file);
  EXPECT_EQ(take(workplace, "up/secret"), Found::not_a_file);
  EXPECT_EQ(take(workplace, "pipe"), Found::not_a_file);
  EXPECT_EQ(take(workplace, "d"), Found::not_a_file);
  EXPECT_EQ(take(workplace, "../secret"), Found::nothing);
  EXPECT_EQ(take(workplace, workplace.path("secret")), Found::nothing);
  EXPECT_EQ(take(workplace, "none"), Found::nothing);
  EXPECT_FALSE(std::filesystem::exists(workplace.path("taken")));
  EXPECT_EQ(take(workplace, "d/b"), Found::picture);
  EXPECT_EQ(read_file(workplace.path("taken")), "deep");
}

submissions::JudgedPicture hostile() {
  submissions::JudgedPicture picture;
  picture.submission = "=cmd()\"<script>alert(1)</script>";
  picture.scene = "a\"><b>";
  picture.verdict = submissions::Judged::crashed;
  picture.message = "@SUM(1)";
  picture.printed = "<img src=x onerror=alert(1)>\x01";
  return picture;
}

TEST(Overview, ANameIsNeverAFormulaNorMarkup) {
  const std::string csv = report::overview_csv({hostile()}, 3);
  EXPECT_TRUE(
      contains(csv, "\"'=cmd()\"\"<script>alert(1)</script>\",\"a\"\"><b>\",crashed,\"\",\"'@SUM(1)\""))
      << csv;
  const Workplace workplace;
  report::write_overview(workplace.path("report"), {hostile()}, 3);
  for (const char* const name : {"report/index.html", "report/submission-1.html"}) {
    const std::string page = read_file(workplace.path(name));
    for (const char* const bad : {"<script", "<img", "\"><b>"}) EXPECT_FALSE(contains(page, bad)) << name;
    EXPECT_TRUE(contains(page, "&lt;script&gt;")) << name;
  }
  EXPECT_FALSE(contains(report::overview_junit({hostile()}, 3), "<script"));
}

TEST(ProcessTree, CountsThoseBelow) {
  const std::size_t before = submissions::usage_below(getpid()).processes;
  const pid_t child = fork();
  if (child == 0) {
    pause();
    _exit(0);
  }
  EXPECT_EQ(submissions::usage_below(getpid()).processes, before + 1);
  kill(child, SIGKILL);
}

void compute() {
  for (volatile bool is_endless = true; is_endless;) {
  }
}

/// Whether a child is runnable while it does this.
bool is_runnable_while(void (*does)()) {
  const pid_t child = fork();
  if (child == 0) {
    does();
    _exit(0);
  }
  usleep(300'000);
  const bool is_runnable = submissions::is_any_runnable(submissions::usage_below(getpid()).members);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return is_runnable;
}

TEST(ProcessTree, KnowsWhoWantsACore) {
  EXPECT_FALSE(is_runnable_while([] { pause(); }));
  EXPECT_TRUE(is_runnable_while(&compute));
  EXPECT_TRUE(is_runnable_while([] { std::thread(&compute).join(); })) << "its first thread waits";
}

}  // namespace
}  // namespace plumb::tests
