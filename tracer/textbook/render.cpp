#include "tracer/textbook/render.hpp"

#include <stdexcept>
#include <string>

#include "tracer/textbook/rows.hpp"
#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

template <class Real>
Image render_in(const Scene& scene, const Camera& camera, const RenderJob& job) {
  const World<Real, LectureFormulas<Real>> world(scene, {});
  const Tracer<Real, LectureFormulas<Real>> tracer(world, camera, job.width, job.height, job.options);
  return render_rows(tracer, job);
}

}  // namespace

Image render(const Scene& scene, const Camera& camera, const RenderJob& job) {
  if (job.samples != 1)
    throw std::invalid_argument("found " + std::to_string(job.samples) +
                                " samples a pixel, expected 1: the textbook tracer, which renders "
                                "long-double, too, takes the pixel's centre");
  switch (job.real) {
    case RealType::float32:
      return render_in<float>(scene, camera, job);
    case RealType::long_double:
      return render_in<long double>(scene, camera, job);
    case RealType::float64:
      break;
  }
  return render_in<double>(scene, camera, job);
}

}  // namespace plumb::textbook
