// Takes what was told of the pictures that one tracer made of several scenes together: one set of faults for
// all.
#pragma once

#include <cstddef>
#include <vector>

#include "references/diagnosis/diagnosis.hpp"

namespace plumb::diagnosis {

struct CaseFault {
  const faults::Fault* fault;
  std::vector<const faults::Fault*> alike;  ///< what none of the pictures tells from it
  double confidence;  ///< the largest share that it explains of a picture, divided among it and its like
  std::vector<std::size_t> pictures;  ///< those that show it, by number
};

/// A fault that one picture alone would name, and of which another shows that the tracer does not have it.
struct Withdrawn {
  const faults::Fault* fault;
  std::size_t picture;
  std::size_t contradicted_by;
};

struct CaseDiagnosis {
  std::vector<CaseFault> faults;  ///< those that most pictures show first
  std::vector<Withdrawn> withdrawn;
  Certain certain;  ///< wrong where one picture says so; right where one says so and none that it is wrong
};

/// Joins what was told of each picture; null stands for one of which nothing was told. A fault, or its like,
/// is taken back where another picture excludes it.
CaseDiagnosis diagnosis_of_case(const std::vector<const Diagnosis*>& pictures);

}  // namespace plumb::diagnosis
