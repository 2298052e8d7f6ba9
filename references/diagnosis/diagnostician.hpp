// Diagnoses a picture by the colours of its pixels alone.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "references/diagnosis/diagnosis.hpp"
#include "references/diagnosis/remains.hpp"

namespace plumb::diagnosis {

/// Fills in what the picture that a set gives leaves: edges, encoding, number and size of the differences.
void tell_what_remains(const Evidence& evidence, const FaultSet& set, const Remains& remains,
                       Diagnosis& diagnosis);

/// Returns what the right picture shows at these pixels, the most first.
std::vector<ShapeSeen> shapes_at(const Evidence& evidence, const std::vector<std::size_t>& pixels);

/// Marks as wrong what the named faults are about.
void tell_what_is_wrong(Diagnosis& diagnosis);

class Diagnostician {
 public:
  /// Both must outlive it.
  Diagnostician(const Evidence& evidence, const ImageFile& seen);

  /// Returns the diagnosis when the picture is right, or tells nothing.
  std::optional<Diagnosis> without_search();

  /// Comes after without_search().
  Diagnosis with_search(Evidence& evidence);

 private:
  void tell_without_faults();
  bool is_small_part(std::size_t pixels) const;
  bool are_faults(const Remains& right, Fit& fit);
  double told_share(const Remains& right, const Remains& left) const;
  std::array<float, 3> colour_seen(std::size_t pixel) const;
  std::array<float, 3> most_frequent_colour() const;
  std::size_t least_righted(const Remains& right, const Remains& left) const;
  void add_fault(const Fit& fit, std::size_t number, std::size_t righted);

  const Evidence& evidence_;
  const ImageFile& seen_;
  Diagnosis diagnosis_;
  Remains right_;
  double explained_ = 0;  ///< share of the pixels that are not right that the faults make right
};

}  // namespace plumb::diagnosis
