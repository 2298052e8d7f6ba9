// What a confined program sees: each place as it is asked for, however the places lie in each other, and the
// sandbox's own failure is never the program's.
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>
#include <random>
#include <set>
#include <sstream>

#include "references/submissions/sandbox/control_group.hpp"
#include "references/submissions/sandbox/sandbox.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using submissions::Ending;
using submissions::run_confined;
using submissions::SandboxLimits;
using submissions::SandboxRun;
using submissions::SandboxView;

class SandboxPlaces : public testing::Test {
 protected:
  void SetUp() override { submissions::require_sandbox(); }

  std::string made(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(workplace_.path(name)).parent_path());
    const std::string path = workplace_.file(name, text);
    fs::permissions(path, fs::perms(0755));
    return path;
  }
  static SandboxRun shell(const std::string& text, const SandboxView& view,
                          const SandboxLimits& limits = {}) {
    return run_confined({"/bin/sh", "-c", text}, view, limits);
  }
  Workplace workplace_;
};

/// The deepest place around a file says whether it is seen; hidden counts where both are asked for.
bool is_seen(const fs::path& file, const std::set<std::string>& readable,
             const std::set<std::string>& hidden) {
  for (fs::path at = file.parent_path(); at != "/"; at = at.parent_path()) {
    if (hidden.contains(at.string())) return false;
    if (readable.contains(at.string())) return true;
  }
  return false;
}

TEST_F(SandboxPlaces, AnyPlacesWithinEachOther) {
  std::vector<std::string> directories{workplace_.path("t")};
  for (std::size_t i = 0; i < 13; ++i)
    for (const char* const name : {"/a", "/b=c", "/d e"}) directories.push_back(directories[i] + name);
  for (const std::string& directory : directories) {
    fs::create_directories(directory);
    workplace_.file(fs::path(directory + "/f").lexically_relative(workplace_.directory()).string(), "x");
  }
  std::mt19937 random(1);
  for (int round = 0; round < 12; ++round) {
    std::set<std::string> readable, hidden, expected, found;
    for (int i = 0; i < 6; ++i) readable.insert(directories[random() % directories.size()]);
    for (int i = 0; i < 6; ++i) hidden.insert(directories[random() % directories.size()]);
    SandboxView view{{}, {readable.begin(), readable.end()}, {hidden.begin(), hidden.end()}};
    std::shuffle(view.readable.begin(), view.readable.end(), random);
    view.readable.push_back(view.readable.front() + "/");
    view.hidden.push_back(view.hidden.front() + "/./");
    for (const std::string& directory : directories)
      if (is_seen(directory + "/f", readable, hidden)) expected.insert(directory + "/f");
    std::istringstream lines(shell("find '" + directories[0] + "' -name f", view).printed);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("/")) found.insert(line);
    EXPECT_EQ(found, expected) << "round " << round;
  }
}

TEST_F(SandboxPlaces, LinksLeadWhereTheyLeadOutside) {
  made("real/deep/program", "#!/bin/sh\necho \"ran $0\"\n");
  fs::create_symlink("real", workplace_.path("relative"));
  fs::create_symlink(workplace_.path("relative/deep"), workplace_.path("absolute"));
  fs::create_symlink("loop", workplace_.path("loop"));
  for (const char* const name : {"absolute/program", "relative/deep/program", "absolute/../deep/program"}) {
    const std::string program = workplace_.path(name);
    EXPECT_EQ(run_confined({program}, {{}, {program}, {}}, {}).printed, "ran " + program + "\n");
  }
  EXPECT_EQ(shell("echo ran", {{}, {workplace_.path("loop"), workplace_.path("none")}, {}}).printed, "ran\n");
}

/// Root's programs become somebody else, for whom the directories that mktemp makes are closed.
TEST_F(SandboxPlaces, ClosedDirectoriesAreOpenToTheirPrograms) {
  const std::string program =
      made("closed/own/program", "#!/bin/sh\ncat \"$(dirname \"$0\")/../link\" && echo seen; echo ran\n");
  workplace_.file("secret", "the secret\n");
  fs::create_symlink(workplace_.path("secret"), workplace_.path("closed/link"));
  for (const char* const name : {"closed", "closed/own"})
    fs::permissions(workplace_.path(name), fs::perms(0700));
  const SandboxRun run = run_confined({program}, {{}, {workplace_.path("closed")}, {}}, {});
  EXPECT_TRUE(run.printed.ends_with("ran\n")) << run.printed;
  EXPECT_FALSE(contains(run.printed, "seen")) << run.printed;
  EXPECT_TRUE(shell("ls '" + workplace_.path("closed") + "'", {{}, {workplace_.directory()}, {}}).printed ==
              "link\nown\n");
}

TEST_F(SandboxPlaces, AnyCharactersInPaths) {
  for (const char* const name : {"A=B/c=d", "a b/'c\"", "\xc3\xa9/\xff", "a\nb/c\n", "$(x)/`y`", "-x/--"}) {
    const std::string program = made(name, "#!/bin/sh\necho ran; echo picture > out.ppm\n");
    const SandboxRun run = run_confined({program}, {{}, {fs::path(program).parent_path()}, {}}, {});
    EXPECT_EQ(run.printed, "ran\n") << name;
    EXPECT_EQ(read_file(run.directory() + "/out.ppm"), "picture\n") << name;
  }
}

