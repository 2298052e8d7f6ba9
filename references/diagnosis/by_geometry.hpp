// Holds what the colours of a picture told against what the places of things tell, and adds to it.
#pragma once

#include <optional>
#include <vector>

#include "references/diagnosis/diagnosis.hpp"
#include "references/diagnosis/geometry.hpp"

namespace plumb::diagnosis {

class ByGeometry {
 public:
  /// Evidence and picture must outlive it.
  ByGeometry(const Evidence& evidence, const ImageFile& seen, std::optional<double> tolerance,
             Geometry geometry);

  /// Returns what is told of a picture that has another colour than the scene's where nothing is hit. Returns
  /// nothing when it has not, or when its camera stays unknown.
  std::optional<Diagnosis> with_background_of_its_own() const;

  /// Adds what is certain to what the colours told, takes out what contradicts it, and names the faults of
  /// the shading that have their own evidence.
  Diagnosis completed(Diagnosis by_colours) const;

 private:
  bool agrees(const Diagnosis& diagnosis) const;
  void add_what_is_certain(Diagnosis& diagnosis) const;
  std::optional<Habit> background_of_its_own() const;
  std::optional<double> of_a_level() const;
  bool only_what_shows_the_background_is_left() const;
  double share_within(const Evidence& evidence, const FaultSet& set, const OutputEncoding& encoding) const;
  std::vector<Scene> with_background(const Rgbd& seen) const;
  double misfit_of(const Scene& scene) const;
  void name_what_is_told(Diagnosis& diagnosis) const;
  static void add_of_a_shape(Diagnosis& d, const ShapeElsewhere& shape);
  void add_of_the_camera(Diagnosis& diagnosis, const faults::Fault* fault,
                         const std::vector<const faults::Fault*>& alike) const;

  const Evidence& evidence_;
  const ImageFile& seen_;
  std::optional<double> tolerance_;
  Geometry geometry_;
  std::optional<Habit> habit_;
  std::vector<Scene> with_habit_;  ///< scenes whose background is as the habit shows it; none without it
};

}  // namespace plumb::diagnosis
