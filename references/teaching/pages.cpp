#include "references/teaching/pages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "references/report/escape.hpp"
#include "references/report/own_page.hpp"
#include "references/report/packing.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/encode.hpp"

namespace plumb::references::teaching {
namespace {

constexpr std::string_view style =
    ":root{color-scheme:light "
    "dark;--line:#d3d8df;--muted:#56606c;--good:#17642f;--bad:#a5201b;--raised:#eceff3}"
    "@media(prefers-color-scheme:dark){:root{--line:#2b323b;--muted:#9da8b5;--good:#6fd694;--bad:#ff9a92;"
    "--raised:#20262e}}"
    "body{max-width:64rem;margin:0 auto;padding:1rem;font:15px/1.5 system-ui,'DejaVu Sans',sans-serif}"
    "section{border-top:1px solid var(--line);padding:.5rem 0 1rem}h2{margin:1.5rem 0 .5rem}h3{margin:.5rem "
    "0}"
    "figure{margin:0;min-width:0;flex:1 1 0}figure img{width:100%;image-rendering:pixelated;display:block}"
    "figcaption,.muted{color:var(--muted);font-size:13px}"
    ".pictures{display:flex;gap:.75rem;margin:.75rem 0}"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;margin:.5rem "
    "0}dt{color:var(--muted)}"
    "dd{margin:0;overflow-wrap:anywhere}code{font-family:ui-monospace,'DejaVu Sans "
    "Mono',monospace;font-size:14px}"
    ".wrong code{color:var(--bad)}.right code{color:var(--good)}nav "
    "ul{columns:3;padding-left:1rem;margin:.25rem 0}"
    "nav li{overflow-wrap:anywhere;font-size:13px}@media(max-width:40rem){nav ul{columns:1}}";

textbook::RenderJob job_of(const RenderRequest& render) {
  textbook::RenderJob job;
  const double scale = std::min(1.0, 160.0 / render.width);
  job.width = static_cast<int>(render.width * scale);
  job.height = static_cast<int>(render.height * scale);
  return job;
}

std::string definition(std::string_view kind, std::string_view term, std::string_view text, bool is_code) {
  const std::string escaped = html_escaped(text);
  return "<dt>" + std::string(term) + "</dt><dd class=" + std::string(kind) + ">" +
         (is_code ? "<code>" + escaped + "</code>" : escaped) + "</dd>";
}

unsigned char byte_of(float level) {
  return std::isnan(level) ? 0 : static_cast<unsigned char>(std::clamp(level, 0.0F, 255.0F));
}

/// The fault's own scene, right and wrong.
std::string picture_pair(const Fault& fault, const std::string& scenes) {
  const Scene scene = load_scene(scenes + "/" + std::string(fault.shown_by), {});
  const RenderRequest& render = scene.renders.front();
  const Camera& camera = scene.camera(render.camera);
  const Picture right = picture_of(render_with(scene, camera, job_of(render), {}));
  const Picture wrong = picture_of(render_with(scene, camera, job_of(render), {&fault}));
  return "<div class=pictures>" + figure(right, "right") + figure(wrong, "with this mistake") +
         figure(difference_of(right, wrong), "where they differ, 4 times as bright") + "</div>";
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
  std::string html = "<nav>";
  for (const std::string_view slide : slides()) {
    html += "<p class=muted>" + html_escaped(slide) + "</p><ul>";
    for (const Fault& fault : fault_catalogue()) {
      if (fault.slide == slide)
        html += "<li><a href='#" + std::string(fault.id) + "'>" + std::string(fault.id) + "</a></li>";
    }
    html += "</ul>";
  }
  return html + "</nav>";
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
  constexpr int gain = 4;
  Picture difference{a.width, a.height, {}};
  for (std::size_t i = 0; i < a.levels.size(); ++i)
    difference.levels.push_back(
        static_cast<unsigned char>(std::min(255, gain * std::abs(int{a.levels[i]} - int{b.levels[i]}))));
  return difference;
}

std::string figure(const Picture& picture, std::string_view caption) {
  const std::string text = html_escaped(caption);
  return "<figure><img alt='" + text + "' width=" + std::to_string(picture.width) +
         " height=" + std::to_string(picture.height) + " style='height:auto' src='data:image/png;base64," +
         base64(png(picture.width, picture.height, 3, picture.levels)) + "'><figcaption>" + text +
         "</figcaption></figure>";
}

std::string page(std::string_view title, const std::string& body, std::string_view more_style) {
  return "<!DOCTYPE html><html lang=en><meta charset=utf-8>" + std::string(generator_tag) +
         "<meta name=viewport content='width=device-width'><meta http-equiv=Content-Security-Policy "
         "content=\"default-src "
         "'none'; "
         "img-src data:; style-src 'unsafe-inline'\"><title>" +
         html_escaped(title) + "</title><style>" + std::string(style) + std::string(more_style) +
         "</style><h1>" + html_escaped(title) + "</h1>\n" + body + "</html>\n";
}

std::string section_of(const Fault& fault, const std::string& scenes, const std::string& remark) {
  return "<section id=" + std::string(fault.id) + "><h3>" + html_escaped(fault.explanation) + "</h3>" +
         remark + "<dl>" + definition("wrong", "found", fault.wrong, true) +
         definition("right", "right", fault.right, true) + definition("slide", "slide", fault.slide, false) +
         definition("common", "tracers that had it", fault.how_common, false) +
         definition("scene", "shown by", "tests/scenes/" + std::string(fault.shown_by), true) +
         definition("id", "id", fault.id, true) + "</dl>" + picture_pair(fault, scenes) + "</section>\n";
}

std::string faults_page(const std::string& scenes, const std::function<void(double)>& progress) {
  std::string html = contents();
  std::size_t done = 0;
  for (const std::string_view slide : slides()) {
    html += "<h2>" + html_escaped(slide) + "</h2>\n";
    for (const Fault& fault : fault_catalogue()) {
      if (fault.slide != slide) continue;
      html += section_of(fault, scenes);
      progress(static_cast<double>(++done) / static_cast<double>(fault_catalogue().size()));
    }
  }
  return page("Mistakes of ray tracers", html);
}

}  // namespace plumb::references::teaching
