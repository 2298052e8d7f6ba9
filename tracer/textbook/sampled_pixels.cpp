#include "tracer/textbook/sampled_pixels.hpp"

#include <algorithm>
#include <limits>

#include "tracer/system/in_parallel.hpp"

namespace plumb::textbook {
namespace {

constexpr std::size_t largest_piece = 32;
constexpr std::size_t pieces_at_once = 16;

/// What is looked at before the work is looked at again.
struct Round {
  std::size_t piece = 1;  ///< pixels
  std::size_t pieces = 1;
};

/// Of no more pixels than were looked at before, and than a quarter of what is left pays by their price.
Round next_round(const Work& work, std::size_t done) {
  if (done == 0) return {};
  const double units_of_pixel = std::max(1.0, work.spent() / static_cast<double>(done));
  const auto pixels =
      static_cast<std::size_t>(std::min(static_cast<double>(done), work.left() / (4 * units_of_pixel)));
  const std::size_t piece = std::clamp(pixels / pieces_at_once, std::size_t{1}, largest_piece);
  return {piece, std::clamp(pixels / piece, std::size_t{1}, pieces_at_once)};
}

/// The pixels of a picture that were not taken yet.
class Untaken {
 public:
  Untaken(int width, int height)
      : width_(static_cast<std::size_t>(width)), is_taken_(width_ * static_cast<std::size_t>(height)) {}

  void take(const PixelPlace& place, std::vector<PixelPlace>& places) {
    const std::size_t at = static_cast<std::size_t>(place.y) * width_ + static_cast<std::size_t>(place.x);
    if (!is_taken_.at(at)) places.push_back(place);
    is_taken_[at] = true;
  }

 private:
  std::size_t width_;
  std::vector<bool> is_taken_;
};

}  // namespace

std::vector<PixelPlace> spread_pixels(int width, int height, std::size_t most) {
  constexpr double g = 1.32471795724474602596;
  Untaken untaken(width, height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t count = std::min(most, pixels);
  std::vector<PixelPlace> places;
  places.reserve(count);
  double x = 0.5, y = 0.5;
  for (std::size_t i = 0; i < pixels && places.size() < count; ++i) {
    x += 1 / g;
    y += 1 / (g * g);
    x -= static_cast<int>(x);
    y -= static_cast<int>(y);
    untaken.take({static_cast<int>(x * width), static_cast<int>(y * height)}, places);
  }
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width && places.size() < count; ++column)
      untaken.take({column, row}, places);
  }
  return places;
}

std::size_t look_at(std::size_t n, const Looking& looking,
                    const std::function<void(std::size_t begin, std::size_t end, Work& work)>& look) {
  Work& work = looking.work;
  const double most = work.left();
  std::size_t done = 0;
  while (done < n && (done == 0 || !work.is_over())) {
    const Round round = next_round(work, done);
    const std::size_t end = std::min(n, done + round.piece * round.pieces);
    std::vector<Work> spent((end - done + round.piece - 1) / round.piece,
                            Work(std::numeric_limits<double>::infinity()));
    in_parallel(spent.size(), looking.threads, [&](std::size_t at) {
      const std::size_t begin = done + at * round.piece;
      look(begin, std::min(end, begin + round.piece), spent[at]);
    });
    for (const Work& of_piece : spent) work.spend(of_piece.spent());
    done = end;
    if (looking.progress)
      looking.progress(std::min(
          1.0, std::max(1 - work.left() / most, static_cast<double>(done) / static_cast<double>(n))));
  }
  return done;
}

}  // namespace plumb::textbook
