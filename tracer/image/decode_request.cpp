#include "tracer/image/decode_request.hpp"

#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <sstream>

namespace plumb {
namespace {

using Numbers = std::array<int, 4>;

Numbers numbers_of(const DecodeFiles& files) {
  return {files.source, files.pixels, files.message, files.status};
}

/// A message of a text and four descriptors.
struct Envelope {
  explicit Envelope(std::string_view text) : part{const_cast<char*>(text.data()), text.size()} {
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
  }
  iovec part;
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Numbers))> control{};
  msghdr message{};
};

}  // namespace

std::string text_of(const DecodeRequest& request) {
  std::ostringstream text;
  text << static_cast<int>(request.kind) << ' ' << request.limits.pixels << ' ' << request.limits.bytes << ' '
       << request.seconds << ' ' << request.has_other_decoder << ' ' << request.part;
  return text.str();
}

DecodeRequest decode_request(std::string_view text) {
  std::istringstream words{std::string(text)};
  DecodeRequest request;
  int kind = 0;
  words >> kind >> request.limits.pixels >> request.limits.bytes >> request.seconds >>
      request.has_other_decoder;
  request.kind = static_cast<Kind>(kind);
  words.ignore(1);
  request.part.assign(std::istreambuf_iterator<char>(words), {});
  return request;
}

bool send_files(int socket, std::string_view text, const DecodeFiles& files) {
  Envelope envelope(text);
  cmsghdr* const head = CMSG_FIRSTHDR(&envelope.message);
  head->cmsg_level = SOL_SOCKET;
  head->cmsg_type = SCM_RIGHTS;
  head->cmsg_len = CMSG_LEN(sizeof(Numbers));
  const Numbers numbers = numbers_of(files);
  std::memcpy(CMSG_DATA(head), numbers.data(), sizeof numbers);
  ssize_t sent = -1;
  do sent = ::sendmsg(socket, &envelope.message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(text.size());
}

std::string receive_files(int socket, DecodeFiles& files) {
  std::string text(longest_request, '\0');
  Envelope envelope(text);
  ssize_t got = -1;
  do got = ::recvmsg(socket, &envelope.message, MSG_CMSG_CLOEXEC);
  while (got < 0 && errno == EINTR);
  const cmsghdr* const head = CMSG_FIRSTHDR(&envelope.message);
  if (got <= 0 || head == nullptr || head->cmsg_len != CMSG_LEN(sizeof(Numbers))) return {};
  Numbers numbers{};
  std::memcpy(numbers.data(), CMSG_DATA(head), sizeof numbers);
  files = {numbers[0], numbers[1], numbers[2], numbers[3]};
  text.resize(static_cast<std::size_t>(got));
  return text;
}

}  // namespace plumb
