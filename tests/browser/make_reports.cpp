// Writes the reports that the browser tests look at. Usage: make_reports DIRECTORY one|few|many|beside|new
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "references/report/report_writer.hpp"

namespace {

using plumb::Image;
using plumb::report::ReportEntry;
using plumb::report::ReportWriter;

std::shared_ptr<Image> filled(int width, int height, float r, float g, float b) {
  auto image = std::make_shared<Image>(width, height);
  for (std::size_t i = 0; i < image->rgb.size(); i += 3) {
    image->rgb[i] = r;
    image->rgb[i + 1] = g;
    image->rgb[i + 2] = b;
  }
  return image;
}

ReportEntry entry_of(const std::string& name, const std::string& status, double max_error) {
  ReportEntry entry;
  entry.name = name;
  entry.result = {
      {"status", status}, {"message", ""}, {"max_error", max_error}, {"mean_error", max_error / 10}};
  entry.explain_command = "plumb explain " + name;
  return entry;
}

/// The reference is red, the test picture green: which of them is seen can be told from any pixel.
ReportEntry red_and_green() {
  ReportEntry entry = entry_of("scenes/red-green.sdf", "differ", 1);
  entry.reference = filled(40, 30, 1, 0, 0);
  entry.test = filled(40, 30, 0, 1, 0);
  entry.result["pixels_over"] = 1200;
  return entry;
}

/// Grey but for a few pixels whose values the tests know.
ReportEntry known_values() {
  ReportEntry entry = entry_of("scenes/values.sdf", "differ", 0.5);
  const auto reference = filled(40, 30, 0.25F, 0.25F, 0.25F);
  const auto test = std::make_shared<Image>(*reference);
  reference->pixel(3, 2)[0] = 12.5F;
  test->pixel(3, 2)[0] = 13.F;
  reference->pixel(5, 4)[1] = 0.1F;
  test->pixel(5, 4)[1] = std::nextafter(0.1F, 1.F);
  test->pixel(7, 6)[2] = std::numeric_limits<float>::quiet_NaN();
  test->pixel(8, 6)[2] = -std::numeric_limits<float>::infinity();
  test->pixel(20, 10)[0] = 0.375F;
  entry.reference = reference;
  entry.test = test;
  entry.notes = {{3, 2, "unexplained", "camera ray\n  hit <b>ball</b> at t = 2.5"},
                 {20, 10, "silhouette", ""}};
  entry.result.update({{"pixels_over", 4},
                       {"non_finite", 2},
                       {"worst", {{"x", 3}, {"y", 2}}},
                       {"budget", {{"silhouette", 1}, {"shadow_edge", 0}, {"unexplained", 3}}},
                       {"metrics", {{"psnr", 48.25}, {"flip", {{"mean", 0.125}}}}},
                       {"terms", {{"ambient", {{"max_error", 0.0}}}, {"diffuse", {{"max_error", 0.5}}}}}});
  entry.approve_command = "plumb regress scenes --update scenes/values.sdf --because 'WHY'";
  return entry;
}

/// As plumb regress reports a scene that nobody approved an image of.
ReportEntry never_approved() {
  ReportEntry entry;
  entry.name = "scenes/new.sdf";
  entry.result = {{"status", "differ"},
                  {"message", "new: there is no baseline yet"},
                  {"seconds", {{"ours", 0.25}, {"reference", 0}}},
                  {"not_compared", "there is nothing to compare with: no image was approved yet"},
                  {"tolerance", 1e-6}};
  entry.approve_command = "plumb regress scenes --update scenes/new.sdf --because 'WHY'";
  return entry;
}

void add_few(ReportWriter& writer) {
  writer.add(red_and_green());
  writer.add(known_values());
  ReportEntry same = entry_of("scenes/same.sdf", "agree", 0);
  same.reference = same.test = filled(64, 48, 0.2F, 0.4F, 0.6F);
  same.result["pixels_over"] = 0;
  writer.add(same);
  ReportEntry trouble;
  trouble.name =
      "scenes/</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1>\"'\u2028&amp;.sdf";
  trouble.result = {{"status", "error"}, {"message", "3:14: found `<!--<script>`, expected a number"}};
  writer.add(trouble);
}

void add_many(ReportWriter& writer) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> value(0, 1);
  for (int i = 0; i < 200; ++i) {
    ReportEntry entry =
        entry_of("scenes/" + std::to_string(i) + ".sdf", i % 3 == 0 ? "differ" : "agree", i * 1e-7);
    const auto reference = filled(120, 90, 0, 0, 0);
    for (float& each : reference->rgb) each = value(random);
    const auto test = std::make_shared<Image>(*reference);
    test->pixel(i % 120, i % 90)[0] += 0.125F;
    entry.reference = reference;
    entry.test = test;
    writer.add(entry);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("Usage: make_reports DIRECTORY one|few|many|beside|new\n", stderr);
    return 2;
  }
  const std::string kind = argv[2];
  const std::size_t most_inline = kind == "beside" ? 0 : ReportWriter::default_most_inline;
  ReportWriter writer(argv[1], "Report <i>of</i> tests", "against nothing & nobody", most_inline);
  if (kind == "one") {
    writer.add(red_and_green());
  } else if (kind == "new") {
    writer.add(never_approved());
    writer.add(red_and_green());  // a report of one scene has no overview
  } else if (kind == "many") {
    add_many(writer);
  } else {
    add_few(writer);
  }
  writer.finish();
  return 0;
}
