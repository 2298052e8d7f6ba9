#include "tracer/image/kind.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "tracer/image/channel_names.hpp"

namespace plumb {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  Kind kind;
};
constexpr std::array magics{
    Magic{"\x89PNG\r\n\x1a\n"sv, Kind::png},
    Magic{"\x76\x2f\x31\x01"sv, Kind::exr},
    Magic{"II\x2a\0"sv, Kind::tiff},
    Magic{"MM\0\x2a"sv, Kind::tiff},
    Magic{"II\x2b\0"sv, Kind::tiff},
    Magic{"MM\0\x2b"sv, Kind::tiff},
    Magic{"\xff\xd8\xff"sv, Kind::jpeg},
    Magic{"#?RADIANCE"sv, Kind::hdr},
    Magic{"#?RGBE"sv, Kind::hdr},
};

struct Other {
  std::size_t at;
  std::string_view bytes;
  std::string_view name;
};
constexpr std::array others{
    Other{0, "\0\0\1\0"sv, "an ICO file (Windows icons)"},
    Other{0, "\0\0\2\0"sv, "a CUR file (Windows cursors)"},
    Other{0, "GIF8"sv, "a GIF file"},
    Other{8, "WEBP"sv, "a WebP file"},
    Other{0, "8BPS"sv, "a PSD file (Photoshop)"},
    Other{0, "FORM"sv, "an IFF file"},
    Other{0, "FOR4"sv, "an IFF file"},
    Other{0, "SDPX"sv, "a DPX file"},
    Other{0, "XPDS"sv, "a DPX file"},
    Other{0, "\x80\x2a\x5f\xd7"sv, "a Cineon file"},
    Other{0, "\0\0\0\x0cjP  "sv, "a JPEG 2000 file"},
    Other{0, "\xff\x4f\xff\x51"sv, "a JPEG 2000 file"},
    Other{4, "ftyp"sv, "an ISO media file (HEIC, AVIF or a film)"},
    Other{0, "\0\0\0\x0cJXL "sv, "a JPEG XL file"},
    Other{0, "\xff\x0a"sv, "a JPEG XL file"},
    Other{0, "DDS "sv, "a DDS file"},
    Other{0, "\x01\xda"sv, "an SGI file"},
    Other{0, "P7\n"sv, "a PAM file (P7)"},
    Other{0, "\x59\xa6\x6a\x95"sv, "a Sun raster file"},
    Other{0, "SIMPLE  ="sv, "a FITS file"},
    Other{0, "%PDF"sv, "a PDF file"},
    Other{0, "PK\3\4"sv, "a ZIP archive"},
    Other{0, "\x1f\x8b"sv, "a gzip archive"},
    Other{0,
          "\x7f"
          "ELF"sv,
          "a program (ELF)"},
    Other{0, "MZ"sv, "a program (Windows)"},
    Other{0, "<?xml"sv, "an XML file"},
    Other{0, "<svg"sv, "an SVG file"},
};

unsigned byte_at(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }

/// "BM", four bytes of size, four reserved ones and the offset of the pixels, then a header of a known size.
bool is_bmp(std::string_view bytes) {
  constexpr std::array sizes{12U, 16U, 40U, 52U, 56U, 64U, 108U, 124U};
  return bytes.size() >= 18 && bytes.starts_with("BM"sv) && byte_at(bytes, 15) == 0 &&
         std::find(sizes.begin(), sizes.end(), byte_at(bytes, 14)) != sizes.end();
}

/// Truevision TGA 2.0: 18 bytes of header, of which several have few values.
bool has_tga_header(std::string_view bytes) {
  if (bytes.size() < 18) return false;
  const unsigned map = byte_at(bytes, 1), type = byte_at(bytes, 2), depth = byte_at(bytes, 16);
  const bool has_type = (type >= 1 && type <= 3) || (type >= 9 && type <= 11);
  const bool has_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
  const bool has_size =
      (byte_at(bytes, 12) | byte_at(bytes, 13)) != 0U && (byte_at(bytes, 14) | byte_at(bytes, 15)) != 0U;
  return map <= 1 && has_type && has_depth && has_size;
}

bool is_tga(std::string_view bytes, const std::string& extension) {
  constexpr std::string_view footer = "TRUEVISION-XFILE.\0"sv;
  if (!has_tga_header(bytes)) return false;
  return bytes.ends_with(footer) || extension == ".tga" || extension == ".vda" || extension == ".icb" ||
         extension == ".vst";
}

bool is_followed_by_space(std::string_view bytes) {
  return bytes.size() > 2 && (bytes[2] == '#' || " \t\n\v\f\r"sv.find(bytes[2]) != std::string_view::npos);
}

bool is_utf16(std::string_view bytes) {
  return bytes.starts_with("\xff\xfe"sv) || bytes.starts_with("\xfe\xff"sv) ||
         (bytes.size() >= 4 && bytes[0] == 'P' && bytes[1] == 0 && bytes[3] == 0) ||
         (bytes.size() >= 4 && bytes[0] == 0 && bytes[1] == 'P' && bytes[2] == 0);
}

constexpr std::string_view utf8_mark = "\xef\xbb\xbf"sv;

bool is_text(std::string_view bytes) {
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); });
}

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    char digits[4];
    std::snprintf(digits, sizeof digits, " %02x", static_cast<unsigned>(static_cast<unsigned char>(c)));
    text += digits;
  }
  return text;
}

}  // namespace

std::optional<Kind> kind_of(std::string_view bytes, const std::string& extension) {
  for (const Magic& magic : magics) {
    if (bytes.starts_with(magic.bytes)) return magic.kind;
  }
  if (bytes.size() >= 2 && bytes[0] == 'P') {
    const bool is_alone = bytes.size() == 2 || is_followed_by_space(bytes);
    if (bytes[1] >= '1' && bytes[1] <= '6' && is_alone) return Kind::netpbm;
    if ((bytes[1] == 'F' || bytes[1] == 'f') && is_alone) return Kind::pfm;
  }
  if (is_bmp(bytes)) return Kind::bmp;
  if (is_tga(bytes, extension)) return Kind::tga;
  return std::nullopt;
}

std::string seeming(std::string_view bytes) {
  constexpr std::size_t shown = 16;
  if (is_utf16(bytes)) return "UTF-16 text, as PowerShell's `>` writes";
  if (bytes.starts_with(utf8_mark)) return "text with a byte order mark of UTF-8 (EF BB BF) before it";
  for (const Other& other : others) {
    if (bytes.substr(std::min(other.at, bytes.size())).starts_with(other.bytes))
      return std::string(other.name);
  }
  const std::string_view head = bytes.substr(0, shown);
  if (is_text(head))
    return "text that begins with '" + printable(head.substr(0, head.find_first_of("\r\n"))) + "'";
  return "bytes that begin with" + hexadecimal(head.substr(0, 8));
}

std::string remedy(std::string_view bytes) {
  if (is_utf16(bytes) || bytes.starts_with(utf8_mark))
    return "; let the program write the file itself, in ASCII";
  return "; convert it, or let the program write one of these";
}

}  // namespace plumb
