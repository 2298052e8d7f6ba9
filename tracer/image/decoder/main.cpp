// plumb-decode: decodes files for `plumb`, which starts it and trusts nothing that it says. It never looks at
// a file itself. It loads the libraries once, and makes a process for each file; that process is confined
// before it looks.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/confined_decoder.hpp"
#include "tracer/image/decode_request.hpp"
#include "tracer/image/decoded_message.hpp"
#include "tracer/image/decoder/confinement.hpp"
#include "tracer/image/decoder/keeper.hpp"
#include "tracer/image/decoder/rest.hpp"
#include "tracer/image/decoder/shared_canvas.hpp"
#include "tracer/image/oiio_module.hpp"
#include "tracer/system/module.hpp"

namespace plumb::decoder {
namespace {

bool needs_codecs(const DecodeRequest& request) {
  return request.kind == Kind::exr || request.kind == Kind::tiff;
}
bool needs_oiio(const DecodeRequest& request) { return !needs_codecs(request) || request.has_other_decoder; }

/// Loads the modules while that is still possible. They stay loaded.
class Decoder {
 public:
  explicit Decoder(const DecodeRequest& request) {
    source_.path = decoder_path;
    source_.kind = request.kind;
    source_.part = request.part;
    source_.limits = request.limits;
    if (needs_codecs(request))
      decode_ = reinterpret_cast<codecs::Decode>(module_symbol(codecs::module_name, codecs::decode_symbol));
    if (!needs_oiio(request)) return;
    const auto of_oiio = [](const char* name) { return module_symbol(oiio::module_name, name); };
    reinterpret_cast<oiio::Prepare>(of_oiio(oiio::prepare_symbol))();
    read_ = reinterpret_cast<oiio::Read>(of_oiio(oiio::read_symbol));
    source_.read_openexr = reinterpret_cast<ReadOpenExr>(of_oiio(oiio::read_openexr_symbol));
  }

  void decode(std::shared_ptr<const MappedFile> file, Canvas& canvas) {
    source_.file = std::move(file);
    if (decode_ != nullptr) return decode_(source_, canvas);
    const std::string complaint = read_(source_.file->bytes(), source_.kind, canvas);
    if (!complaint.empty())
      throw std::runtime_error(
          source_.path + ": cannot be read, it is damaged or was cut short (OpenImageIO: " + complaint + ")");
  }

 private:
  codecs::Source source_;
  codecs::Decode decode_ = nullptr;
  oiio::Read read_ = nullptr;
};

void answer(int to, const DecodedMessage& message) {
  const std::string text = text_of(message);
  for (std::string_view rest = text; !rest.empty();) {
    const ssize_t written = ::write(to, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) return;
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

DecodedMessage decoded(const DecodeRequest& request, const DecodeFiles& files, Decoder& decoder) {
  DecodedMessage message;
  constexpr std::uint64_t for_working = std::uint64_t{512} << 20;  // beside the pixels
  const auto pixels = static_cast<std::uint64_t>(request.limits.bytes);
  auto file = std::make_shared<const MappedFile>("/proc/self/fd/" + std::to_string(files.source));
  limit_resources(request.seconds, for_working + pixels, pixels);
  forbid_all_else();
  SharedCanvas canvas(files.pixels, decoder_path, request.limits);
  decoder.decode(std::move(file), canvas);
  message.shape = canvas.finish();
  message.outcome = DecodedMessage::Outcome::decoded;
  return message;
}

DecodedMessage outcome(const DecodeRequest& request, const DecodeFiles& files, Decoder& decoder) {
  DecodedMessage message;
  try {
    return decoded(request, files, decoder);
  } catch (const PictureTooLarge& error) {
    message.outcome = DecodedMessage::Outcome::too_large;
    message.why = error.what();
    message.width = error.width;
    message.height = error.height;
  } catch (const OtherDecoderNeeded&) {
    message.outcome = DecodedMessage::Outcome::other_decoder;
  } catch (const std::bad_alloc&) {
    message.why = "decoding it takes more memory than there is for one picture";
  } catch (const std::exception& error) {
    message.why = error.what();
  }
  return message;
}

/// What the process of one file does. It ends without destructors and leak checkers, because both may need
/// what is forbidden by then.
[[noreturn]] void become_decoder(const DecodeRequest& request, const DecodeFiles& files) {
  try {
    Decoder decoder(request);
    answer(files.message, outcome(request, files, decoder));
    ::_exit(0);
  } catch (const std::exception& error) {
    DecodedMessage message;
    message.why = error.what();
    answer(files.message, message);
    ::_exit(exit_without_module);
  }
}

/// Loads the modules here once, so that they are there in every process that is made later. Each process
/// itself reports whether that worked.
void load_modules_for(const DecodeRequest& request) {
  try {
    const Decoder decoder(request);
  } catch (const std::exception&) {
  }
  wait_until_others_rest();
}

int serve(int socket) {
  Keeper keeper;
  bool has_codecs = false, has_oiio = false;
  for (;;) {
    keeper.keep_until_readable(socket);
    DecodeFiles files;
    const std::string text = receive_files(socket, files);
    if (text.empty()) return 0;
    const DecodeRequest request = decode_request(text);
    if (needs_codecs(request) > has_codecs || needs_oiio(request) > has_oiio) load_modules_for(request);
    has_codecs = has_codecs || needs_codecs(request);
    has_oiio = has_oiio || needs_oiio(request);
    keeper.run(files, [&] {
      ::close(socket);  // requests for other files are none of its business
      become_decoder(request, files);
    });
  }
}

}  // namespace
}  // namespace plumb::decoder

namespace {

/// Closes what plumb, or who started it, left open, and lets nothing be printed but to standard error.
bool keeps_its_own_files_alone() {
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  return nothing >= 0 && ::dup2(nothing, STDOUT_FILENO) >= 0 && ::close_range(STDERR_FILENO + 1, ~0U, 0) == 0;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2 || std::strcmp(words[1], plumb::serve_argument) != 0) {
    std::fputs("plumb-decode: is started by plumb alone\n", stderr);
    return 2;
  }
  if (!keeps_its_own_files_alone()) {
    std::perror("plumb-decode: what is open cannot be closed");
    return 2;
  }
  // A signal from the keyboard is for plumb, which ends this process by closing its socket.
  for (const int number : {SIGINT, SIGQUIT, SIGHUP, SIGPIPE}) std::signal(number, SIG_IGN);
  ::_exit(plumb::decoder::serve(0));
}
