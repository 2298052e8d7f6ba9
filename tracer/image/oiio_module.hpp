// The boundary of the module that links OpenImageIO. Linking it costs 0.3 s of CPU and 129 MiB at every start
// of a process, so it is a shared object of its own that is loaded on demand.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tracer/image/canvas.hpp"
#include "tracer/image/kind.hpp"
#include "tracer/image/row_writer.hpp"
#include "tracer/system/byte_sink.hpp"

namespace plumb::oiio {

enum class Depth { float32, bits16 };

/// A picture that is to be written.
struct Layout {
  int width;
  int height;
  Depth depth;
  std::vector<std::string> channels;  ///< in the order in which the rows have them
};

/// Makes a writer of linear values into `file`, which must outlive it, in the format that the path's name
/// says. Throws std::runtime_error naming the path.
using Write = std::unique_ptr<RowWriter<float>> (*)(ByteSink& file, const std::string& path,
                                                    const Layout& layout);
/// For the confined process alone: does what needs threads and files, before they are forbidden.
using Prepare = void (*)();
/// Decodes bytes of a kind that is known already. Returns an empty string, or what went wrong.
using Read = std::string (*)(std::string_view bytes, Kind kind, Canvas& canvas);

inline constexpr const char* module_name = "plumb_openimageio.so";
inline constexpr const char* write_symbol = "plumb_oiio_write";
inline constexpr const char* prepare_symbol = "plumb_oiio_prepare";
inline constexpr const char* read_openexr_symbol = "plumb_oiio_read_openexr";  ///< a ReadOpenExr
inline constexpr const char* read_symbol = "plumb_oiio_read";

}  // namespace plumb::oiio
