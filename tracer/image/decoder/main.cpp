// plumb-decode: decodes one file for `plumb`, which starts it and trusts nothing that it says. Standard
// output takes the message, descriptor 3 is the file, descriptor 4 takes the pixels.
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "tracer/image/codecs/codecs.hpp"
#include "tracer/image/confined_decoder.hpp"
#include "tracer/image/decoded_message.hpp"
#include "tracer/image/decoder/confinement.hpp"
#include "tracer/image/decoder/shared_canvas.hpp"
#include "tracer/image/module.hpp"
#include "tracer/image/oiio_module.hpp"

namespace plumb::decoder {
namespace {

constexpr int arguments = 7;

struct Job {
  codecs::Source source;
  bool has_other_decoder = false;
  int seconds = 0;
};

Job job_of(char** words) {
  Job job;
  job.source.path = decoder_path;
  job.source.kind = static_cast<Kind>(std::stoi(words[1]));
  job.source.part = words[2];
  job.source.limits = {std::stoll(words[3]), std::stoll(words[4])};
  job.seconds = std::stoi(words[5]);
  job.has_other_decoder = std::stoi(words[6]) != 0;
  job.source.file = std::make_shared<const MappedFile>("/proc/self/fd/3");
  return job;
}

/// Loads the module while that is still possible.
class Decoder {
 public:
  explicit Decoder(const Job& job) : source_(job.source) {
    const bool is_of_codecs = source_.kind == Kind::exr || source_.kind == Kind::tiff;
    if (is_of_codecs)
      decode_ = reinterpret_cast<codecs::Decode>(module_symbol(codecs::module_name, codecs::decode_symbol));
    if (is_of_codecs && !job.has_other_decoder) return;
    const auto of_oiio = [](const char* name) { return module_symbol(oiio::module_name, name); };
    reinterpret_cast<oiio::Prepare>(of_oiio(oiio::prepare_symbol))();
    read_ = reinterpret_cast<oiio::Read>(of_oiio(oiio::read_symbol));
    source_.read_openexr = reinterpret_cast<ReadOpenExr>(of_oiio(oiio::read_openexr_symbol));
  }

  void decode(Canvas& canvas) const {
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

void answer(const DecodedMessage& message) {
  const std::string text = text_of(message);
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

DecodedMessage decoded(const Job& job, const Decoder& decoder) {
  DecodedMessage message;
  constexpr std::uint64_t for_working = std::uint64_t{512} << 20;  // beside the pixels
  const auto pixels = static_cast<std::uint64_t>(job.source.limits.bytes);
  limit_resources(job.seconds, for_working + pixels, pixels);
  forbid_all_else();
  SharedCanvas canvas(4, job.source.path, job.source.limits);
  decoder.decode(canvas);
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

int run(int count, char** words) {
  if (count != arguments) {
    std::fputs("plumb-decode: is started by plumb alone\n", stderr);
    return 2;
  }
  const Job job = job_of(words);
  try {
    const Decoder decoder(job);
    answer(outcome(job, decoder));
    return 0;
  } catch (const std::exception& error) {
    DecodedMessage message;
    message.why = error.what();
    answer(message);
    return exit_without_module;
  }
}

}  // namespace
}  // namespace plumb::decoder

/// Without destructors and leak checkers: both may need what is forbidden by now.
int main(int count, char** words) { ::_exit(plumb::decoder::run(count, words)); }
