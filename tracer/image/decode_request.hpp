// What the program asks of the process that decodes files for it, as one message.
#pragma once

#include <string>
#include <string_view>

#include "tracer/image/kind.hpp"
#include "tracer/image/read_request.hpp"

namespace plumb {

struct DecodeRequest {
  Kind kind{};
  ReadLimits limits;
  int seconds = 0;                 ///< of CPU time that decoding may take
  bool has_other_decoder = false;  ///< true if OpenImageIO may do what the own codecs leave to it
  std::string part;                ///< as in ReadRequest
};

/// The descriptors that go with a request, in this order.
struct DecodeFiles {
  int source = -1;   ///< the file that is decoded
  int pixels = -1;   ///< memory for the pixels
  int message = -1;  ///< end of a pipe for a DecodedMessage
  int status = -1;   ///< end of a pipe for an int: how the decoding process ended, as waitpid says it
};

inline constexpr std::size_t longest_request = std::size_t{1} << 16;

std::string text_of(const DecodeRequest& request);
/// Reads what text_of() wrote.
DecodeRequest decode_request(std::string_view text);

/// Sends text and files through the socket in one message. Returns false when nobody is there any more.
bool send_files(int socket, std::string_view text, const DecodeFiles& files);
/// Waits for a message. Returns an empty text when the other end is closed.
std::string receive_files(int socket, DecodeFiles& files);

}  // namespace plumb
