#include "tracer/image/decoded_message.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <stdexcept>
#include <system_error>

#include "tracer/image/channel_names.hpp"

namespace plumb {
namespace {

using Outcome = DecodedMessage::Outcome;

/// Fields, each ended by a NUL.
class Fields {
 public:
  explicit Fields(std::string_view rest) : rest_(rest) {}

  std::string text() {
    const std::size_t end = rest_.find('\0');
    if (end == std::string_view::npos) throw std::invalid_argument("a field has no end");
    const std::string_view found = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return printable(found);
  }
  std::int64_t number(std::int64_t least, std::int64_t most) {
    const std::string digits = text();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || value < least || value > most)
      throw std::invalid_argument("a field is out of range");
    return value;
  }
  int small(int least, int most) { return static_cast<int>(number(least, most)); }
  bool is_empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

constexpr int longest = 1 << 30;
constexpr int most_texts = 1 << 12;

void add(std::string& text, const std::string& field) { text += printable(field) + '\0'; }
void add(std::string& text, std::int64_t field) { add(text, std::to_string(field)); }
void add(std::string& text, const std::vector<std::string>& fields) {
  add(text, static_cast<std::int64_t>(fields.size()));
  for (const std::string& field : fields) add(text, field);
}
void add(std::string& text, const std::optional<Window>& window) {
  add(text, window ? 1 : 0);
  const Window w = window.value_or(Window{});
  for (const int field : {w.x, w.y, w.width, w.height}) add(text, field);
}

std::vector<std::string> texts(Fields& fields) {
  std::vector<std::string> found(static_cast<std::size_t>(fields.small(0, most_texts)));
  for (std::string& text : found) text = fields.text();
  return found;
}

std::optional<Window> window(Fields& fields) {
  const bool is_there = fields.small(0, 1) == 1;
  constexpr std::int64_t far = std::int64_t{1} << 31;
  Window w;
  w.x = static_cast<int>(fields.number(-far, far - 1));
  w.y = static_cast<int>(fields.number(-far, far - 1));
  w.width = fields.small(0, longest);
  w.height = fields.small(0, longest);
  return is_there ? std::optional(w) : std::nullopt;
}

Shape shape(Fields& fields) {
  constexpr int most_channels = 1024;
  Shape s;
  s.width = fields.small(1, longest);
  s.height = fields.small(1, longest);
  s.channels = fields.small(1, most_channels);
  s.component = static_cast<Component>(fields.small(0, static_cast<int>(Component::float64)));
  s.sample = static_cast<Sample>(fields.small(0, static_cast<int>(Sample::float32)));
  s.contents.part = fields.text();
  s.contents.window = window(fields);
  s.contents.display = window(fields);
  s.contents.channels = texts(fields);
  s.contents.not_read = texts(fields);
  while (!fields.is_empty()) s.contents.are_whole.push_back(fields.small(0, 1) == 1);
  if (!s.contents.are_whole.empty() && s.contents.are_whole.size() != static_cast<std::size_t>(s.channels))
    throw std::invalid_argument("whole numbers are in other channels than there are");
  if (!s.contents.channels.empty() && s.contents.channels.size() != static_cast<std::size_t>(s.channels))
    throw std::invalid_argument("other channels are named than there are");
  return s;
}

}  // namespace

std::string text_of(const DecodedMessage& message) {
  std::string text;
  add(text, static_cast<int>(message.outcome));
  add(text, message.why);
  add(text, message.width);
  add(text, message.height);
  if (message.outcome != Outcome::decoded) return text;
  const Shape& s = message.shape;
  for (const int field :
       {s.width, s.height, s.channels, static_cast<int>(s.component), static_cast<int>(s.sample)})
    add(text, field);
  add(text, s.contents.part);
  add(text, s.contents.window);
  add(text, s.contents.display);
  add(text, s.contents.channels);
  add(text, s.contents.not_read);
  for (const bool is_whole : s.contents.are_whole) add(text, is_whole ? 1 : 0);
  return text;
}

std::optional<DecodedMessage> decoded_message(std::string_view text) {
  try {
    Fields fields(text);
    DecodedMessage message;
    message.outcome = static_cast<Outcome>(fields.small(0, static_cast<int>(Outcome::other_decoder)));
    message.why = fields.text();
    message.width = fields.number(0, std::int64_t{1} << 32);
    message.height = fields.number(0, std::int64_t{1} << 32);
    if (message.outcome == Outcome::decoded) message.shape = shape(fields);
    return fields.is_empty() ? std::optional(message) : std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::string read_to_end(int from, std::chrono::milliseconds patience) {
  using std::chrono::steady_clock;
  const auto end = steady_clock::now() + patience;
  std::string text;
  while (text.size() < longest_message) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - steady_clock::now()).count();
    if (left < 0) throw std::system_error(ETIMEDOUT, std::generic_category());
    pollfd waited{from, POLLIN, 0};
    if (::poll(&waited, 1, static_cast<int>(left)) < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category());
    if (waited.revents == 0) continue;
    std::array<char, 4096> bytes;
    const ssize_t got = ::read(from, bytes.data(), bytes.size());
    if (got == 0) return text;
    if (got > 0) text.append(bytes.data(), static_cast<std::size_t>(got));
  }
  return text;
}

}  // namespace plumb