TEST_F(SandboxPlaces, ThePlacesThatPeopleUse) {
  if (geteuid() != 0) GTEST_SKIP() << "only root may make directories there";
  for (const char* const top : {"/home", "/root", "/srv", "/opt", "/var/tmp", "/tmp", "/mnt", "/var/lib"}) {
    if (!fs::is_directory(top)) continue;
    const system::TemporaryDirectory directory{std::string(top)};
    fs::permissions(directory.path(), fs::perms(0755));
    const std::string program = directory.path() + "/program";
    write_file(program, "#!/bin/sh\necho ran\n");
    fs::permissions(program, fs::perms(0755));
    EXPECT_EQ(run_confined({program}, {{}, {program}, {}}, {}).printed, "ran\n") << top;
    EXPECT_NE(shell("ls '" + directory.path() + "'", {}).exit_code, 0) << top;
  }
}

TEST_F(SandboxPlaces, WhatCannotBeShownIsTrouble) {
  EXPECT_THROW(run_confined({"/bin/true"}, {{}, {"/tmp"}, {}}, {}), std::runtime_error);
  EXPECT_THROW(run_confined({"/bin/true"}, {{}, {"/tmp/judged/"}, {}}, {}), std::runtime_error);
  try {
    submissions::require_sandbox({{}, {workplace_.path("none")}, {}}, workplace_.path("none"));
    ADD_FAILURE() << "a program that is not there was found";
  } catch (const std::runtime_error& error) {
    expect_own_words(error.what(), {workplace_.path("none"), "--readable"});
  }
}

TEST_F(SandboxPlaces, AProgramThatIsNotExecutedSaysWhy) {
  const std::string text = workplace_.file("text", "#!/bin/sh\n");
  const std::string lost = made("lost", "#!/no/such/interpreter\n");
  const std::string none = workplace_.path("none");
  const auto why = [](const std::string& program) {
    return run_confined({program}, {{}, {program}, {}}, {}).not_executed;
  };
  EXPECT_EQ(why(text), "Permission denied");
  EXPECT_EQ(why(lost), "No such file or directory");
  EXPECT_EQ(why(none), "No such file or directory");
  EXPECT_EQ(why(workplace_.directory()), "Permission denied");
  EXPECT_EQ(why(made("right", "#!/bin/sh\nexit 127\n")), "");
}

TEST_F(SandboxPlaces, GivenFilesAndTemporaryOnes) {
  made("given/scene.sdf", "the scene");
  const SandboxRun run = shell("cat scene.sdf; rm scene.sdf; pwd; t=$(mktemp); echo x > $t && mv $t kept; ls",
                               {workplace_.path("given"), {}, {}});
  EXPECT_EQ(run.printed, "the scene/tmp/judged\nkept\n");
  EXPECT_EQ(read_file(run.directory() + "/kept"), "x\n");
  EXPECT_EQ(listing(workplace_.path("given")), std::vector<std::string>{"scene.sdf"});
}

TEST_F(SandboxPlaces, AllThatIsWrittenIsOneLimit) {
  SandboxLimits limits;
  limits.disk_bytes = std::size_t{1} << 20;
  const std::string half = "head -c 600000 /dev/zero > ";
  EXPECT_EQ(shell(half + "a", {}, limits).ending, Ending::finished);
  EXPECT_EQ(shell(half + "a; " + half + "$TMPDIR/b; sleep 60", {}, limits).ending, Ending::too_much_output);
  EXPECT_EQ(shell(half + "a; " + half + "/var/tmp/b", {}, limits).ending, Ending::finished);
}

TEST_F(SandboxPlaces, PlumbIsShownWhereItIsAskedForAlone) {
  const std::string self = fs::read_symlink("/proc/self/exe");
  const std::string beside = fs::path(self).parent_path();
  const std::string look =
      "test -x '" + self + "' && echo seen; test -e '" + source_path("tests") + "' && echo source";
  EXPECT_EQ(shell(look, {{}, {"/"}, {}}).printed, "");
  EXPECT_EQ(shell(look, {{}, {beside}, {}}).printed, "");
  EXPECT_EQ(shell(look, {{}, {beside, self}, {}}).printed, "seen\n");
}

TEST(LimitsNotEnforced, AreSaidWhereTheKernelKeepsNone) {
  const submissions::ControlGroups& here = submissions::control_groups();
  EXPECT_EQ(submissions::limits_not_enforced().empty(), here.keeps_memory && here.keeps_tasks);
}

TEST(ControlGroup, CountsWhatNobodyWaitedFor) {
  const submissions::ControlGroup group(SandboxLimits{});
  if (group.entrance() < 0) GTEST_SKIP() << "no group of cgroup v2 can be made here";
  const pid_t child = fork();
  if (child == 0) {
    if (write(group.entrance(), "0", 1) != 1) _exit(1);
    while (clock() < CLOCKS_PER_SEC / 5) {
    }
    _exit(0);
  }
  siginfo_t ended{};
  ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT), 0);
  ASSERT_EQ(ended.si_status, 0);
  EXPECT_GE(group.cpu_seconds().value_or(0), 0.15);
  waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace plumb::tests
