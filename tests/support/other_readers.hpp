// Pictures as programs read them that are not ours.
#pragma once

#include <string>

#include "tracer/image/image_file.hpp"

namespace plumb::tests {

/// Three channels of 8 bits, as oiiotool reads them. Fails the test when it does not.
ImageFile as_oiiotool_reads(const std::string& path);

}  // namespace plumb::tests
