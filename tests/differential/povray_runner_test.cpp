// Running POV-Ray when all is well and when it is not, and the cache of its pictures.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <limits>
#include <optional>
#include <thread>

#include "references/renderers/cache.hpp"
#include "references/renderers/povray.hpp"
#include "tests/support/run.hpp"
#include "tests/support/variable.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/files.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using renderers::Cache;
using renderers::ExportedShot;
using renderers::Holds;
using renderers::Povray;
using renderers::PovrayError;
using renderers::PovrayJob;
using renderers::PovrayRenderer;
using renderers::Rendered;

/// A shell script that stands on PATH in the place of POV-Ray.
class FakePovray {
 public:
  explicit FakePovray(const std::string& script) : path_("PATH", workplace_.directory()) { become(script); }
  void become(const std::string& script) const {
    const std::string program = workplace_.file("povray", "#!/bin/sh\n" + script);
    chmod(program.c_str(), S_IRWXU);
  }
  const Workplace& workplace() const { return workplace_; }

 private:
  Workplace workplace_;
  Variable path_;
};

constexpr int picture_width = 8;
constexpr int picture_height = 6;
const std::string start = "#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\n";

/// All pixels have one colour.
PovrayJob job_with_background(const std::string& rgb) {
  return {start + "background { rgb <" + rgb + "> }\nsphere { <0,0,-99>, 1 }\n", picture_width,
          picture_height};
}

std::string message_of(const PovrayJob& job) {
  try {
    Povray().render(job);
  } catch (const PovrayError& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not a PovrayError but: " << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Whether a process runs; one that ended and was not waited for does not.
bool runs(const std::string& id) {
  std::ifstream file("/proc/" + id + "/status");
  const std::string status{std::istreambuf_iterator<char>(file), {}};
  return !status.empty() && !has(status, "State:\tZ") && !has(status, "State:\tX");
}

/// Ids of the processes that work in a directory or below.
std::vector<std::string> processes_in(const std::string& directory) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code error;
    const fs::path where = fs::read_symlink(entry.path() / "cwd", error);
    if (!error && where.string().starts_with(directory)) found.push_back(entry.path().filename());
  }
  return found;
}

// The real POV-Ray.

TEST(PovrayRunner, AParseErrorIsToldWithItsLineOfSdl) {
  const std::string message =
      message_of({start + "sphere { <0,0,0>, 1 }\nsphere { oddly_named }\n", picture_width, picture_height});
  EXPECT_TRUE(has(message, "Parse Error")) << message;
  EXPECT_TRUE(has(message, "line 4")) << message;
  EXPECT_TRUE(has(message, "| sphere { oddly_named }")) << message;
}

TEST(PovrayRunner, WarningsAreTold) {
  struct Case {
    const char* what;
    std::string sdl;
  };
  const std::vector<Case> cases{
      {"an empty scene", start},
      {"a division by zero", start + "sphere { <0,0,1/0>, 1 }\n"},
      {"a zero matrix", start + "sphere { <0,0,9>, 1 matrix <0,0,0,0,0,0,0,0,0,0,0,0> }\n"},
      {"a union of one", start + "union { sphere { <0,0,9>, 1 } }\n"}};
  const Povray povray;
  std::vector<std::future<Rendered>> running;
  for (const Case& c : cases) {
    running.push_back(std::async(std::launch::async, [&povray, &c] {
      return povray.render({c.sdl, picture_width, picture_height});
    }));
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    try {
      EXPECT_TRUE(has(running[i].get().warnings, "Warning")) << cases[i].what;
    } catch (const PovrayError& error) {
      ADD_FAILURE() << cases[i].what << " is an error: " << error.what();
    }
  }
}

TEST(PovrayRunner, ASceneThatIsFineGivesNoWarningsAndItsCpuTime) {
  const Rendered picture = Povray().render(job_with_background("0.5,1.5,0.25"));
  EXPECT_EQ(picture.warnings, "");
  EXPECT_EQ(picture.holds, Holds::float32);
  EXPECT_GT(picture.cpu_seconds, 0);
  EXPECT_LT(picture.cpu_seconds, 10);
  for (int y = 0; y < picture_height; ++y) {
    for (int x = 0; x < picture_width; ++x) {
      EXPECT_EQ(std::vector<float>(picture.image.pixel(x, y), picture.image.pixel(x, y) + 3),
                (std::vector<float>{0.5F, 1.5F, 0.25F}));
    }
  }
}

