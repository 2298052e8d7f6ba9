// plumb-decode: decodes files for `plumb`, which starts it and trusts nothing that it says. It never looks at
// a file itself: it loads the libraries, once, and makes a process for each file, which is confined before it
// does.
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/confined_decoder.hpp"
#include "tracer/image/decode_request.hpp"
#include "tracer/image/decoded_message.hpp"
#include "tracer/image/decoder/confinement.hpp"
#include "tracer/image/decoder/keeper.hpp"
#include "tracer/image/decoder/rest.hpp"
#include "tracer/image/decoder/shared_canvas.hpp"
#include "tracer/image/module.hpp"
#include "tracer/image/oiio_module.hpp"

namespace plumb::decoder {
namespace {

struct Job {
  codecs::Source source;
  DecodeRequest request;
  DecodeFiles files;
};

Job job_of(const DecodeRequest& request, const DecodeFiles& files) {
  Job job;
  job.request = request;
  job.files = files;
  job.source.path = decoder_path;
  job.source.kind = request.kind;
  job.source.part = request.part;
  job.source.limits = request.limits;
  return job;
}

/// Loads the modules while that is still possible; they stay loaded.
class Decoder {
 public:
  explicit Decoder(const Job& job) : source_(job.source) {
    const bool is_of_codecs = source_.kind == Kind::exr || source_.kind == Kind::tiff;
    if (is_of_codecs)
      decode_ = reinterpret_cast<codecs::Decode>(module_symbol(codecs::module_name, codecs::decode_symbol));
    if (is_of_codecs && !job.request.has_other_decoder) return;
    const auto of_oiio = [](const char* name) { return module_symbol(oiio::module_name, name); };
    reinterpret_cast<oiio::Prepare>(of_oiio(oiio::prepare_symbol))();
    read_ = reinterpret_cast<oiio::Read>(of_oiio(oiio::read_symbol));
    source_.read_openexr = reinterpret_cast<ReadOpenExr>(of_oiio(oiio::read_openexr_symbol));
  }

  void decode(const std::shared_ptr<const MappedFile>& file, Canvas& canvas) const {
    codecs::Source source = source_;
    source.file = file;
    if (decode_ != nullptr) return decode_(source, canvas);
    const std::string complaint = read_(file->bytes(), source.kind, canvas);
    if (!complaint.empty())
      throw std::runtime_error(
          source.path + ": cannot be read, it is damaged or was cut short (OpenImageIO: " + complaint + ")");
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

DecodedMessage decoded(const Job& job, const Decoder& decoder) {
  DecodedMessage message;
  constexpr std::uint64_t for_working = std::uint64_t{512} << 20;  // beside the pixels
  const auto pixels = static_cast<std::uint64_t>(job.source.limits.bytes);
  const auto file = std::make_shared<const MappedFile>("/proc/self/fd/" + std::to_string(job.files.source));
  limit_resources(job.request.seconds, for_working + pixels, pixels);
  forbid_all_else();
  SharedCanvas canvas(job.files.pixels, job.source.path, job.source.limits);
  decoder.decode(file, canvas);
  message.shape = canvas.finish();
  message.outcome = DecodedMessage::Outcome::decoded;
  return message;
}

DecodedMessage outcome(const Job& job, const Decoder& decoder) {
  DecodedMessage message;
  try {
    return decoded(job, decoder);
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

/// What the process of one file does. Without destructors and leak checkers at its end: both may need what is
/// forbidden by then.
[[noreturn]] void become_decoder(const Job& job) {
  try {
    const Decoder decoder(job);
    answer(job.files.message, outcome(job, decoder));
    ::_exit(0);
  } catch (const std::exception& error) {
    DecodedMessage message;
    message.why = error.what();
    answer(job.files.message, message);
    ::_exit(exit_without_module);
  }
}

/// Loaded here once, its modules are there in every process that is made later. Whether that worked each of
/// them says.
void load_modules_of(const Job& job) {
  try {
    const Decoder decoder(job);
  } catch (const std::exception&) {
  }
}

/// Which modules a request needs.
int modules_of(const Job& job) {
  const bool is_of_codecs = job.source.kind == Kind::exr || job.source.kind == Kind::tiff;
  return (is_of_codecs ? 1 : 0) | (!is_of_codecs || job.request.has_other_decoder ? 2 : 0);
}

int serve(int socket) {
  Keeper keeper;
  int loaded = 0;
  for (;;) {
    keeper.keep_until_readable(socket);
    DecodeFiles files;
    const std::string text = receive_files(socket, files);
    if (text.empty()) return 0;
    const Job job = job_of(decode_request(text), files);
    if ((modules_of(job) & ~loaded) != 0) {
      load_modules_of(job);
      wait_until_others_rest();
      loaded |= modules_of(job);
    }
    keeper.run(files, [&job] { become_decoder(job); });
  }
}

}  // namespace
}  // namespace plumb::decoder

int main(int count, char** words) {
  if (count != 2 || std::strcmp(words[1], plumb::serve_argument) != 0) {
    std::fputs("plumb-decode: is started by plumb alone\n", stderr);
    return 2;
  }
  // A signal from the keyboard is for plumb, which ends this process by closing its socket.
  for (const int number : {SIGINT, SIGQUIT, SIGHUP, SIGPIPE}) std::signal(number, SIG_IGN);
  ::_exit(plumb::decoder::serve(0));
}
