#include "references/report/fault_pages.hpp"

#include <algorithm>

#include "references/report/html/document.hpp"
#include "references/report/html/escape.hpp"
#include "references/teaching/picture.hpp"
#include "tracer/format/reader.hpp"

namespace plumb::report {
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

/// The fault's own scene, right and wrong.
std::string pictures_of(const faults::Fault& fault, const std::string& scenes) {
  const Scene scene = load_scene(scenes + "/" + std::string(fault.shown_by), {});
  const RenderRequest& render = scene.renders.front();
  const Camera& camera = scene.camera(render.camera);
  const teaching::Picture right =
      teaching::picture_of(faults::render_with(scene, camera, job_of(render), {}));
  const teaching::Picture wrong =
      teaching::picture_of(faults::render_with(scene, camera, job_of(render), {&fault}));
  return html::figures(teaching::three_pictures(right, wrong), fault.shown_by, ", with this mistake");
}

/// Slides in the order of the catalogue, each once.
std::vector<std::string_view> slides() {
  std::vector<std::string_view> all;
  for (const faults::Fault& fault : faults::fault_catalogue()) {
    if (std::find(all.begin(), all.end(), fault.slide) == all.end()) all.push_back(fault.slide);
  }
  return all;
}

std::string contents() {
  std::string text = "<nav>";
  for (const std::string_view slide : slides()) {
    text += html::paragraph(slide, "muted") + "<ul>";
    for (const faults::Fault& fault : faults::fault_catalogue()) {
      if (fault.slide == slide)
        text += html::element("li", "", html::link("#" + std::string(fault.id), fault.id));
    }
    text += "</ul>";
  }
  return text + "</nav>";
}

}  // namespace

std::string section_of(const faults::Fault& fault, const std::string& scenes, const std::string& remark) {
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
    for (const faults::Fault& fault : faults::fault_catalogue()) {
      if (fault.slide != slide) continue;
      text += section_of(fault, scenes);
      progress(static_cast<double>(++done) / static_cast<double>(faults::fault_catalogue().size()));
    }
  }
  return html::page(
      {"Mistakes of ray tracers",
       "plumb knows " + std::to_string(faults::fault_catalogue().size()) +
           " mistakes that real ray tracers make; each stands here with its formula and its picture.",
       text, ""});
}

}  // namespace plumb::report