TEST(PovrayRunner, SeveralRunsAtOnceDoNotDisturbEachOther) {
  const Povray povray;
  std::vector<std::future<Rendered>> running;
  for (int i = 0; i < 10; ++i) {
    running.push_back(std::async(std::launch::async, [&povray, i] {
      return povray.render(job_with_background(std::to_string(i) + ",0,0.5"));
    }));
  }
  for (int i = 0; i < 10; ++i) {
    const Image image = running[static_cast<std::size_t>(i)].get().image;
    for (std::size_t at = 0; at < image.rgb.size(); at += 3) ASSERT_EQ(image.rgb[at], static_cast<float>(i));
  }
}

TEST(PovrayRunner, ARunBeyondItsTimeIsEndedAndLeavesNothing) {
  const Workplace workplace;
  const Variable temporary("TMPDIR", workplace.directory());
  PovrayJob job{start + "#while (1)\n#end\n", picture_width, picture_height};
  job.time_limit_seconds = 1.2;
  const auto before = std::chrono::steady_clock::now();
  const std::string message = message_of(job);
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(10));
  EXPECT_TRUE(has(message, "longer than 1.2 s")) << message;
  EXPECT_TRUE(processes_in(workplace.directory()).empty());
  EXPECT_TRUE(fs::is_empty(workplace.directory()));
}

TEST(PovrayRunner, ATimeLimitBelowASecondIsToldAsItIs) {
  PovrayJob job = job_with_background("0,0,0");
  job.time_limit_seconds = 0.2;
  const std::string message = message_of(job);
  EXPECT_TRUE(has(message, "longer than 0.2 s")) << message;
}

TEST(PovrayRunner, NothingIsLeftOfARunThatWentWell) {
  const Workplace workplace;
  const Variable temporary("TMPDIR", workplace.directory());
  Povray().render(job_with_background("0,0,0"));
  EXPECT_TRUE(fs::is_empty(workplace.directory()));
  EXPECT_TRUE(processes_in(workplace.directory()).empty());
}

// Without POV-Ray, and with something else in its place.

TEST(PovrayRunner, WithoutPovrayTheRemedyIsTold) {
  const Workplace empty;
  const Variable path("PATH", empty.directory());
  try {
    const Povray povray;
    ADD_FAILURE() << povray.program();
  } catch (const PovrayError& error) {
    EXPECT_STREQ(error.what(), "povray is not on PATH; install it (apt-get install povray) or use --stored");
  }
}

TEST(PovrayRunner, ADirectoryOrAnUnexecutableFileIsNoPovray) {
  const Workplace workplace;
  const Variable path("PATH", workplace.directory());
  workplace.file("povray", "#!/bin/sh\n");
  EXPECT_THROW(Povray(), PovrayError);
  fs::remove(workplace.path("povray"));
  fs::create_directory(workplace.path("povray"));
  EXPECT_THROW(Povray(), PovrayError);
}

TEST(PovrayRunner, WhateverAFakePovrayLeavesIsAClearError) {
  struct Case {
    const char* what;
    const char* script;
  };
  for (const Case& c :
       {Case{"nothing", "exit 0\n"}, Case{"an empty state file", ": > out.pov-state\n"},
        Case{"a truncated state file", "printf 'POV-Ray Render State File' > out.pov-state\n"},
        Case{"garbage", "head -c 5000 /dev/urandom > out.pov-state; head -c 5000 /dev/urandom > out.png\n"},
        Case{"an empty PNG", ": > out.png\n"}, Case{"a directory for a PNG", "mkdir out.png\n"},
        Case{"no state file and no link", "rm -f out.pov-state t.state\n"},
        Case{"an empty directory", "rm -rf ./*\n"}}) {
    const FakePovray fake(c.script);
    const std::string message = message_of(job_with_background("0,0,0"));
    EXPECT_FALSE(message.empty()) << c.what;
    EXPECT_TRUE(has(message, "POV-Ray") || has(message, "out.png")) << c.what << ": " << message;
  }
}

