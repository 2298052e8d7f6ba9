// Results that are kept as they come: all of them, whatever ends the run, and nothing of other files.
#include <sys/resource.h>

#include <csignal>
#include <limits>

#include "references/report/class_json.hpp"
#include "references/report/class_report.hpp"
#include "references/submissions/fingerprint.hpp"
#include "references/submissions/journal.hpp"
#include "references/submissions/no_picture.hpp"
#include "references/submissions/shown_text.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

namespace fs = std::filesystem;
using submissions::Journal;
using submissions::JudgedPicture;

std::string key(std::size_t i) {
  const std::string number = std::to_string(i);
  return std::string(64 - number.size(), '0') + number;
}

/// One of each verdict, with a diagnosis where that has one, and texts that JSON has to escape.
std::vector<JudgedPicture> one_of_each() {
  std::vector<JudgedPicture> all;
  for (int verdict = 0; verdict < static_cast<int>(submissions::Judged::trouble); ++verdict) {
    JudgedPicture picture;
    picture.submission = "=\"<b>\n\x01" + std::to_string(verdict);
    picture.scene = "s\xc3\xa9";
    picture.verdict = static_cast<submissions::Judged>(verdict);
    picture.message = verdict % 2 == 0 ? "" : "a \\ message";
    picture.printed = "\t<img>";
    picture.wall_seconds = 0.1 * verdict;
    all.push_back(picture);
  }
  diagnosis::Diagnosis right;
  right.verdict = diagnosis::PictureVerdict::right;
  right.encoding = {true, diagnosis::Curve::srgb, true, true, false};
  right.rms = 1.0 / 3;
  right.pixels = 768;
  all[0].diagnosis = right;
  diagnosis::Diagnosis apart = right;
  apart.verdict = diagnosis::PictureVerdict::right_apart;
  apart.encoding.has_equal_parts = true;
  apart.encoding.levels = {32, 64, 32};
  apart.encoding.lost = 0.1F;
  apart.encoding.shares_exponent = true;
  apart.non_finite = 1;
  apart.edges = 2;
  apart.unexplained_pixels = 9;
  apart.habits = {{"background", "Where nothing is hit, it is black.", Rgbd(0, 1.0 / 3, 0.5)}};
  apart.certain = {diagnosis::Certainty::right, diagnosis::Certainty::right, diagnosis::Certainty::unknown};
  apart.shapes = {{"tiny", 8}, {"", 1}};
  all[1].diagnosis = apart;
  diagnosis::Diagnosis wrong = right;
  wrong.verdict = diagnosis::PictureVerdict::faults;
  wrong.is_flipped = true;
  wrong.pixels_over = 3;
  const auto& faults = faults::fault_catalogue();
  wrong.faults = {{&faults[2], 0.1 + 0.2, 77, {&faults[5], &faults[6]}},
                  {&faults[1], 1, 5, {}},
                  {&faults::geometry_families().front(), 0.95, 9, {}},
                  {&faults::shading_families().at(3), 0.9, 8, {&faults::shading_families().at(30)}, 11}};
  wrong.certain = {diagnosis::Certainty::wrong, diagnosis::Certainty::unknown, diagnosis::Certainty::wrong};
  all[2].diagnosis = wrong;
  wrong.verdict = diagnosis::PictureVerdict::unexplained;
  wrong.faults.clear();
  wrong.rms = std::numeric_limits<double>::quiet_NaN();
  all[3].diagnosis = wrong;
  return all;
}

/// Everything that is told of results.
std::string told(const std::vector<JudgedPicture>& all, const std::string& report) {
  std::string text;
  for (int hint = 1; hint <= 3; ++hint) {
    text += report::overview_json(all, hint).dump() + report::overview_csv(all, hint) +
            report::overview_junit(all, hint);
    report::write_overview(report, all, hint);
    for (const std::string& page : listing(report)) text += read_file(report + "/" + page);
  }
  return text;
}

report::html::ThreePictures pictures(std::size_t i) { return {"right", "yours", std::to_string(i)}; }

TEST(Journal, WhatIsKeptIsToldTheSame) {
  const Workplace place;
  std::vector<JudgedPicture> all = one_of_each();
  {
    Journal journal(place.path("j"));
    for (std::size_t i = 0; i < all.size(); ++i) journal.keep(key(i), all[i], pictures(i));
  }
  const Journal journal(place.path("j"));
  EXPECT_EQ(journal.found(), all.size());
  std::vector<JudgedPicture> found;
  for (std::size_t i = 0; i < all.size(); ++i) {
    found.push_back(journal.find(key(i)).value());
    const auto kept = journal.pictures_of(found.back()).value();
    EXPECT_EQ(kept.right + kept.yours + kept.difference, "rightyours" + std::to_string(i));
  }
  EXPECT_EQ(told(found, place.path("found")), told(all, place.path("all")));
  EXPECT_FALSE(journal.find(key(99)));
}

