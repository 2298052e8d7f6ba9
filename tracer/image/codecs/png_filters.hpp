// PNG (W3C, second edition), section 9: each row says how it is to be added to what is left of and above it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb::codecs {

/// Undoes the filters in place. Each of the `height` rows is the number of its filter and then `size` bytes,
/// whole pixels of `step` bytes: 1, 2, 3, 4, 6 or 8. False when there is no such filter.
bool undo_filters(std::uint8_t* bytes, std::size_t size, std::size_t height, std::size_t step);

}  // namespace plumb::codecs