TEST(PovrayRunner, WithoutAUsableStateFileItsPngIsTakenAndThatIsSaid) {
  Image image(picture_width, picture_height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<float>(i) / 200;
  for (const char* state : {"", "printf 'POV-Ray Render State File' > out.pov-state\n",
                            "head -c 5000 /dev/zero > out.pov-state\n", "rm -f out.pov-state t.state\n"}) {
    const FakePovray fake(std::string(state) + "cp \"${0%/*}/good.png\" out.png\n");
    write_image(fake.workplace().path("good.png"), image, Encoding::linear);
    const Rendered picture = Povray().render(job_with_background("0,0,0"));
    EXPECT_EQ(picture.holds, Holds::bits16);
    EXPECT_TRUE(has(picture.warnings, "state")) << picture.warnings;
    EXPECT_TRUE(has(picture.warnings, "clamped at 1")) << picture.warnings;
    ASSERT_EQ(picture.image.rgb.size(), image.rgb.size());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      EXPECT_NEAR(picture.image.rgb[i], image.rgb[i], 7.7e-6) << "half a step of 16 bits, " << i;
    }
  }
}

TEST(PovrayRunner, APngOfAnotherSizeIsNotTaken) {
  const FakePovray fake("cp \"${0%/*}/good.png\" out.png\n");
  write_image(fake.workplace().path("good.png"), Image(picture_width, picture_height + 1), Encoding::linear);
  EXPECT_TRUE(has(message_of(job_with_background("0,0,0")), "size"));
}

TEST(PovrayRunner, ErrorsSignalsAndExitCodesAreTold) {
  const FakePovray fake("echo 'Fatal error: no memory'; exit 3\n");
  std::string message = message_of(job_with_background("0,0,0"));
  EXPECT_TRUE(has(message, "ended with 3") && has(message, "Fatal error: no memory")) << message;
  fake.become("exit 9\n");
  message = message_of(job_with_background("0,0,0"));
  EXPECT_TRUE(has(message, "ended with 9") && has(message, "no reason")) << message;
  fake.become("kill -11 $$\n");
  EXPECT_TRUE(has(message_of(job_with_background("0,0,0")), "signal 11"));
}

TEST(PovrayRunner, EndlessOutputNeitherHangsNorFillsTheMemory) {
  const FakePovray fake("head -c 20000000 /dev/zero | tr '\\0' 'e'; echo; echo 'error: last'; exit 1\n");
  const std::string message = message_of(job_with_background("0,0,0"));
  EXPECT_LT(message.size(), std::size_t{3} << 20);
}

TEST(PovrayRunner, WhatAFakePovrayStartedEndsWithIt) {
  for (const char* rest : {"sleep 300\n", "exit 1\n"}) {
    const FakePovray fake(
        std::string("sleep 300 & echo $! > \"${0%/*}/child\"; echo $$ > \"${0%/*}/self\"\n") + rest);
    PovrayJob job = job_with_background("0,0,0");
    job.time_limit_seconds = 0.5;
    message_of(job);
    for (const char* file : {"child", "self"}) {
      std::string id = read_file(fake.workplace().path(file));
      ASSERT_FALSE(id.empty());
      id.pop_back();
      bool is_running = runs(id);
      for (int i = 0; i < 100 && is_running; ++i) {  // a killed process needs a moment to go
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        is_running = runs(id);
      }
      EXPECT_FALSE(is_running) << file << " after " << rest;
    }
  }
}

TEST(PovrayRunner, AProgramThatIsNoPovrayIsFoundOutByItsVersion) {
  const FakePovray fake("echo hello\n");
  EXPECT_THROW(Povray().version(), PovrayError);
  fake.become("echo 'POV-Ray 3.7.0.10.fake'; echo more\n");
  EXPECT_EQ(Povray().version(), "3.7.0.10.fake");
}

// The cache.

Rendered some_picture() {
  Rendered picture;
  picture.image = Image(picture_width, picture_height);
  for (std::size_t i = 0; i < picture.image.rgb.size(); ++i)
    picture.image.rgb[i] = 0.1F * static_cast<float>(i);
  picture.image.rgb[3] = std::numeric_limits<float>::infinity();
  picture.image.rgb[4] = -0.0F;
  picture.image.rgb[5] = std::numeric_limits<float>::quiet_NaN();
  picture.cpu_seconds = 0.125;
  picture.holds = Holds::bits16;
  picture.warnings = "Warning: one\nWarning: \"two\"";
  return picture;
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.rgb.size() == b.rgb.size() &&
         std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0;
}

