#include "tracer/textbook/render.hpp"

#include <stdexcept>
#include <string>

#include "tracer/formulas/quad.hpp"
#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

template <class Real>
void render_in(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink) {
  const World<Real, LectureFormulas<Real>> world(scene, {});
  const Tracer<Real, LectureFormulas<Real>> tracer(world, camera, job.width, job.height, job.options);
  render_bands(tracer, job, sink);
}

}  // namespace

void render(const Scene& scene, const Camera& camera, const RenderJob& job, const BandSink& sink) {
  if (job.samples != 1)
    throw std::invalid_argument("found " + std::to_string(job.samples) +
                                " samples a pixel, expected 1: the textbook tracer, which renders "
                                "long-double and quad, too, takes the pixel's centre");
  switch (job.real) {
    case RealType::float32:
      return render_in<float>(scene, camera, job, sink);
    case RealType::long_double:
      return render_in<long double>(scene, camera, job, sink);
    case RealType::quad:
      return render_in<Quad>(scene, camera, job, sink);
    case RealType::float64:
      break;
  }
  return render_in<double>(scene, camera, job, sink);
}

Image render(const Scene& scene, const Camera& camera, const RenderJob& job) {
  return in_one_band(job.height, [&](const BandSink& sink) { render(scene, camera, job, sink); });
}

}  // namespace plumb::textbook
