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
  int seconds = 0;                 ///< of computing
  bool has_other_decoder = false;  ///< of OpenImageIO, for what the own codecs leave to it
  std::string part;                ///< as in ReadRequest
};

/// The descriptors that come with it, in this order.
struct DecodeFiles {
  int source = -1;   ///< the file
  int pixels = -1;   ///< of memory
  int message = -1;  ///< end of a pipe for a DecodedMessage
  int status = -1;   ///< end of a pipe for an int: how the decoding process ended, as waitpid says it
};

inline constexpr std::size_t longest_request = std::size_t{1} << 16;

std::string text_of(const DecodeRequest& request);
/// Of what text_of() wrote.
DecodeRequest decode_request(std::string_view text);

/// Sends text and files through the socket in one piece. False when nobody is there any more.
bool send_files(int socket, std::string_view text, const DecodeFiles& files);
/// Waits. An empty text when the other end is closed.
std::string receive_files(int socket, DecodeFiles& files);

}  // namespace plumb
