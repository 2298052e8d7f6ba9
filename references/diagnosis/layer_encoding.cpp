#include "references/diagnosis/layer_encoding.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace plumb::diagnosis {
namespace {

struct Written {
  const char* words;
  float (*value)(float);
};

float tone_mapped_value(float c) { return c > 0 ? c / (c + 1) : 0; }

float srgb_value(float c) {
  if (c <= 0.0031308F) return 12.92F * c;
  return 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

// From a component of a normal, -1 to 1, to a colour.
constexpr Written bases[] = {
    {"n / 2 + 1/2", [](float n) { return n / 2 + 0.5F; }},
    {"n", [](float n) { return n; }},
    {"n where it is positive", [](float n) { return std::max(n, 0.0F); }},
    {"|n|", [](float n) { return std::fabs(n); }},
};
constexpr Written curves[] = {
    {"", [](float c) { return c; }},
    {", tone-mapped", &tone_mapped_value},
    {", with the sRGB curve", &srgb_value},
};

// What rounding to 8 bits moves a value by, and a little, because the formulas are computed in other orders.
constexpr float half_a_level = 0.52F / 255;
constexpr float of_a_float = 2e-4F;  // because people compute in float, and a normal is a quotient of those

float tolerance_of(bool is_rounded) { return is_rounded ? half_a_level : of_a_float; }

std::size_t number_of(const std::vector<bool>& these) {
  return static_cast<std::size_t>(std::ranges::count(these, true));
}

/// A line that was laid through depths.
struct Line {
  double slope;
  double offset;
  double at(double depth) const { return slope * depth + offset; }
};

/// One channel of a layer of depths, and what it is fitted to.
class Depths {
 public:
  Depths(std::vector<double> depths, std::span<const Seen> seen, float tolerance)
      : depths_(std::move(depths)), seen_(seen), tolerance_(tolerance) {}

  std::vector<bool> explained_by(const Line& line) const {
    std::vector<bool> explained(depths_.size());
    for (std::size_t i = 0; i < depths_.size(); ++i) explained[i] = is_on(line, i);
    return explained;
  }

  /// Returns the line that most pixels lie on, of lines through two of them each.
  std::optional<Line> best() const {
    constexpr std::size_t tries = 60;
    std::optional<Line> best;
    std::size_t most = 1;
    for (std::size_t i = 0; i < tries; ++i) {
      const auto line =
          through(i * 7919 % depths_.size(), (i * 104729 + depths_.size() / 2) % depths_.size());
      if (!line) continue;
      const Line refined = refined_from(*line);
      const std::size_t count = number_of(explained_by(refined));
      if (count <= most) continue;
      most = count;
      best = refined;
    }
    return best;
  }

  /// True if what is on the line is spread over levels enough that another layer would not be.
  bool tells(const Line& line) const {
    constexpr double levels = 24;  // because a lecture's fault moves depths by a tenth of their range or more
    double least = 1, most = 0;
    for (std::size_t i = 0; i < depths_.size(); ++i) {
      if (!is_on(line, i)) continue;
      least = std::min(least, line.at(depths_[i]));
      most = std::max(most, line.at(depths_[i]));
    }
    return most - least >= levels * static_cast<double>(tolerance_);
  }

 private:
  bool is_on(const Line& line, std::size_t i) const {
    const double expected = line.at(depths_[i]);
    const double value = seen_[i][0];
    const bool is_clamped = (value >= 1 && expected > 1) || (value <= 0 && expected < 0);
    const bool is_grey = seen_[i][0] == seen_[i][1] && seen_[i][0] == seen_[i][2];
    return is_grey && (is_clamped || std::abs(expected - value) <= static_cast<double>(tolerance_));
  }

  std::optional<Line> through(std::size_t a, std::size_t b) const {
    const double run = depths_[b] - depths_[a];
    const double rise = static_cast<double>(seen_[b][0]) - static_cast<double>(seen_[a][0]);
    if (run == 0 || std::abs(rise) < static_cast<double>(tolerance_)) return {};
    const double slope = rise / run;
    return Line{slope, static_cast<double>(seen_[a][0]) - slope * depths_[a]};
  }

  /// Of the first pixels, which lie evenly over the picture.
  std::size_t number_on(const Line& line) const {
    constexpr std::size_t some = 500;
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(some, depths_.size()); ++i) count += is_on(line, i) ? 1 : 0;
    return count;
  }

  /// Least squares over what lies on the line, or near it, again and again.
  Line refined_from(Line line) const {
    for (const double times : {8.0, 4.0, 2.0, 1.0}) {
      double n = 0, x = 0, y = 0, xx = 0, xy = 0;
      for (std::size_t i = 0; i < depths_.size(); ++i) {
        const double value = seen_[i][0];
        if (value <= 0 || value >= 1) continue;
        if (std::abs(line.at(depths_[i]) - value) > times * static_cast<double>(tolerance_)) continue;
        n += 1;
        x += depths_[i];
        y += value;
        xx += depths_[i] * depths_[i];
        xy += depths_[i] * value;
      }
      const double spread = n * xx - x * x;
      if (n < 3 || spread <= 1e-12 * n * xx) return line;
      const double slope = (n * xy - x * y) / spread;
      line = {slope, (y - slope * x) / n};
    }
    return line;
  }

  std::vector<double> depths_;
  std::span<const Seen> seen_;
  float tolerance_;
};

std::vector<double> reciprocals(std::vector<double> depths) {
  for (double& depth : depths) depth = 1 / depth;
  return depths;
}

}  // namespace

