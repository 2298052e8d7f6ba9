#include "references/renderers/render_to_file.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "tracer/image/image_writer.hpp"
#include "tracer/system/stopwatch.hpp"

namespace plumb::renderers {
namespace {

/// Writes each band when the next is there: the last, or the only one, remains for finish(), when the
/// renderer has stopped its watch. The file is opened with the first, after the render of a small picture.
class Destination {
 public:
  Destination(const std::string& path, Encoding encoding, const RenderJob& job)
      : path_(path), encoding_(encoding), job_(job) {}

  void take(Image&& band) {
    if (newest_.height > 0) write_newest();
    newest_ = std::move(band);
  }
  void finish() {
    write_newest();
    writer_->finish();
  }
  bool is_of_one_colour() const { return is_of_one_colour_; }

 private:
  void write_newest() {
    if (!writer_) {
      writer_.emplace(path_, job_.width, job_.height, encoding_);
      std::copy_n(newest_.pixel(0, 0), first_.size(), first_.begin());
    }
    is_of_one_colour_ = is_of_one_colour_ && plumb::is_of_one_colour(newest_) &&
                        std::equal(first_.begin(), first_.end(), newest_.rgb.begin());
    writer_->write(newest_);
  }

  const std::string& path_;
  Encoding encoding_;
  const RenderJob& job_;
  std::optional<ImageWriter> writer_;
  Image newest_;
  std::array<float, 3> first_{};  ///< of the picture's pixels
  bool is_of_one_colour_ = true;
};

int rows_of_a_band(const RenderJob& job, const Streaming& streaming) {
  const std::int64_t pixels = std::int64_t{job.width} * job.height;
  if (pixels < streaming.from_pixels) return job.height;
  return static_cast<int>(std::clamp<std::int64_t>(streaming.band_pixels / job.width, 1, job.height));
}

}  // namespace

RenderedFile render_to_file(OwnTracer tracer, const Scene& scene, const Camera& camera, const RenderJob& job,
                            const std::string& path, Encoding encoding, engine::Statistics* statistics,
                            const Streaming& streaming) {
  Destination destination(path, encoding, job);
  render(tracer, scene, camera, job,
         {rows_of_a_band(job, streaming), [&](Image&& band) { destination.take(std::move(band)); }},
         statistics);
  const engine::Stopwatch writing;
  destination.finish();
  return {destination.is_of_one_colour(), writing.elapsed()};
}

}  // namespace plumb::renderers
