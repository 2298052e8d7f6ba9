#include "tests/support/image_bytes.hpp"

#include <zlib.h>

#include <algorithm>

namespace plumb::tests {
namespace {

std::string big(std::uint32_t value) { return little(__builtin_bswap32(value)); }

std::string chunk(const std::string& name, const std::string& data) {
  const std::string sum = name + data;
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(sum.data()), static_cast<uInt>(sum.size()));
  return big(static_cast<std::uint32_t>(data.size())) + sum + big(static_cast<std::uint32_t>(crc));
}

std::string deflated(const std::string& bytes) {
  uLongf size = ::compressBound(bytes.size());
  std::string packed(size, '\0');
  ::compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
  packed.resize(size);
  return packed;
}

std::string entry(int tag, int type, std::uint32_t count, std::uint32_t value) {
  return little(static_cast<std::uint16_t>(tag)) + little(static_cast<std::uint16_t>(type)) + little(count) +
         little(value);
}

/// `at` is where the page begins: its pixels, its bits of each sample, then its directory.
std::string page_bytes(const TiffPage& page, std::uint32_t at, bool is_last) {
  constexpr int word = 3, number = 4;
  std::string bytes = page.pixels;
  if (bytes.size() % 2 == 1) bytes += '\0';
  const auto bits = static_cast<std::uint32_t>(at + bytes.size());
  for (int i = 0; i < page.samples; ++i) bytes += little(page.bits);
  for (int i = 0; i < page.samples; ++i) bytes += little(page.format);
  const bool is_short = page.samples <= 2;
  const std::uint32_t all_bits = page.bits | (page.samples == 2 ? std::uint32_t{page.bits} << 16 : 0U);
  const std::uint32_t all_formats = page.format | (page.samples == 2 ? std::uint32_t{page.format} << 16 : 0U);
  std::vector<std::string> entries{entry(256, number, 1, page.width),
                                   entry(257, number, 1, page.height),
                                   entry(258, word, page.samples, is_short ? all_bits : bits),
                                   entry(259, word, 1, 1),
                                   entry(262, word, 1, page.photometric),
                                   entry(273, number, 1, at),
                                   entry(277, word, 1, page.samples),
                                   entry(278, number, 1, page.height),
                                   entry(279, number, 1, static_cast<std::uint32_t>(page.pixels.size()))};
  if (page.extra >= 0) entries.push_back(entry(338, word, 1, static_cast<std::uint32_t>(page.extra)));
  entries.push_back(entry(339, word, page.samples, is_short ? all_formats : bits + 2U * page.samples));
  const auto directory = static_cast<std::uint32_t>(at + bytes.size());
  std::string head = little(static_cast<std::uint16_t>(entries.size()));
  for (const std::string& e : entries) head += e;
  const auto end = static_cast<std::uint32_t>(directory + head.size() + 8);
  // The next page begins behind; its own first word says where its directory is.
  return bytes + head + little(is_last ? 0U : end) + little(directory);
}

std::uint32_t directory_of(const std::string& page) {
  std::uint32_t at = 0;
  std::copy_n(page.end() - 4, 4, reinterpret_cast<char*>(&at));
  return at;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little(static_cast<std::int32_t>(value.size())) + value;
}

std::string box(const ExrPart::Box& b) {
  return little(b.left) + little(b.top) + little(b.right) + little(b.bottom);
}

std::string header(const ExrPart& part, bool is_one_of_many) {
  std::string channels;
  for (const auto& channel : part.channels)
    channels += channel.name + '\0' + little(channel.type) + std::string(4, '\0') + little(1) + little(1);
  std::string text = attribute("channels", "chlist", channels + '\0') +
                     attribute("compression", "compression", std::string(1, '\0')) +
                     attribute("dataWindow", "box2i", box(part.data)) +
                     attribute("displayWindow", "box2i", box(part.display)) +
                     attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                     attribute("pixelAspectRatio", "float", little(1.0F)) +
                     attribute("screenWindowCenter", "v2f", little(0.0F) + little(0.0F)) +
                     attribute("screenWindowWidth", "float", little(1.0F));
  if (is_one_of_many)
    text += attribute("name", "string", part.name) + attribute("type", "string", "scanlineimage") +
            attribute("chunkCount", "int", little(part.data.bottom - part.data.top + 1));
  return text + '\0';
}

std::string line_of(const ExrPart& part, int y) {
  const int width = part.data.right - part.data.left + 1;
  std::string line;
  for (const auto& channel : part.channels) {
    for (int x = 0; x < width; ++x) {
      const double value = channel.values.at(static_cast<std::size_t>(y * width + x));
      line +=
          channel.type == 0 ? little(static_cast<std::uint32_t>(value)) : little(static_cast<float>(value));
    }
  }
  return little(part.data.top + y) + little(static_cast<std::int32_t>(line.size())) + line;
}

}  // namespace

std::string PngFile::bytes() const {
  std::string header = big(width) + big(height);
  for (const int byte : {depth, colour, 0, 0, is_interlaced ? 1 : 0}) header += static_cast<char>(byte);
  std::string pixels;
  for (const std::string& row : rows) pixels += '\0' + row;
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + (palette.empty() ? "" : chunk("PLTE", palette)) +
         (transparency.empty() ? "" : chunk("tRNS", transparency)) + chunk("IDAT", deflated(pixels)) +
         chunk("IEND", "");
}

std::string tiff_bytes(const std::vector<TiffPage>& pages) {
  constexpr std::uint32_t head = 8;
  std::vector<std::string> parts;
  std::uint32_t at = head;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    parts.push_back(page_bytes(pages[i], at, i + 1 == pages.size()));
    at += static_cast<std::uint32_t>(parts.back().size());
  }
  std::string bytes = std::string("II\x2a\0", 4) + little(directory_of(parts[0]));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i + 1 < parts.size()) {
      const std::string next = little(directory_of(parts[i + 1]));
      parts[i].replace(parts[i].size() - 8, 4, next);
    }
    bytes += parts[i];
  }
  return bytes;
}

std::string exr_bytes(const std::vector<ExrPart>& parts) {
  const bool are_many = parts.size() > 1;
  std::string bytes = std::string("\x76\x2f\x31\x01", 4) + little(are_many ? 0x1002 : 2);
  for (const ExrPart& part : parts) bytes += header(part, are_many);
  if (are_many) bytes += '\0';
  std::size_t lines = 0;
  for (const ExrPart& part : parts) lines += static_cast<std::size_t>(part.data.bottom - part.data.top + 1);
  std::string table, chunks;
  const std::size_t first = bytes.size() + 8 * lines;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (int y = 0; y <= parts[i].data.bottom - parts[i].data.top; ++y) {
      table += little(static_cast<std::uint64_t>(first + chunks.size()));
      chunks += (are_many ? little(static_cast<std::int32_t>(i)) : "") + line_of(parts[i], y);
    }
  }
  return bytes + table + chunks;
}

}  // namespace plumb::tests
