// How scenes are read, rendered on our side and compared, whatever they are compared with.
#pragma once

#include <string>

#include "references/renderers/ours.hpp"
#include "tracer/format/dialect.hpp"
#include "tracer/scene/shot.hpp"

namespace plumb::gates {

struct PictureOptions : ShotOptions {
  double tolerance = 1e-6;
  Dialect dialect;
  std::string dialect_name{};  ///< as it was asked for; empty when it was not
  RealType real = RealType::float64;
  renderers::OwnTracer tracer = renderers::OwnTracer::engine;  ///< of our side
  bool keeps_pictures = false;  ///< in the results while they are reported, for a report
};

}  // namespace plumb::gates
