// `plumb render`: what is in the image files, where they go, and what the options change.
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;  // the top row first

  const float* at(int x, int y) const { return &rgb[3 * static_cast<std::size_t>(y * width + x)]; }
};

/// `PF`, the size, a negative scale for little endian, and the rows from the bottom to the top.
Picture picture_of_pfm(const std::string& bytes) {
  std::istringstream stream(bytes);
  std::string magic;
  double scale = 0;
  Picture picture;
  stream >> magic >> picture.width >> picture.height >> scale;
  stream.get();
  EXPECT_EQ(magic, "PF");
  EXPECT_LT(scale, 0);
  const auto row = 3 * static_cast<std::size_t>(picture.width);
  picture.rgb.resize(row * static_cast<std::size_t>(picture.height));
  for (int y = picture.height - 1; y >= 0; --y) {
    stream.read(reinterpret_cast<char*>(&picture.rgb[row * static_cast<std::size_t>(y)]),
                static_cast<std::streamsize>(row * sizeof(float)));
  }
  EXPECT_TRUE(stream.good()) << "too short";
  EXPECT_EQ(stream.peek(), std::char_traits<char>::eof()) << "too long";
  return picture;
}

struct AsciiPpm {
  std::string header;
  std::vector<unsigned> values;
};

AsciiPpm ascii_ppm_of(const std::string& text) {
  AsciiPpm ppm;
  std::istringstream stream(text);
  for (int i = 0; i < 3; ++i) {
    std::string line;
    std::getline(stream, line);
    ppm.header += line + "\n";
  }
  for (unsigned value = 0; stream >> value;) ppm.values.push_back(value);
  EXPECT_TRUE(stream.eof());
  return ppm;
}

unsigned as_the_course_writes(float c) {
  const float mapped = c / (c + 1);
  return static_cast<unsigned>(255.0F * std::min(std::max(mapped, 0.0F), 1.0F));
}