TEST(Journal, IsReadUpToWhereItWasTorn) {
  const Workplace place;
  std::vector<JudgedPicture> all = one_of_each();
  all.resize(3);
  {
    Journal journal(place.path("j"));
    for (std::size_t i = 0; i < all.size(); ++i) journal.keep(key(i), all[i], {});
  }
  const std::string whole = read_file(place.path("j"));
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::string torn = whole.substr(0, size);
    place.file("torn", torn);
    const auto lines = static_cast<std::size_t>(std::count(torn.begin(), torn.end(), '\n'));
    Journal journal(place.path("torn"));
    ASSERT_EQ(journal.found(), lines == 0 ? 0 : lines - 1) << size;
    for (std::size_t i = 0; i < all.size(); ++i)
      ASSERT_EQ(journal.find(key(i)).has_value(), i + 1 < lines) << size;
    journal.keep(key(7), all[0], {});
  }
  Journal again(place.path("torn"));
  EXPECT_EQ(again.found(), 4U);
}

TEST(Journal, AnotherFileIsLeftAsItIs) {
  const Workplace place;
  for (const std::string& text : {std::string(ball_scene), std::string("x"), std::string("\n\n")}) {
    place.file("scene.sdf", text);
    EXPECT_THROW(Journal(place.path("scene.sdf")), std::runtime_error);
    EXPECT_EQ(read_file(place.path("scene.sdf")), text);
  }
}

TEST(Journal, IsOneRunsAlone) {
  const Workplace place;
  const Journal one(place.path("j"));
  EXPECT_THROW(Journal(place.path("j")), std::runtime_error);
}

TEST(Journal, AFullDiskSpoilsNothing) {
  const Workplace place;
  std::vector<JudgedPicture> all = one_of_each();
  Journal journal(place.path("j"));
  journal.keep(key(0), all[0], {});
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{fs::file_size(place.path("j")) + 10, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  EXPECT_THROW(journal.keep(key(1), all[1], {}), std::runtime_error);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(journal.find(key(1)));
  journal.keep(key(2), all[2], {});
  EXPECT_TRUE(journal.find(key(0)) && journal.find(key(2)));
}

TEST(Fingerprint, ChangesWithAnyChange) {
  const Workplace place;
  fs::create_directories(place.path("d/e"));
  place.file("d/e/f", "one");
  std::string last = submissions::fingerprint_of(place.path("d"));
  EXPECT_EQ(submissions::fingerprint_of(place.path("d")), last);
  const auto expect_change = [&](const char* what) {
    const std::string now = submissions::fingerprint_of(place.path("d"));
    EXPECT_NE(now, last) << what;
    last = now;
  };
  place.file("d/e/f", "two!");
  expect_change("bytes");
  fs::permissions(place.path("d/e/f"), fs::perms(0700));
  expect_change("mode");
  place.file("d/g", "");
  expect_change("another file");
  fs::rename(place.path("d/g"), place.path("d/h"));
  expect_change("name");
  fs::create_directories(place.path("d/out"));
  place.file("d/journal", "");
  expect_change("a file and a directory");
  const std::vector<std::string> out{place.path("d/out"), place.path("d/journal"), place.path("d/later")};
  last = submissions::fingerprint_of(place.path("d"), out);
  place.file("d/out/page", "");
  place.file("d/journal", "longer");
  place.file("d/later", "");
  EXPECT_EQ(submissions::fingerprint_of(place.path("d"), out), last) << "what is left out";
  place.file("d/another", "");
  EXPECT_NE(submissions::fingerprint_of(place.path("d"), out), last);
  EXPECT_THROW(submissions::fingerprint_of(place.path("none")), std::runtime_error);
}

TEST(NoPicture, TellsAPrintedPictureFromWords) {
  const auto printed = [](std::string_view text) { return submissions::printed_image(std::string(text)); };
  EXPECT_EQ(printed("P3\n2 2\n255\n"), "PPM (P3)");
  EXPECT_EQ(printed("rendering ...\nP6 # by me\n2 2 255\n"), "PPM (P6)");
  EXPECT_EQ(printed("PF\n2 2\n-1\n"), "PFM (PF)");
  EXPECT_EQ(printed("\x89PNG\r\n\x1a\n"), "PNG");
  EXPECT_EQ(printed("done\n\x89PNG\r\n\x1a\n"), "PNG");
  for (const char* const words :
       {"", "P", "P3", "P3\n", "P3 is written\n", "P7 2 2", "xP3\n2 2", "Program 3"})
    EXPECT_EQ(printed(words), "") << words;
}

TEST(ShownName, IsUtf8WhateverTheName) {
  EXPECT_EQ(submissions::shown_name("ad\xc3\xa9"), "ad\xc3\xa9");
  EXPECT_EQ(submissions::shown_name("ad\xe9"), "ad\\xe9");
  EXPECT_EQ(submissions::shown_name("a\\b"), "a\\b");
  EXPECT_EQ(submissions::shown_name("ad\\xe9"), "ad\\x5cxe9") << "would be shown as the name before";
  EXPECT_EQ(submissions::shown_text("ad\xe9!"), "ad\xEF\xBF\xBD!");
}

}  // namespace
}  // namespace plumb::tests
