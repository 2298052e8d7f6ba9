// What a pixel is, in 113 bits: the oracle that settles who is wrong when two renderers differ.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "references/attribution/pixel_tracer.hpp"
#include "tracer/formulas/quad.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::truth {

/// Returns the scene with each number written otherwise in its last digits. Every position, corner, radius
/// and translation moves by 4 * 2^-53 of the largest number beside it (of its vector, and of its radius or of
/// the box), every scale and angle by as much of itself. The numbered pattern says which way. Colours,
/// exponents and refractive indices stay: a picture follows them continuously. Instances of a shared shape
/// are moved apart, unless they are more than 2,000 (see with_instances_apart).
/// Patterns from Oracle::free_patterns on keep what is equal: a number moves by itself alone, by as much of
/// itself, and instances stay together.
Scene with_other_last_digits(const Scene& scene, int pattern);
/// Returns the same for where a camera stands and looks, and its field of view.
Camera with_other_last_digits(const Camera& camera, int pattern);

/// The bounds, by components, of all colours that the scene's numbers leave open, as pictures hold them.
struct Answers {
  attribution::Colour least;
  attribution::Colour most;
  /// True if the scene allows no two answers that are farther apart than the tolerance of compare().
  bool is_decided(double tolerance) const;
  /// True if the value is within the tolerance of one of them.
  bool allow(const float* value, double tolerance) const;
  void include(const attribution::Colour& colour);
};

/// One scene seen by one camera: the textbook tracer in Quad, whose roundings are 2^60 times as small as
/// those of double. It has the lecture's formulas, so it cannot judge those; tests compare them with answers
/// in closed form.
///
/// What it is sure of. A scene's numbers were read from text and rounded to double. They are not known beyond
/// their last digit: two scenes that differ by no more are the same scene. So the oracle also traces the
/// pixel in 48 scenes whose last digits differ (with_other_last_digits). When the answers are farther apart
/// than the tolerance, the pixel is UNDECIDED: a sample on a silhouette, on an edge of a shadow or at the
/// critical angle, or a chain of mirrors that enlarges the last digit. Those moves tell apart surfaces that
/// coincide, so a pixel that depends on which of them comes first is undecided, too: the lecture takes the
/// first in the file by convention, and others may take either. In 16 of the moves they stay together: that
/// surfaces at one place are crossed once is an answer, too, also for an eye that is a digit farther. Moves
/// are tried until they are told apart or all are done. So "decided" means that 48 moves found nothing: an
/// edge that each of the first 32 crosses with probability 1/2 is missed once in 4e9.
///
/// A renderer in double rounds anew at each ray, and no nearby scene explains the sum of what comes of it: a
/// ray may pass an edge on one side, and another ray, which a mirror sends back to that edge, on the other.
/// So answers are added in which the last digits move every meeting of a ray with a shape on its own. In half
/// of them a ray passes by what lies within a few last digits, like the second face at an edge within glass.
///
/// A ray that only touches an edge of a box meets the face by which it enters, and the moves add the miss. No
/// nearby scene shows, from behind, the face by which it leaves: a renderer that takes that one is wrong.
///
/// Surfaces that nearly coincide. The lecture's tracer takes hits within its resolution (see
/// formulas::resolution) for one place: 1.8e-12 of t in double, 5e-26 here. The oracle takes the scene at its
/// word: surfaces that are farther apart than the last digits, about 1e-15 of their positions, are two, in
/// their geometric order. A renderer in double that merges what is 1e-13 apart is wrong there, and is said to
/// be.
class Oracle {
 public:
  static constexpr int free_patterns = 32;  ///< these move each number on its own
  static constexpr int patterns = 48;
  static constexpr int rounded_patterns = 64;  ///< they follow, and also round anew at each ray and shape

  /// The work must outlive it, too.
  Oracle(const Shot& shot, textbook::Work& work);
  ~Oracle();
  Oracle(const Oracle&) = delete;
  Oracle& operator=(const Oracle&) = delete;

  /// Returns the linear colour of the pixel centre; row 0 is the top row. Nothing when the pixel has more
  /// rays than are traced (most_rays_of_pixel).
  std::optional<Rgb<Quad>> colour(int x, int y) const;
  /// Returns the same in the scene that a pattern in 0..47 gives and, from 48 to 111, with rays that are
  /// rounded anew. The pattern's world is made when it is first asked for.
  std::optional<Rgb<Quad>> colour_when_moved(int x, int y, int pattern) const;

  /// Number of patterns. Where the eye lies on glass, those that round anew are left out, because a ray that
  /// passes by the glass whose inside it starts in is no answer.
  int all_patterns() const { return patterns + (rounds_ ? rounded_patterns : 0); }

  /// Returns the answers of the scene and of its 48 moves. Nothing as above, or when the work is over before
  /// the end.
  std::optional<Answers> answers(int x, int y) const;

 private:
  class View;
  template <class Formulas>
  class ViewBy;

  std::unique_ptr<View> moved_view(int pattern) const;

  Shot shot_;
  textbook::Work& work_;
  std::unique_ptr<View> as_written_;
  bool rounds_;
  mutable std::vector<std::unique_ptr<View>> moved_;  // by pattern; null until it is asked for
};

/// Returns the colour, rounded as pictures hold it.
attribution::Colour to_colour(const Rgb<Quad>& colour);

}  // namespace plumb::truth