unsigned as_srgb(float c) {
  const double x = std::clamp(static_cast<double>(c), 0.0, 1.0);
  return static_cast<unsigned>(
      std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
}

/// A binary PPM with values that the test computed.
template <class Encode>
std::string binary_ppm(const Picture& picture, unsigned most, Encode encode) {
  std::string bytes = "P6\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n" +
                      std::to_string(most) + "\n";
  for (const float c : picture.rgb) {
    const unsigned value = encode(c);
    if (most > 255) bytes += static_cast<char>(value >> 8U);
    bytes += static_cast<char>(value & 255U);
  }
  return bytes;
}

/// Nothing but one colour.
std::string background_scene(const std::string& rgb, const std::string& size) {
  return "background " + rgb + "\ndefine camera eye 40\nrender eye out.ppm " + size + "\n";
}

class ImageOutput : public testing::Test {
 protected:
  Outcome render(const std::vector<std::string>& more, const std::string& scene = std::string(ball_scene)) {
    workplace_.file("scene.sdf", scene);
    std::vector<std::string> arguments{"render", "scene.sdf"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_plumb(arguments, workplace_.directory());
  }
  std::string bytes_of(const std::string& name) const { return read_file(workplace_.path(name)); }

  /// The scene in floats.
  Picture rendered(std::vector<std::string> more = {}, const std::string& scene = std::string(ball_scene)) {
    more.insert(more.end(), {"-o", "floats.pfm"});
    const Outcome outcome = render(more, scene);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return picture_of_pfm(bytes_of("floats.pfm"));
  }
  /// `plumb compare` finds two files equal.
  void expect_equal(const std::string& reference, const std::string& test,
                    const std::string& tolerance = "0") const {
    const Outcome outcome =
        run_plumb({"compare", reference, test, "--tolerance", tolerance}, workplace_.directory());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  }
  void expect_only(std::vector<std::string> names) const {
    names.emplace_back("scene.sdf");
    std::sort(names.begin(), names.end());
    EXPECT_EQ(listing(workplace_.directory()), names);
  }

  Workplace workplace_;
};

// --- what is in the files ---------------------------------------------------------------------

TEST_F(ImageOutput, APfmIsLinearFloatsWithTheBottomRowFirst) {
  const Picture picture = rendered();
  EXPECT_EQ(picture.width, 32);
  EXPECT_EQ(picture.height, 24);
  const std::array<float, 3> corner{picture.at(0, 0)[0], picture.at(0, 0)[1], picture.at(0, 0)[2]};
  EXPECT_EQ(corner, (std::array<float, 3>{0.1F, 0.15F, 3.0F}));
  // The light is above: of the sphere's pixels, the upper ones are brighter.
  EXPECT_GT(picture.at(16, 6)[0], picture.at(16, 17)[0]);
  EXPECT_EQ(bytes_of("floats.pfm").substr(0, 14), "PF\n32 24\n-1.0\n");
}

TEST_F(ImageOutput, AnExrHoldsTheSameFloatsBitForBit) {
  rendered();
  ASSERT_EQ(render({"-o", "image.exr"}).exit_code, 0);
  EXPECT_EQ(bytes_of("image.exr").substr(0, 4), "\x76\x2f\x31\x01");
  expect_equal("floats.pfm", "image.exr");
  expect_only({"floats.pfm", "image.exr"});
}

TEST_F(ImageOutput, APpmIsToneMappedAndTruncatedAsTheCourseFrameworkWritesIt) {
  const Picture picture = rendered();
  ASSERT_EQ(render({"-o", "image.ppm"}).exit_code, 0);
  const AsciiPpm ppm = ascii_ppm_of(bytes_of("image.ppm"));
  EXPECT_EQ(ppm.header, "P3\n32 24\n255\n");
  std::vector<unsigned> expected;
  for (const float c : picture.rgb) expected.push_back(as_the_course_writes(c));
  EXPECT_EQ(ppm.values, expected);
}

TEST_F(ImageOutput, ACoursePpmTruncatesWhereRoundingWouldGoUp) {
  // 0.6 / 1.6 * 255 = 95.6 and 0.3 / 1.3 * 255 = 58.8; white light without end is 255.
  ASSERT_EQ(render({}, background_scene("0.6 0.3 1e30", "2 2")).exit_code, 0);
  EXPECT_EQ(bytes_of("out.ppm"), "P3\n2 2\n255\n95 58 255 95 58 255\n95 58 255 95 58 255\n");
}

TEST_F(ImageOutput, NegativeColoursAreBlackInEightBits) {
  const std::string scene = background_scene("-0.5 -1 -2", "1 1");
  for (const char* const encoding : {"course", "srgb", "linear"}) {
    ASSERT_EQ(render({"--encode", encoding}, scene).exit_code, 0);
    EXPECT_EQ(bytes_of("out.ppm"), "P3\n1 1\n255\n0 0 0\n") << encoding;
  }
  EXPECT_EQ(rendered({}, scene).rgb, (std::vector<float>{-0.5F, -1.0F, -2.0F}));
}

TEST_F(ImageOutput, ALinearPpmIsOnlyScaledAndTruncated) {
  ASSERT_EQ(render({"--encode", "linear"}, background_scene("0.6 0.3 7", "1 1")).exit_code, 0);
  EXPECT_EQ(bytes_of("out.ppm"), "P3\n1 1\n255\n153 76 255\n");
}

TEST_F(ImageOutput, AnSrgbPpmHasTheSrgbCurve) {
  const Picture picture = rendered();
  ASSERT_EQ(render({"-o", "image.ppm", "--encode", "srgb"}).exit_code, 0);
  std::vector<unsigned> expected;
  for (const float c : picture.rgb) expected.push_back(as_srgb(c));
  EXPECT_EQ(ascii_ppm_of(bytes_of("image.ppm")).values, expected);
  ASSERT_EQ(render({"--encode", "srgb"}, background_scene("0.5 0.001 1", "1 1")).exit_code, 0);
  EXPECT_EQ(bytes_of("out.ppm"), "P3\n1 1\n255\n188 3 255\n");
}

TEST_F(ImageOutput, APngIsEightBitsOfSrgb) {
  const Picture picture = rendered();
  ASSERT_EQ(render({"-o", "image.png"}).exit_code, 0);
  const std::string png = bytes_of("image.png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.at(24), 8) << "bits";
  EXPECT_EQ(png.at(25), 2) << "RGB";
  workplace_.file("expected.ppm", binary_ppm(picture, 255, as_srgb));
  expect_equal("expected.ppm", "image.png", "1e-6");
}

TEST_F(ImageOutput, APngCanHoldTheCourseEncoding) {
  const Picture picture = rendered();
  ASSERT_EQ(render({"-o", "image.png", "--encode", "course"}).exit_code, 0);
  workplace_.file("expected.ppm", binary_ppm(picture, 255, as_the_course_writes));
  expect_equal("expected.ppm", "image.png", "1e-6");
}

/// Its start would take longer than the render.
TEST_F(ImageOutput, AnEightBitPngIsWrittenAndReadWithoutOpenImageIO) {
  const std::filesystem::path built(PLUMB_BINARY);
  std::filesystem::create_directory(workplace_.path("copy"));
  for (const std::string& name : {built.filename().string(), std::string("plumb_codecs.so")})
    std::filesystem::copy_file(built.parent_path() / name, workplace_.path("copy/" + name));
  workplace_.file("scene.sdf", std::string(ball_scene));
  const auto run = [&](const std::string& arguments) {
    return run_shell("copy/" + built.filename().string() + " " + arguments, workplace_.directory());
  };
  const auto rendered_there = run("render scene.sdf -o image.png");
  EXPECT_EQ(rendered_there.exit_code, 0) << rendered_there.output;
  const auto compared = run("compare image.png image.png");
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  expect_trouble(run("render scene.sdf -o image.exr"), {"plumb_openimageio.so"});
}

TEST_F(ImageOutput, ALinearPngHasSixteenBitsAndSaysSo) {
  const Picture picture = rendered();
  ASSERT_EQ(render({"-o", "image.png", "--encode", "linear"}).exit_code, 0);
  const std::string png = bytes_of("image.png");
  EXPECT_EQ(png.at(24), 16) << "bits";
  EXPECT_TRUE(contains(png, std::string("gAMA\x00\x01\x86\xa0", 8))) << "gamma 1.0, in units of 1e-5";
  workplace_.file(
      "expected.ppm", binary_ppm(picture, 65535, [](float c) {
        return static_cast<unsigned>(std::lround(65535 * std::clamp(static_cast<double>(c), 0.0, 1.0)));
      }));
  // Whether a half is rounded up or down is nobody's business.
  expect_equal("expected.ppm", "image.png", "1.6e-5");
}

TEST_F(ImageOutput, ExtensionsCountInAnyCase) {
  ASSERT_EQ(render({"-o", "image.PPM"}).exit_code, 0);
  EXPECT_EQ(bytes_of("image.PPM").substr(0, 3), "P3\n");
  rendered();
  ASSERT_EQ(render({"-o", "image.Pfm"}).exit_code, 0);
  EXPECT_TRUE(bytes_of("image.Pfm") == bytes_of("floats.pfm"));
}

TEST_F(ImageOutput, AFloatImageRefusesAnEncoding) {
  for (const char* const name : {"image.exr", "image.pfm"}) {
    expect_trouble(render({"-o", name, "--encode", "srgb"}), {name, "linear"});
    expect_trouble(render({"-o", name, "--encode", "course"}), {name, "linear"});
  }
  expect_only({});
}

// --- where they go ----------------------------------------------------------------------------

TEST_F(ImageOutput, ADashIsStandardOutput) {
  rendered();
  const Outcome floats = render({"-o", "-"});
  EXPECT_EQ(floats.exit_code, 0);
  EXPECT_EQ(floats.err, "");
  EXPECT_TRUE(floats.out == bytes_of("floats.pfm"));
  ASSERT_EQ(render({"-o", "image.ppm"}).exit_code, 0);
  EXPECT_EQ(render({"-o", "-", "--encode", "course"}).out, bytes_of("image.ppm"));
  expect_only({"floats.pfm", "image.ppm"});
}

TEST_F(ImageOutput, WithoutANameItIsTheOneOfTheRenderLineAndIsTold) {
  const Outcome outcome = render({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "out.ppm\n");
  EXPECT_EQ(outcome.err, "");
  expect_only({"out.ppm"});
}

TEST_F(ImageOutput, WithANameTheProgramIsSilent) {
  const Outcome outcome = render({"-o", "image.ppm"});
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(ImageOutput, ASceneNeverChoosesItsDirectory) {
  for (const char* const path : {"/etc/plumb_evil.ppm", "../plumb_evil.ppm", "/plumb_evil.ppm",
                                 "deep/er/plumb_evil.ppm", "../../../../../../../etc/plumb_evil.ppm"}) {
    const Outcome outcome = render({}, replaced(ball_scene, "out.ppm", path));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "plumb_evil.ppm\n");
    expect_only({"plumb_evil.ppm"});
    ASSERT_EQ(unlink(workplace_.path("plumb_evil.ppm").c_str()), 0);
    for (const char* const elsewhere : {"/etc/plumb_evil.ppm", "/plumb_evil.ppm"}) {
      EXPECT_FALSE(std::filesystem::exists(elsewhere));
    }
    EXPECT_FALSE(std::filesystem::exists(workplace_.path("../plumb_evil.ppm")));
  }
}

TEST_F(ImageOutput, ASceneThatNamesNoImageFileIsTrouble) {
  for (const char* const name : {"..", "/", "deep/", "image.jpg", "image", ".ppm", "-", "/dev/full"}) {
    const Outcome outcome = render({}, replaced(ball_scene, "out.ppm", name));
    SCOPED_TRACE(name);
    expect_trouble(outcome, {".ppm", "-o"});
    EXPECT_TRUE(outcome.out.empty());
    expect_only({});
  }
}

TEST_F(ImageOutput, OtherExtensionsAreRefusedBeforeAnythingIsRendered) {
  for (const char* const name : {"image.jpg", "image.tiff", "image", "image.", "exr", "image.ppm.gz"}) {
    SCOPED_TRACE(name);
    // A picture of this size would take minutes.
    expect_trouble(render({"-o", name, "--size", "16000x16000"}), {name, ".exr", ".pfm", ".png", ".ppm"});
  }
  expect_only({});
}

TEST_F(ImageOutput, AMissingDirectoryIsNamed) {
  for (const char* const extension : {"ppm", "pfm", "png", "exr"}) {
    const std::string path = std::string("nowhere/image.") + extension;
    expect_trouble(render({"-o", path}), {path, "cannot be written"});
  }
  expect_only({});
}

TEST_F(ImageOutput, APlaceThatCannotBeWrittenIsNamed) {
  for (const char* const extension : {"ppm", "png"}) {
    const std::string in_proc = std::string("/proc/image.") + extension;
    expect_trouble(render({"-o", in_proc}), {in_proc, "cannot be written"});
    const std::string below_a_file = std::string("scene.sdf/image.") + extension;
    expect_trouble(render({"-o", below_a_file}), {below_a_file, "cannot be written"});
  }
  expect_only({});
}

TEST_F(ImageOutput, ADirectoryIsNotReplaced) {
  for (const char* const name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    std::filesystem::create_directory(workplace_.path(name));
    expect_trouble(render({"-o", name}), {name, "irectory"});
  }
  expect_only({"image.exr", "image.pfm", "image.png", "image.ppm"});
}

TEST_F(ImageOutput, AnOldFileIsReplaced) {
  for (const char* const name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    workplace_.file(name, std::string(100'000, 'x'));
    EXPECT_EQ(render({"-o", name}).exit_code, 0);
    EXPECT_LT(bytes_of(name).size(), 20'000U) << name;
    EXPECT_NE(bytes_of(name).front(), 'x') << name;
  }
  expect_only({"image.exr", "image.pfm", "image.png", "image.ppm"});
}

TEST_F(ImageOutput, AnOldFileStaysWhenRenderingFails) {
  for (const char* const name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    workplace_.file(name, "old");
    EXPECT_EQ(render({"-o", name}, "define nonsense\n").exit_code, 2);
    EXPECT_EQ(render({"-o", name, "--camera", "nobody"}).exit_code, 2);
    EXPECT_EQ(render({"-o", name, "--size", "0x0"}).exit_code, 2);
    EXPECT_EQ(bytes_of(name), "old") << name;
  }
  expect_only({"image.exr", "image.pfm", "image.png", "image.ppm"});
}

TEST_F(ImageOutput, AFileNameMayBeAsLongAsTheFileSystemAllows) {
  for (const char* const extension : {".ppm", ".png"}) {
    const std::string name = std::string(251, 'n') + extension;
    const Outcome outcome = render({"-o", name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_FALSE(bytes_of(name).empty());
  }
}

TEST_F(ImageOutput, APipeIsWrittenTo) {
  workplace_.file("scene.sdf", std::string(ball_scene));
  const auto result =
      run_shell("mkfifo pipe.ppm; cat pipe.ppm > got & \"$0\" render scene.sdf -o pipe.ppm; echo $?; wait",
                workplace_.directory());
  EXPECT_EQ(result.output, "0\n");
  ASSERT_EQ(render({"-o", "image.ppm"}).exit_code, 0);
  EXPECT_EQ(bytes_of("got"), bytes_of("image.ppm"));
  expect_only({"got", "image.ppm", "pipe.ppm"});
}

TEST_F(ImageOutput, AnImageCanBeReadByOthers) {
  const mode_t before = umask(022);
  for (const char* const name : {"image.ppm", "image.pfm", "image.png", "image.exr"}) {
    EXPECT_EQ(render({"-o", name}).exit_code, 0);
    struct stat info {};
    ASSERT_EQ(stat(workplace_.path(name).c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0644U) << name;
  }
  umask(before);
}

// --- what the options change ------------------------------------------------------------------

TEST_F(ImageOutput, SizeIsTakenInsteadOfTheScenes) {
  const Picture picture = rendered({"--size", "48x16"});
  EXPECT_EQ(picture.width, 48);
  EXPECT_EQ(picture.height, 16);
  ASSERT_EQ(render({"--size", "1x1"}).exit_code, 0);
  EXPECT_EQ(ascii_ppm_of(bytes_of("out.ppm")).header, "P3\n1 1\n255\n");
}

TEST_F(ImageOutput, SizesThatAreNoneAreRefused) {
  for (const char* const size : {"0x10",
                                 "10x0",
                                 "10",
                                 "x",
                                 "10x",
                                 "x10",
                                 "-5x5",
                                 "5x-5",
                                 "10x10x10",
                                 "1e3x5",
                                 "4.5x5",
                                 " 5x5",
                                 "5 x 5",
                                 "5X5",
                                 "70000x1",
                                 "1x65536",
                                 "65535x65535",
                                 "1000000000x1000000000",
                                 "99999999999999999999x99999999999999999999",
                                 "nanxnan"}) {
    SCOPED_TRACE(size);
    expect_trouble(render({"--size=" + std::string(size)}), {"--size", size});
  }
  expect_only({});
}

TEST_F(ImageOutput, CameraIsTakenInsteadOfTheScenes) {
  const std::string scene = std::string(ball_scene) + "define camera away 60 0 0 0 0 0 1 0 1 0\n";
  const Picture picture = rendered({"--camera", "away"}, scene);
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) ASSERT_EQ(picture.rgb[i], 0.1F);
  EXPECT_NE(rendered({"--camera", "eye"}, scene).at(16, 12)[0], 0.1F);
}

TEST_F(ImageOutput, AnUnknownCameraIsTroubleThatNamesTheKnownOnes) {
  const std::string scene = std::string(ball_scene) + "define camera away 60 0 0 0 0 0 1 0 1 0\n";
  expect_trouble(render({"--camera", "nobody"}, scene), {"nobody", "'eye'", "'away'"});
  expect_only({});
}

/// Below depth D all is black: a mirror before a bright background shows it only if it may reflect.
TEST_F(ImageOutput, DepthLimitsTheRecursion) {
  const std::string scene =
      "define material mirror 0 0 0 0 0 0 0 0 0 1 mirror 1 1 1\n"
      "define shape sphere ball 0 0 -3 1 mirror\n"
      "background 1 1 1\n"
      "define camera eye 60\n"
      "render eye out.ppm 9 9\n";
  EXPECT_EQ(rendered({"--depth", "1"}, scene).at(4, 4)[0], 0.0F);
  EXPECT_EQ(rendered({"--depth", "2"}, scene).at(4, 4)[0], 1.0F);
  EXPECT_EQ(rendered({}, scene).at(4, 4)[0], 1.0F);
}

TEST_F(ImageOutput, RealTypesDifferByTheirRounding) {
  rendered({"--real", "double"});
  ASSERT_EQ(render({"--real", "long-double", "-o", "long.pfm"}).exit_code, 0);
  ASSERT_EQ(render({"--real", "float", "-o", "single.pfm"}).exit_code, 0);
  ASSERT_EQ(render({"-o", "default.pfm"}).exit_code, 0);
  EXPECT_TRUE(bytes_of("default.pfm") == bytes_of("floats.pfm"));
  expect_equal("long.pfm", "floats.pfm", "2e-7");
  expect_equal("long.pfm", "single.pfm", "1e-4");
  EXPECT_FALSE(bytes_of("long.pfm") == bytes_of("single.pfm"));
}

TEST_F(ImageOutput, AnyNumberOfThreadsGivesTheSameBytes) {
  rendered({"--threads", "1", "--size", "101x67"});
  const std::string expected = bytes_of("floats.pfm");
  for (const char* const threads : {"2", "3", "64", "1024"}) {
    rendered({"--threads", threads, "--size", "101x67"});
    EXPECT_TRUE(bytes_of("floats.pfm") == expected) << threads;
  }
  rendered({"--size", "101x67"});
  EXPECT_TRUE(bytes_of("floats.pfm") == expected);
}

TEST_F(ImageOutput, GlassShadowIsFullNoneOrFiltered) {
  // The light shines through a pane on the floor that the eye looks down at, from below the pane.
  const std::string scene =
      "define material floor 0 0 0 1 1 1 0 0 0 1\n"
      "define material glass 0 0 0 0 0 0 0 0 0 1 transmit 0.5 0.25 1\n"
      "define shape box floor -5 -2 -5 5 -1 5 floor\n"
      "define shape box pane -5 1 -5 5 1.1 5 glass\n"
      "define light above 0 10 0 1 1 1 1\n"
      "define camera eye 10 0 0 0 0 -1 0 0 0 1\n"
      "render eye out.ppm 3 3\n";
  const auto centre = [&](const std::vector<std::string>& options) {
    const Picture picture = rendered(options, scene);
    const float* const c = picture.at(1, 1);
    return std::array<float, 3>{c[0], c[1], c[2]};
  };
  EXPECT_EQ(centre({"--glass-shadow", "full"}), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(centre({}), (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(centre({"--glass-shadow", "none"}), (std::array<float, 3>{1, 1, 1}));
  // Two surfaces.
  EXPECT_EQ(centre({"--glass-shadow", "filtered"}), (std::array<float, 3>{0.25F, 0.0625F, 1}));
}

TEST_F(ImageOutput, WarningsOfTheSceneAreSaidAndTheImageIsWritten) {
  const Outcome outcome = render({}, "ambient 1 1 1\n");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, "image.ppm\n");
  EXPECT_TRUE(contains(outcome.err, "scene.sdf:1:1: warning: no camera")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "scene.sdf:1:1: warning: no render")) << outcome.err;
  EXPECT_EQ(ascii_ppm_of(bytes_of("image.ppm")).header, "P3\n480 320\n255\n");
  expect_only({"image.ppm"});
}

}  // namespace
}  // namespace plumb::tests
