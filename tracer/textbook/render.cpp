#include "tracer/textbook/render.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "tracer/textbook/tracer.hpp"

namespace plumb::textbook {
namespace {

template <class Real>
using LectureTracer = Tracer<Real, LectureFormulas<Real>>;

template <class Real>
void render_row(const LectureTracer<Real>& tracer, int y, Image& image) {
  for (int x = 0; x < image.width; ++x) {
    const Rgb<Real> colour = tracer.raycast(x, y);
    for (int channel = 0; channel < 3; ++channel)
      image.pixel(x, y)[channel] = static_cast<float>(colour[channel]);
  }
}

/// Runs `row(y)` for all rows on several threads; the first exception ends all and is thrown again.
template <class Row>
void for_each_row(int height, int threads, const std::function<void(double)>& progress, const Row& row) {
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  int done = 0;
  const auto work = [&] {
    try {
      for (int y = next++; y < height; y = next++) {
        row(y);
        const std::lock_guard lock(mutex);
        ++done;
        if (progress) progress(static_cast<double>(done) / height);
      }
    } catch (...) {
      next = height;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  helpers.clear();
  if (failure) std::rethrow_exception(failure);
}

template <class Real>
Image render_in(const Scene& scene, const Camera& camera, const RenderJob& job) {
  const World<Real, LectureFormulas<Real>> world(scene, {});
  const LectureTracer<Real> tracer(world, camera, job.width, job.height, job.options);
  Image image(job.width, job.height);
  const int available = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int threads = std::clamp(job.threads > 0 ? job.threads : available, 1, job.height);
  for_each_row(job.height, threads, job.progress, [&](int y) { render_row(tracer, y, image); });
  return image;
}

}  // namespace

Image render(const Scene& scene, const Camera& camera, const RenderJob& job) {
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