class CacheOfPictures : public testing::Test {
 protected:
  Workplace workplace_;
  Cache cache_{workplace_.path("cache")};
  ExportedShot shot_ = renderers::exported_by(job_with_background("0.25,0.5,1"));
  std::string version_ = "3.7.0";
};

TEST_F(CacheOfPictures, NothingIsFoundNorMadeBeforeSomethingIsStored) {
  EXPECT_FALSE(cache_.find(shot_, version_).has_value());
  EXPECT_FALSE(fs::exists(workplace_.path("cache")));
}

TEST_F(CacheOfPictures, WhatIsFoundIsTheSameToTheLastBit) {
  const Rendered stored = some_picture();
  cache_.store(shot_, version_, stored);
  for (int i = 0; i < 2; ++i) {
    const auto found = Cache(workplace_.path("cache")).find(shot_, version_);
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(same_bits(found->image, stored.image));
    EXPECT_EQ(found->cpu_seconds, stored.cpu_seconds);
    EXPECT_EQ(found->holds, stored.holds);
    EXPECT_EQ(found->warnings, stored.warnings);
  }
}

TEST_F(CacheOfPictures, WarningsThatAreNoUtf8AreStoredOrNotButNeverThrow) {
  Rendered picture = some_picture();
  picture.warnings = "Warning: \xFF\xC3\x28";
  EXPECT_NO_THROW(cache_.store(shot_, version_, picture));
  EXPECT_NO_THROW(cache_.find(shot_, version_));
}

TEST_F(CacheOfPictures, AFlippedBitAnywhereIsNoticed) {
  cache_.store(shot_, version_, some_picture());
  const std::string path = cache_.entry_path(shot_, version_);
  const std::string good = read_file(path);
  ASSERT_GT(good.size(), picture_width * picture_height * 3 * sizeof(float));
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (at % 8)));
    write_bytes(path, bytes);
    EXPECT_FALSE(cache_.find(shot_, version_).has_value()) << "byte " << at << " of " << good.size();
  }
  write_bytes(path, good);
  EXPECT_TRUE(cache_.find(shot_, version_).has_value());
}

TEST_F(CacheOfPictures, ATruncatedOrLongerEntryIsNoticed) {
  cache_.store(shot_, version_, some_picture());
  const std::string path = cache_.entry_path(shot_, version_);
  const std::string good = read_file(path);
  for (std::size_t length = 0; length < good.size(); ++length) {
    write_bytes(path, good.substr(0, length));
    EXPECT_FALSE(cache_.find(shot_, version_).has_value()) << "the first " << length << " bytes";
  }
  write_bytes(path, good + '\0');
  EXPECT_FALSE(cache_.find(shot_, version_).has_value());
}

TEST_F(CacheOfPictures, ADamagedEntryIsReplaced) {
  cache_.store(shot_, version_, some_picture());
  write_bytes(cache_.entry_path(shot_, version_), "damaged");
  ASSERT_FALSE(cache_.find(shot_, version_).has_value());
  cache_.store(shot_, version_, some_picture());
  EXPECT_TRUE(cache_.find(shot_, version_).has_value());
}

TEST_F(CacheOfPictures, AllThatDeterminesThePictureIsInTheKey) {
  cache_.store(shot_, version_, some_picture());
  ExportedShot other = shot_;
  other.text += " ";
  EXPECT_FALSE(cache_.find(other, version_).has_value()) << "text";
  other = shot_;
  other.width = picture_height;
  other.height = picture_width;
  EXPECT_FALSE(cache_.find(other, version_).has_value()) << "size";
  other = shot_;
  other.arguments.emplace_back("-MB");
  EXPECT_FALSE(cache_.find(other, version_).has_value()) << "options";
  EXPECT_FALSE(cache_.find(shot_, version_ + "1").has_value()) << "version";
  other = shot_;
  other.renderer = "other";
  EXPECT_FALSE(cache_.find(other, version_).has_value()) << "renderer";
  other = shot_;
  other.holds = Holds::bits16;
  EXPECT_FALSE(cache_.find(other, version_).has_value()) << "which of its files is read";
  PovrayJob patient = job_with_background("0.25,0.5,1");
  patient.time_limit_seconds = 1;
  EXPECT_TRUE(cache_.find(renderers::exported_by(patient), version_).has_value())
      << "the time limit changes no picture";
}

