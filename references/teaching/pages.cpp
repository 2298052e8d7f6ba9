#include "references/teaching/pages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "references/report/html/escape.hpp"
#include "references/report/html/packing.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::references::teaching {
namespace {

textbook::RenderJob job_of(const RenderRequest& render) {
  textbook::RenderJob job;
  const double scale = std::min(1.0, 160.0 / render.width);
  job.width = static_cast<int>(render.width * scale);
  job.height = static_cast<int>(render.height * scale);
  return job;
}

/// A formula, and whose it is.
std::string formula(std::string_view whose, std::string_view text) {
  return html::element("code", whose, html_escaped(text));
}

unsigned char byte_of(float level) {
  return std::isnan(level) ? 0 : static_cast<unsigned char>(std::clamp(level, 0.0F, 255.0F));
}

/// The fault's own scene, right and wrong.
std::string pictures_of(const Fault& fault, const std::string& scenes) {
  const Scene scene = load_scene(scenes + "/" + std::string(fault.shown_by), {});
  const RenderRequest& render = scene.renders.front();
  const Camera& camera = scene.camera(render.camera);
  const Picture right = picture_of(render_with(scene, camera, job_of(render), {}));
  const Picture wrong = picture_of(render_with(scene, camera, job_of(render), {&fault}));
  return html::figures(three_pictures(right, wrong), fault.shown_by, ", with this mistake");
}

/// Slides in the order of the catalogue, each once.
std::vector<std::string_view> slides() {
  std::vector<std::string_view> all;
  for (const Fault& fault : fault_catalogue()) {
    if (std::find(all.begin(), all.end(), fault.slide) == all.end()) all.push_back(fault.slide);
  }
  return all;
}

std::string contents() {
  std::string text = "<nav>";
  for (const std::string_view slide : slides()) {
    text += html::paragraph(slide, "muted") + "<ul>";
    for (const Fault& fault : fault_catalogue()) {
      if (fault.slide == slide)
        text += html::element("li", "", html::link("#" + std::string(fault.id), fault.id));
    }
    text += "</ul>";
  }
  return text + "</nav>";
}

}  // namespace

Picture picture_of(const Image& image) {
  return {image.width, image.height, encode_8_bits(image, Encoding::course)};
}

Picture picture_of(const ImageFile& image) {
  Picture picture{image.width, image.height, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i + channels <= image.values.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c)
      picture.levels.push_back(byte_of(255 * image.values[i + (channels < 3 ? 0 : c)] + 0.5F));
  }
  return picture;
}

Picture picture_of(const Image& image, const OutputEncoding& encoding) {
  Picture picture{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    picture.levels.push_back(byte_of(encoding.level(image.rgb[i], i % 3) + 0.5F));
  return picture;
}

Picture difference_of(const Picture& a, const Picture& b) {
  Picture difference{a.width, a.height, {}};
  for (std::size_t i = 0; i < a.levels.size(); ++i)
    difference.levels.push_back(static_cast<unsigned char>(
        std::min(255, html::difference_gain * std::abs(int{a.levels[i]} - int{b.levels[i]}))));
  return difference;
}

html::ThreePictures three_pictures(const Picture& right, const Picture& yours) {
  const auto packed = [](const Picture& p) { return base64(png(p.width, p.height, 3, p.levels)); };
  return {packed(right), packed(yours), packed(difference_of(right, yours))};
}

std::string section_of(const Fault& fault, const std::string& scenes, const std::string& remark) {
  const std::string scene = "tests/scenes/" + std::string(fault.shown_by);
  return "<section id=\"" + std::string(fault.id) + "\">" +
         html::element("h3", "", html_escaped(fault.explanation)) + remark +
         html::definitions({{"right", formula("right", fault.right)},
                            {"yours, with this mistake", formula("yours", fault.wrong)},
                            {"slide", html_escaped(fault.slide)},
                            {"tracers that had it", html_escaped(fault.how_common)},
                            {"shown by", formula("", scene)},
                            {"id", formula("", fault.id)}}) +
         pictures_of(fault, scenes) + "</section>\n";
}

std::string faults_page(const std::string& scenes, const std::function<void(double)>& progress) {
  std::string text = contents();
  std::size_t done = 0;
  for (const std::string_view slide : slides()) {
    text += html::element("h2", "", html_escaped(slide)) + "\n";
    for (const Fault& fault : fault_catalogue()) {
      if (fault.slide != slide) continue;
      text += section_of(fault, scenes);
      progress(static_cast<double>(++done) / static_cast<double>(fault_catalogue().size()));
    }
  }
  return html::page(
      {"Mistakes of ray tracers",
       "plumb knows " + std::to_string(fault_catalogue().size()) +
           " mistakes that real ray tracers make; each stands here with its formula and its picture.",
       text, ""});
}

}  // namespace plumb::references::teaching
