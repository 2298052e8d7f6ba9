// The report's file: what is packed comes out bit by bit, nothing in it is taken for HTML, nothing
// half-written.
#include "references/report/report_writer.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>
#include <thread>

#include "references/report/html/escape.hpp"
#include "references/report/html/packing.hpp"
#include "references/report/html/thumbnail.hpp"
#include "references/report/html/web.hpp"
#include "references/report/picture.hpp"
#include "references/report/script_json.hpp"
#include "tests/support/end_to_end.hpp"

namespace plumb::tests {
namespace {

using namespace plumb::report;
using Json = nlohmann::json;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

std::shared_ptr<Image> image(int width, int height, std::vector<float> values) {
  auto made = std::make_shared<Image>(width, height);
  made->rgb = std::move(values);
  return made;
}

ReportEntry small_entry(const std::string& name = "a.sdf") {
  ReportEntry entry;
  entry.name = name;
  entry.result = {{"status", "differ"}};
  entry.reference = image(2, 1, {0.1F, -0.F, nan, 12.5F, infinity, 1e-40F});
  entry.test = image(2, 1, {0.1F, 0.F, std::bit_cast<float>(0x7fc12345U), 12.5F, -infinity, nan});
  entry.notes = {{1, 0, "unexplained", "why"}};
  return entry;
}

std::string from_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(letters.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
  }
  return bytes;
}

std::string inflated(const std::string& packed, std::size_t most = 1 << 20) {
  std::string bytes(most, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

/// The value of a channel of a pixel whose bytes stand apart, as the page reads them.
std::uint32_t bits_at(const std::string& bytes, std::size_t start, std::size_t pixels, std::size_t i) {
  std::uint32_t bits = 0;
  for (std::size_t byte = 4; byte-- > 0;) {
    bits = bits << 8 | static_cast<unsigned char>(bytes.at(start + (4 * (i % 3) + byte) * pixels + i / 3));
  }
  return bits;
}

std::string page_of(const Workplace& place) { return read_file(place.path("out/index.html")); }

Json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"report-data\">";
  const std::size_t begin = page.find(open) + open.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(ReportPicture, EveryBitComesBack) {
  const ReportEntry entry = small_entry();
  const std::string bytes = inflated(deflated(picture_bytes(entry)));
  for (std::size_t i = 0; i < 6; ++i) {
    const std::uint32_t reference = bits_at(bytes, 0, 2, i);
    EXPECT_EQ(reference, std::bit_cast<std::uint32_t>(entry.reference->rgb[i])) << i;
    EXPECT_EQ(reference ^ bits_at(bytes, 24, 2, i), std::bit_cast<std::uint32_t>(entry.test->rgb[i])) << i;
  }
  EXPECT_EQ(bytes.substr(48, 2), (std::string{0, 1}));
  EXPECT_EQ(Json::parse(bytes.substr(50)), (Json{{"1", "why"}}));
}

TEST(ReportPicture, AToleranceMarksPixelsWithoutANoteEach) {
  ReportEntry entry = small_entry();
  entry.notes.clear();
  entry.reference = image(2, 1, {0, 0, 0, 0, 0, 0});
  entry.test = image(2, 1, {0, 0, 0, 0, 0.5F, 0});
  entry.tolerance = 0.25;
  EXPECT_EQ(picture_bytes(entry).substr(48), (std::string{0, 1} + "{}"));
  EXPECT_EQ(causes_of(entry), std::vector<std::string>{"over"});
  entry.tolerance = 0.5;
  EXPECT_EQ(picture_bytes(entry).substr(48), (std::string{0, 0} + "{}"));
  EXPECT_TRUE(causes_of(entry).empty());
}

TEST(ReportPicture, EqualPicturesCostNextToNothing) {
  ReportEntry entry = small_entry();
  auto noise = std::make_shared<Image>(200, 100);
  for (std::size_t i = 0; i < noise->rgb.size(); ++i)
    noise->rgb[i] = 1.F / static_cast<float>(i * 7919 % 65537 + 1);
  entry.notes.clear();
  entry.reference = entry.test = noise;
  const std::size_t both = deflated(picture_bytes(entry)).size();
  const std::size_t half = deflated(picture_bytes(entry).substr(0, 12 * 200 * 100)).size();
  EXPECT_LT(both - half, std::size_t{12 + 1} * 200 * 100 / 100);  // a hundredth of their bytes
}

TEST(ReportPicture, WhatDoesNotFitIsRefused) {
  ReportEntry sizes = small_entry();
  sizes.test = image(1, 1, {0, 0, 0});
  ReportEntry outside = small_entry();
  outside.notes.push_back({2, 0, "silhouette", ""});
  for (const ReportEntry& entry : {sizes, outside}) {
    try {
      picture_bytes(entry);
      FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(contains(error.what(), "a.sdf: ")) << error.what();
      EXPECT_TRUE(contains(error.what(), "expected")) << error.what();
    }
  }
}

TEST(ReportPacking, Base64IsThatOfTheStandard) {
  const std::vector<std::pair<std::string, std::string>> known{
      {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}};  // RFC 4648, 10
  for (const auto& [bytes, text] : known) EXPECT_EQ(base64(bytes), text);
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ReportPacking, ThumbnailsArePngFiles) {
  const std::string png = thumbnail(*image(1, 2, {1, 0, 0, 0, 0, 2}));
  EXPECT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n"));
  const std::string lines = inflated(png.substr(png.find("IDAT") + 4));
  EXPECT_EQ(lines, (std::string{0, '\xff', 0, 0, 0, 0, 0, '\xff'}));
  const auto wide = std::make_shared<Image>(1000, 10);
  EXPECT_EQ(thumbnail(*wide).substr(16, 8), (std::string{0, 0, 0, '\x90', 0, 0, 0, 1}));  // 144 x 1
}

TEST(ReportPacking, OnePixelIsNotLostInAnErrorThumbnail) {
  const Image right(1000, 500);
  Image shown = right;
  shown.pixel(777, 333)[1] = 1;
  const std::string png = error_thumbnail(right, shown);
  const std::string lines = inflated(png.substr(png.find("IDAT") + 4));
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\xff'), 1);
}

TEST(ReportThumbnail, ValuesThatAreEncodedGetNoCurve) {
  Image image(1, 1);
  image.rgb = {0.F, 100.F / 255.F, 1.F};
  const auto samples = [](const std::string& png) { return inflated(png.substr(png.find("IDAT") + 4)); };
  EXPECT_EQ(samples(thumbnail(image, true)), std::string("\0\0\x64\xff", 4));
  EXPECT_EQ(samples(thumbnail(image)), std::string("\0\0\xa8\xff", 4));
}

TEST(ReportEscape, NothingEndsTheScript) {
  const std::string hostile = "</script><!--<script>&\"'\xe2\x80\xa8\xe2\x80\xa9\xff";
  const std::string text = script_json({{"name", hostile}});
  for (const char* const part : {"<", ">", "&", "\xe2\x80\xa8", "\xe2\x80\xa9"})
    EXPECT_FALSE(contains(text, part)) << part;
  EXPECT_EQ(Json::parse(text).at("name"), hostile.substr(0, hostile.size() - 1) + "\xef\xbf\xbd");
  EXPECT_EQ(html_escaped("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;");
}

TEST(ReportPage, HostileNamesStayData) {
  const Workplace place;
  ReportWriter writer(place.path("out"), "</title><script>{{data}}", "{{script}}");
  writer.add(small_entry("</script><script>alert(1)</script>{{style}}"));
  writer.finish();
  const std::string page = page_of(place);
  EXPECT_EQ(data_of(page).at("scenes").at(0).at("name"), "</script><script>alert(1)</script>{{style}}");
  EXPECT_EQ(data_of(page).at("subtitle"), "{{script}}");
  EXPECT_TRUE(contains(page, "<title>&lt;/title&gt;&lt;script&gt;{{data}}</title>"));
  EXPECT_FALSE(contains(page, "<script>alert"));
}

TEST(ReportPage, ItsPartsDoNotEndThemselves) {
  EXPECT_FALSE(contains(std::string(web::script), "</script"));
  EXPECT_FALSE(contains(std::string(web::script), "<!--"));
  EXPECT_FALSE(contains(std::string(web::style), "</style"));
}

TEST(ReportPage, NamesNoOtherPlace) {
  const Workplace place;
  ReportWriter writer(place.path("out"), "t", "");
  writer.add(small_entry());
  writer.finish();
  const std::string page = page_of(place);
  EXPECT_TRUE(contains(page, "default-src 'none'"));
  const std::regex loads("(src|href)=[\"']?(https?:)?//|@import|url\\([\"']?(https?:)?//");
  EXPECT_FALSE(std::regex_search(page.substr(0, page.find("report-data")), loads));
}

TEST(ReportWriterFiles, NothingBeforeTheEnd) {
  const Workplace place;
  const std::string old = "<meta name=\"generator\" content=\"plumb\">old";
  place.file("index.html", old);
  ReportWriter writer(place.directory(), "t", "");
  writer.add(small_entry());
  EXPECT_EQ(read_file(place.path("index.html")), old);
  EXPECT_EQ(listing(place.directory()), std::vector<std::string>{"index.html"});
  writer.finish();
  EXPECT_TRUE(contains(read_file(place.path("index.html")), "report-data"));
  EXPECT_EQ(listing(place.directory()), std::vector<std::string>{"index.html"});
}

TEST(ReportWriterFiles, APageOfSomebodyElseIsNotReplaced) {
  const Workplace place;
  place.file("index.html", "<h1>mine</h1>");
  EXPECT_THROW(ReportWriter(place.directory(), "t", ""), std::runtime_error);
  EXPECT_EQ(read_file(place.path("index.html")), "<h1>mine</h1>");
  const Workplace other;
  for (int i = 0; i < 2; ++i) {
    ReportWriter writer(other.directory(), "t", "");
    writer.add(small_entry());
    EXPECT_NO_THROW(writer.finish()) << "its own are";
  }
}

TEST(ReportWriterFiles, AFailureLeavesNothing) {
  const Workplace place;
  std::filesystem::create_directories(place.path("out/index.html"));
  ReportWriter writer(place.path("out"), "t", "");
  writer.add(small_entry());
  EXPECT_THROW(writer.finish(), std::runtime_error);
  EXPECT_EQ(listing(place.path("out")), std::vector<std::string>{"index.html"});
  const std::string file = place.file("plain", "");
  EXPECT_THROW(ReportWriter(file, "t", ""), std::runtime_error);
}

TEST(ReportWriterFiles, BeyondTheLimitPicturesLieBeside) {
  const Workplace place;
  ReportWriter first(place.directory(), "t", "", 0);
  first.add(small_entry());
  first.finish();
  const std::string page = read_file(place.path("index.html"));
  const std::string id = data_of(page).at("scenes").at(0).at("picture");
  const std::string script = read_file(place.path("pictures/" + id + ".js"));
  const std::string head = "plumb_picture(\"" + id + "\",\"";
  ASSERT_TRUE(script.starts_with(head)) << script.substr(0, 80);
  const std::string text = script.substr(head.size(), script.find('"', head.size()) - head.size());
  EXPECT_EQ(inflated(from_base64(text)), picture_bytes(small_entry()));
  EXPECT_FALSE(contains(page, text));

  place.file("pictures/mine.js", "");
  ReportWriter second(place.directory(), "t", "");
  second.add(small_entry());
  second.finish();
  EXPECT_EQ(listing(place.directory()),
            (std::vector<std::string>{"index.html", "pictures", "pictures/mine.js"}));
}

TEST(ReportWriterFiles, ScenesInTroubleHaveNoPictures) {
  const Workplace place;
  ReportWriter writer(place.path("out"), "t", "");
  ReportEntry entry;
  entry.name = "broken.sdf";
  entry.result = {{"status", "error"}, {"max_error", nan}};
  writer.add(entry);
  writer.finish();
  const Json scene = data_of(page_of(place)).at("scenes").at(0);
  EXPECT_EQ(scene.at("picture"), "");
  EXPECT_TRUE(scene.at("result").at("max_error").is_null());
}

TEST(ReportWriterFiles, ThreadsMayAdd) {
  const Workplace place;
  ReportWriter writer(place.path("out"), "t", "", 2000);  // moves beside on the way
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&writer, t] {
      for (int i = 0; i < 10; ++i) writer.add(small_entry(std::to_string(10 * t + i)));
    });
  }
  for (std::thread& thread : threads) thread.join();
  writer.finish();
  std::set<std::string> names;
  std::set<std::string> pictures;
  const Json data = data_of(page_of(place));
  for (const Json& scene : data.at("scenes")) {
    names.insert(scene.at("name"));
    pictures.insert(scene.at("picture"));
    EXPECT_TRUE(std::filesystem::exists(
        place.path("out/pictures/" + scene.at("picture").get<std::string>() + ".js")));
  }
  EXPECT_EQ(names.size(), 40U);
  EXPECT_EQ(pictures.size(), 40U);
}

}  // namespace
}  // namespace plumb::tests