LayerFit fit_of_normals(std::span<const std::array<float, 3>> normals, std::span<const Seen> seen,
                        bool is_rounded) {
  const float tolerance = tolerance_of(is_rounded);
  constexpr float truncated = -0.5F / 255;  // on average
  LayerFit best{"", std::vector<bool>(normals.size())};
  const auto hold_against = [&](const Written& base, const Written& curve, float offset) {
    std::vector<bool> explained(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      explained[i] = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const float value = curve.value(base.value(normals[i][c]));
        const float clamped = std::clamp(value, 0.0F, 1.0F);
        // 1 is the one value that truncation leaves.
        const float in_levels = clamped < 1 ? std::max(clamped + offset, 0.0F) : clamped;
        const float written = is_rounded ? in_levels : value;
        if (!(std::fabs(written - seen[i][c]) <= tolerance)) explained[i] = false;
      }
    }
    if (number_of(explained) > number_of(best.explained) || best.encoding.empty())
      best = {std::string(base.words) + curve.words, std::move(explained)};
  };
  for (const Written& base : bases) {
    for (const Written& curve : curves) {
      hold_against(base, curve, 0);
      if (is_rounded) hold_against(base, curve, truncated);
    }
  }
  return best;
}

std::optional<LayerFit> fit_of_depths(std::span<const float> along_ray, std::span<const float> along_camera,
                                      std::span<const Seen> seen, bool is_rounded) {
  const float tolerance = tolerance_of(is_rounded);
  if (along_ray.empty()) return {};
  const std::vector<double> ray(along_ray.begin(), along_ray.end());
  const std::vector<double> camera(along_camera.begin(), along_camera.end());
  const std::pair<const char*, std::vector<double>> kinds[] = {
      {"a straight line of the depth along the ray", ray},
      {"a straight line of the depth along the camera's direction", camera},
      {"a straight line of 1 / depth along the ray", reciprocals(ray)},
      {"a straight line of 1 / depth along the camera's direction", reciprocals(camera)}};
  std::optional<LayerFit> best;
  for (const auto& [words, values] : kinds) {
    const Depths depths(values, seen, tolerance);
    const auto line = depths.best();
    if (!line || !depths.tells(*line)) continue;
    LayerFit fit{words, depths.explained_by(*line)};
    if (!best || number_of(fit.explained) > number_of(best->explained)) best = std::move(fit);
  }
  return best;
}

}  // namespace plumb::diagnosis
