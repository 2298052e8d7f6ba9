#include "tracer/image/confined_decoder.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>

#include "tracer/image/decoded_message.hpp"
#include "tracer/image/decoder_service.hpp"
#include "tracer/system/descriptor.hpp"

namespace plumb {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(),
                          std::string("a picture cannot be decoded: ") + what);
}

int opened(int number, const char* what) {
  if (number < 0) fail(what);
  return number;
}

void write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) fail("no memory for what a pipe held");
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Returns a descriptor of the file, or of a copy of what can be read only once.
int source_of(const std::string& path, const MappedFile& file) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && S_ISREG(info.st_mode))
    return opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC), "the file cannot be opened again");
  const int memory = opened(::memfd_create("picture", MFD_CLOEXEC), "memfd_create");
  write_all(memory, file.bytes());
  return memory;
}

struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
    from.emplace(ends[0]), to.emplace(ends[1]);
  }
  std::optional<Descriptor> from, to;
};

struct Mapping {
  Mapping(int file, std::size_t length)
      : bytes(::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, file, 0)), size(length) {
    if (bytes == MAP_FAILED) fail("its pixels cannot be mapped");
  }
  ~Mapping() { ::munmap(bytes, size); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  void* bytes;
  std::size_t size;
};

/// Reads the decoder's answer. A decoder waits for nothing, so its limit of CPU time ends it. When no answer
/// comes for much longer, the machine is in trouble, which says nothing about the file.
std::string answer_of(const std::string& path, int from, int seconds) {
  constexpr int patience = 6;
  try {
    return read_to_end(from, std::chrono::seconds(patience * seconds));
  } catch (const std::system_error& error) {
    throw std::system_error(error.code(), path + ": cannot be decoded now: in " +
                                              std::to_string(patience * seconds) +
                                              " s its decoder neither ended nor used its " +
                                              std::to_string(seconds) + " s of computing");
  }
}

/// Returns how the process ended, as waitpid says it.
int read_status(int from, const std::string& path) {
  int status = 0;
  ssize_t got = -1;
  do got = ::read(from, &status, sizeof status);
  while (got < 0 && errno == EINTR);
  if (got == static_cast<ssize_t>(sizeof status)) return status;
  throw std::system_error(
      ECHILD, std::generic_category(),
      path + ": cannot be decoded now: no process could be made for it, or it was killed");
}

/// Makes rows of the pixels' memory, which nobody else has by now.
PixelRows rows_of(const std::string& path, const Shape& shape, int pixels, const ReadLimits& limits) {
  const std::size_t component = size_of(shape.component);
  const auto pixel = static_cast<std::size_t>(shape.channels) * component;
  limits.check(path, shape.width, shape.height, static_cast<std::int64_t>(pixel));
  const std::size_t row = static_cast<std::size_t>(shape.width) * pixel;
  const std::size_t size = row * static_cast<std::size_t>(shape.height);
  struct stat info {};
  if (::fstat(pixels, &info) != 0 || static_cast<std::size_t>(info.st_size) != size)
    throw std::runtime_error(path + ": cannot be read: its decoder gave other pixels than it announced");
  const auto mapping = std::make_shared<const Mapping>(pixels, size);
  PixelRows rows;
  rows.width = shape.width;
  rows.height = shape.height;
  rows.channels = shape.channels;
  rows.sample = shape.sample;
  rows.is_bytes = shape.component == Component::byte;
  rows.is_double = shape.component == Component::float64;
  rows.stride = static_cast<std::ptrdiff_t>(row);
  rows.top = static_cast<const std::byte*>(mapping->bytes);
  rows.owner = mapping;
  rows.contents = shape.contents;
  return rows;
}

std::string ending(int status) {
  if (WIFSIGNALED(status)) return "crashed (" + std::string(::strsignal(WTERMSIG(status))) + ")";
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

/// Returns the decoder's words with the file's name in them.
std::string said_of(const std::string& path, const std::string& why) {
  return why.starts_with(decoder_path) ? path + why.substr(1) : path + ": cannot be read: " + why;
}

/// Returns 10 s, and more where the file itself is long: the slowest decoders make some 20 MB a second.
int seconds_for(const MappedFile& file) {
  constexpr std::size_t bytes_a_second = 20'000'000;
  return 10 + static_cast<int>(file.bytes().size() / bytes_a_second);
}

/// Decodes the file. Returns nothing when the decoder that takes longer to start is needed.
std::optional<PixelRows> decoded_by(bool has_other_decoder, const std::string& path, const MappedFile& file,
                                    Kind kind, const std::string& part, const ReadLimits& limits) {
  const Descriptor source(source_of(path, file));
  const Descriptor pixels(opened(::memfd_create("pixels", MFD_CLOEXEC), "memfd_create"));
  const int seconds = seconds_for(file);
  Pipe message_pipe, status_pipe;
  DecoderService::shared().hand_over(
      {kind, limits, seconds, has_other_decoder, part},
      {source.number(), pixels.number(), message_pipe.to->number(), status_pipe.to->number()});
  message_pipe.to.reset(), status_pipe.to.reset();
  const std::string message = answer_of(path, message_pipe.from->number(), seconds);
  const auto decoded = decoded_message(message);
  // A decoder that writes on has not ended. It is killed, because nobody holds the other ends of its pipes
  // any more after this function.
  const int status =
      message.size() < longest_message ? read_status(status_pipe.from->number(), path) : SIGKILL;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw std::runtime_error(path + ": cannot be read: decoding it took more than " +
                             std::to_string(seconds) +
                             " s of computing, so it was given up; it is damaged, or made to take long");
  if (WIFEXITED(status) && WEXITSTATUS(status) == exit_without_module)
    throw std::system_error(ENOENT, std::generic_category(), decoded ? decoded->why : decoder_name);
  if (status != 0 || !decoded)
    throw std::runtime_error(path + ": cannot be read, it is damaged: its decoder " + ending(status) +
                             " on it; write it again, or as PNG or OpenEXR");
  if (decoded->outcome == DecodedMessage::Outcome::too_large)
    throw PictureTooLarge(said_of(path, decoded->why), decoded->width, decoded->height);
  if (decoded->outcome == DecodedMessage::Outcome::other_decoder && !has_other_decoder) return std::nullopt;
  if (decoded->outcome != DecodedMessage::Outcome::decoded)
    throw std::runtime_error(said_of(path, decoded->why));
  return rows_of(path, decoded->shape, pixels.number(), limits);
}

}  // namespace

PixelRows decode_confined(const std::string& path, const MappedFile& file, Kind kind,
                          const ReadRequest& request, const ReadLimits& limits) {
  if (auto rows = decoded_by(false, path, file, kind, request.part, limits)) return *rows;
  return decoded_by(true, path, file, kind, request.part, limits).value();
}

}  // namespace plumb
