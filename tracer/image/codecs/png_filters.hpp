// PNG (W3C, second edition), section 9: each row has a filter, which says what to add from the left and from
// above.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb::codecs {

/// Undoes the filters in place. Each of the `height` rows is the number of its filter and then `size` bytes,
/// complete pixels of `step` bytes: 1, 2, 3, 4, 6 or 8. Returns false when there is no such filter.
bool undo_filters(std::uint8_t* bytes, std::size_t size, std::size_t height, std::size_t step);

}  // namespace plumb::codecs
