// Image files that were cut short or changed on their way: never taken for a picture.
#include <random>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

struct Kind {
  std::string name;
  std::string file;
  std::string options;  ///< of oiiotool
  bool has_check_sums = false;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class Damaged : public testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    const std::string tool = system::find_program("oiiotool");
    if (tool.empty()) GTEST_SKIP() << "oiiotool (openimageio-tools) is not installed";
    workplace_.file("ball.sdf", std::string(ball_scene));
    const std::string directory = workplace_.directory();
    ASSERT_EQ(run_plumb({"render", "ball.sdf", "--size", "64x48", "-o", "ball.pfm"}, directory).exit_code, 0);
    const auto made =
        run_shell("'" + tool + "' ball.pfm " + GetParam().options + " -o " + GetParam().file, directory);
    ASSERT_EQ(made.exit_code, 0) << made.output;
    whole_ = read_file(workplace_.path(GetParam().file));
    ASSERT_EQ(compared_with(whole_).exit_code, 0) << "the whole file is read";
  }

  std::string damaged() const { return "damaged-" + GetParam().file; }
  Outcome compared_with(const std::string& bytes) const {
    workplace_.file(damaged(), bytes);
    return run_plumb({"compare", damaged(), GetParam().file}, workplace_.directory());
  }

  Workplace workplace_;
  std::string whole_;
};

TEST_P(Damaged, CutAnywhereItIsRefused) {
  std::vector<std::size_t> lengths;
  for (const std::size_t missing : {1U, 4U, 12U, 13U}) lengths.push_back(whole_.size() - missing);
  for (std::size_t k = 0; k < 8; ++k) lengths.push_back(whole_.size() * k / 8);
  for (const std::size_t length : lengths) {
    SCOPED_TRACE(std::to_string(length) + " of " + std::to_string(whole_.size()) + " bytes");
    expect_trouble(compared_with(whole_.substr(0, length)), {damaged(), "cannot be read"});
  }
}

TEST_P(Damaged, WithAFlippedBitItIsRefusedOrReadButNoCrash) {
  std::mt19937 random(20);
  for (int i = 0; i < 8; ++i) {
    std::string bytes = whole_;
    const std::size_t at = random() % bytes.size();
    bytes[at] = static_cast<char>(bytes[at] ^ 1 << random() % 8);
    SCOPED_TRACE("byte " + std::to_string(at) + " of " + std::to_string(whole_.size()));
    const Outcome outcome = compared_with(bytes);
    EXPECT_LE(outcome.exit_code, 2) << outcome.err;
    if (outcome.exit_code == 2 || GetParam().has_check_sums) expect_trouble(outcome, {damaged()});
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Damaged,
                         testing::ValuesIn(std::vector<Kind>{
                             {"FloatExr", "a.exr", "-d float --compression none"},
                             {"ZipExr", "a.exr", "-d float --compression zip"},
                             {"PizExr", "a.exr", "-d float --compression piz"},
                             {"HalfExr", "a.exr", "-d half --compression zip"},
                             {"FloatTiff", "a.tif", "-d float --compression none"},
                             {"ZipTiff", "a.tif", "-d float --compression zip"},
                             {"LzwTiff", "a.tif", "-d float --compression lzw"},
                             {"TiledTiff", "a.tif", "-d float --compression none --tile 16 16"},
                             {"TiledZipTiff", "a.tif", "-d uint16 --compression zip --tile 16 16"},
                             {"ByteTiff", "a.tif", "-d uint8 --compression none"},
                             {"BytePng", "a.png", "-d uint8", true},
                             {"SixteenBitPng", "a.png", "-d uint16", true},
                             {"AlphaPng", "a.png", "--ch R,G,B,A=0.5 -d uint8", true},
                         }),
                         [](const auto& test) { return test.param.name; });

class DamagedPixels : public Damaged {};

/// Bits that change what is decoded, where the file's own structure stays whole.
TEST_P(DamagedPixels, AreRefused) {
  for (const std::size_t part : {3U, 4U, 5U}) {
    std::string bytes = whole_;
    const std::size_t at = bytes.size() * part / 8;
    bytes.replace(at, 16, 16, '\xff');
    expect_trouble(compared_with(bytes), {damaged(), "cannot be read"});
  }
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedPixels,
                         testing::ValuesIn(std::vector<Kind>{
                             {"ZipExr", "a.exr", "-d float --compression zip"},
                             {"ZipTiff", "a.tif", "-d float --compression zip"},
                             {"TiledZipTiff", "a.tif", "-d uint16 --compression zip --tile 16 16"},
                             {"BytePng", "a.png", "-d uint8"},
                         }),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace plumb::tests
