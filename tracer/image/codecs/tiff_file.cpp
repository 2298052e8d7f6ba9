#include "tracer/image/codecs/tiff_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include "tracer/image/channel_names.hpp"

namespace plumb::codecs {

tmsize_t TiffFile::read(thandle_t user, void* to, tmsize_t size) {
  auto& bytes = *static_cast<Bytes*>(user);
  if (size < 0 || bytes.at >= bytes.all.size()) return 0;
  const std::size_t count =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(size), bytes.all.size() - bytes.at);
  std::memcpy(to, bytes.all.data() + bytes.at, count);
  bytes.at += count;
  return static_cast<tmsize_t>(count);
}

toff_t TiffFile::seek(thandle_t user, toff_t offset, int from) {
  auto& bytes = *static_cast<Bytes*>(user);
  bytes.at = offset + (from == SEEK_CUR ? bytes.at : from == SEEK_END ? bytes.all.size() : 0);
  return bytes.at;
}

TiffFile::TiffFile(std::string_view bytes) : bytes_(new Bytes{bytes}) {
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  const auto write = [](thandle_t, void*, tmsize_t) -> tmsize_t { return 0; };
  const auto close = [](thandle_t) { return 0; };
  const auto size = [](thandle_t user) -> toff_t { return static_cast<Bytes*>(user)->all.size(); };
  const auto map = [](thandle_t user, void** base, toff_t* length) {
    const std::string_view all = static_cast<Bytes*>(user)->all;
    *base = const_cast<char*>(all.data());
    *length = all.size();
    return 1;
  };
  const auto unmap = [](thandle_t, void*, toff_t) {};
  file_.reset(TIFFClientOpen("picture", "r", bytes_.get(), read, write, seek, close, size, map, unmap));
}

void choose_page(const Source& source, const TiffFile& file, FileContents& contents) {
  const int pages = static_cast<int>(TIFFNumberOfDirectories(file.get()));
  int page = 1;
  if (!source.part.empty()) {
    const char* const end = source.part.data() + source.part.size();
    const auto [at, error] = std::from_chars(source.part.data(), end, page);
    if (error != std::errc() || at != end || page < 1 || page > pages)
      throw std::runtime_error(source.path + ": cannot be read: found no part '" + printable(source.part) +
                               "', expected a page from 1 to " + std::to_string(pages));
  }
  if (TIFFSetDirectory(file.get(), static_cast<tdir_t>(page - 1)) == 0)
    throw std::runtime_error(source.path + ": cannot be read: page " + std::to_string(page) +
                             " cannot be found");
  if (pages > 1) contents.part = std::to_string(page);
  constexpr int most_named = 20;
  for (int i = 1; i <= std::min(pages, most_named); ++i) {
    if (i != page) contents.not_read.push_back("page " + std::to_string(i) + " of " + std::to_string(pages));
  }
  if (pages > most_named)
    contents.not_read.push_back("pages " + std::to_string(most_named + 1) + " to " + std::to_string(pages));
  std::uint16_t count = 0;
  toff_t* offsets = nullptr;
  if (TIFFGetField(file.get(), TIFFTAG_SUBIFD, &count, &offsets) == 1 && count > 0)
    contents.not_read.push_back(std::to_string(count) + " pictures inside the page (SubIFD)");
}

}  // namespace plumb::codecs
