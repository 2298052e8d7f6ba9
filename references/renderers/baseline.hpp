// The pictures that were approved as right.
#pragma once

#include "references/renderers/resolution.hpp"

namespace plumb::references {

/// Of a picture that plumb rendered, on this machine or on another one.
const Resolution& baseline_resolution();

}  // namespace plumb::references
