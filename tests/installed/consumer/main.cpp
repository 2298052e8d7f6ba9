// Usage: consumer SCENE RENDERED.exr EXPORTED.pov: renders the scene, exports it, reads the picture again and
// compares; exit code 0 when both pictures are the same.
#include <fstream>
#include <iostream>

#include "exporters/povray.hpp"
#include "references/comparison/comparison.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/image/io.hpp"
#include "tracer/textbook/render.hpp"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const plumb::Scene scene = plumb::load_scene(argv[1], plumb::Dialect{});
  plumb::RenderJob job;
  job.width = 40;
  job.height = 30;
  const plumb::Image rendered = plumb::textbook::render(scene, scene.cameras.front(), job);
  plumb::write_image(argv[2], rendered, plumb::Encoding::linear);
  std::ofstream(argv[3])
      << plumb::exporters::export_povray({scene, scene.cameras.front(), job.width, job.height}).text;
  plumb::Image again(job.width, job.height);
  again.rgb = plumb::read_image(argv[2]).values;
  const auto compared = plumb::comparison::compare(rendered, again, 1e-6);
  std::cout << compared.pixels_over << " pixels differ\n";
  return compared.agrees() ? 0 : 1;
}
