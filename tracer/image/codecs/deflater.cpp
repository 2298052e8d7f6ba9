#include "tracer/image/codecs/deflater.hpp"

#include <array>
#include <new>

namespace plumb::codecs {

Deflater::Deflater() {
  if (deflateInit(&stream_, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
}

void Deflater::add(std::span<const std::uint8_t> bytes, std::string& out) {
  stream_.next_in = const_cast<Bytef*>(bytes.data());  // zlib 1.2 does not say const, but only reads
  stream_.avail_in = static_cast<uInt>(bytes.size());
  run(Z_NO_FLUSH, out);
}

void Deflater::finish(std::string& out) { run(Z_FINISH, out); }

void Deflater::run(int flush, std::string& out) {
  std::array<char, 1 << 14> some;
  do {
    stream_.next_out = reinterpret_cast<Bytef*>(some.data());
    stream_.avail_out = static_cast<uInt>(some.size());
    deflate(&stream_, flush);  // cannot fail: there is room, and nothing comes after the end
    out.append(some.data(), some.size() - stream_.avail_out);
  } while (stream_.avail_out == 0);
}

}  // namespace plumb::codecs
