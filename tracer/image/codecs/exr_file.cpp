#include "tracer/image/codecs/exr_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace plumb::codecs {
namespace {

const std::string_view& bytes_of(void* user) { return *static_cast<const std::string_view*>(user); }

std::int64_t read_bytes(exr_const_context_t, void* user, void* to, std::uint64_t size, std::uint64_t at,
                        exr_stream_error_func_ptr_t) {
  const std::string_view bytes = bytes_of(user);
  if (at >= bytes.size()) return 0;
  const std::size_t count = std::min<std::uint64_t>(size, bytes.size() - at);
  std::memcpy(to, bytes.data() + at, count);
  return static_cast<std::int64_t>(count);
}

std::int64_t size_of_bytes(exr_const_context_t, void* user) {
  return static_cast<std::int64_t>(bytes_of(user).size());
}

}  // namespace

ExrFile::ExrFile(std::string_view bytes) : bytes_(bytes) {
  exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  start.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
  start.user_data = &bytes_;
  start.read_fn = read_bytes;
  start.size_fn = size_of_bytes;
  if (exr_start_read(&context_, "picture", &start) != EXR_ERR_SUCCESS) context_ = nullptr;
}

ExrFile::~ExrFile() {
  if (context_ != nullptr) exr_finish(&context_);
}

}  // namespace plumb::codecs