TEST_F(CacheOfPictures, AnEntryForAnotherSizeInItsPlaceIsNotTaken) {
  PovrayJob upright = job_with_background("0.25,0.5,1");
  upright.width = picture_height;
  upright.height = picture_width;
  const ExportedShot other = renderers::exported_by(upright);
  Rendered picture = some_picture();
  std::swap(picture.image.width, picture.image.height);
  cache_.store(other, version_, picture);
  fs::copy_file(cache_.entry_path(other, version_), cache_.entry_path(shot_, version_));
  EXPECT_FALSE(cache_.find(shot_, version_).has_value());
}

TEST_F(CacheOfPictures, ADirectoryThatCannotBeWrittenIsNoError) {
  const Cache under_a_file(workplace_.file("file", "") + "/cache");
  EXPECT_NO_THROW(under_a_file.store(shot_, version_, some_picture()));
  EXPECT_FALSE(under_a_file.find(shot_, version_).has_value());
  const FakePovray fake("echo 'POV-Ray 1.2.3'\n");
  EXPECT_EQ(under_a_file.version_of(PovrayRenderer()), "1.2.3");
}

TEST_F(CacheOfPictures, ManyThreadsMayStoreAndFindTheSameEntry) {
  const Rendered stored = some_picture();
  std::atomic<int> wrong{0};
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < 50; ++i) {
          cache_.store(shot_, version_, stored);
          const auto found = cache_.find(shot_, version_);
          if (found && !same_bits(found->image, stored.image)) ++wrong;
        }
      });
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_TRUE(cache_.find(shot_, version_).has_value());
}

TEST_F(CacheOfPictures, TheEnvironmentSaysWhereItIs) {
  const Variable own("PLUMB_CACHE", workplace_.path("own"));
  EXPECT_TRUE(Cache().entry_path(shot_, version_).starts_with(workplace_.path("own") + "/"));
  const Variable none("PLUMB_CACHE", "");
  const Variable xdg("XDG_CACHE_HOME", workplace_.path("xdg"));
  EXPECT_TRUE(Cache().entry_path(shot_, version_).starts_with(workplace_.path("xdg") + "/plumb/"));
  const Variable no_xdg("XDG_CACHE_HOME", "");
  const Variable home("HOME", workplace_.path("home"));
  EXPECT_TRUE(Cache().entry_path(shot_, version_).starts_with(workplace_.path("home") + "/.cache/plumb/"));
}

TEST_F(CacheOfPictures, ThePovrayProgramIsAskedForItsVersionOnce) {
  const std::string script = "echo run >> \"${0%/*}/log\"; echo 'POV-Ray 3.7.0.";
  const FakePovray fake(script + "1'\n");
  const auto times_asked = [&] {
    const std::string log = read_file(fake.workplace().path("log"));
    return std::count(log.begin(), log.end(), '\n');
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cache_.version_of(PovrayRenderer()), "3.7.0.1");
    EXPECT_EQ(Cache(workplace_.path("cache")).version_of(PovrayRenderer()), "3.7.0.1");
  }
  EXPECT_EQ(times_asked(), 1);
  fake.become(script + "22'\n");
  EXPECT_EQ(cache_.version_of(PovrayRenderer()), "3.7.0.22") << "another program in its place";
  EXPECT_EQ(times_asked(), 2);
}

TEST_F(CacheOfPictures, AnEmptyVersionFileIsNotTaken) {
  const FakePovray fake("echo 'POV-Ray 3.7.0.1'\n");
  cache_.version_of(PovrayRenderer());
  for (const auto& entry : fs::directory_iterator(workplace_.path("cache"))) write_bytes(entry.path(), "");
  EXPECT_EQ(cache_.version_of(PovrayRenderer()), "3.7.0.1");
}

}  // namespace
}  // namespace plumb::tests
