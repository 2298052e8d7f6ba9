// Pictures as pages show them.
#pragma once

#include <vector>

#include "references/diagnosis/output_encoding.hpp"
#include "references/report/html/document.hpp"
#include "tracer/image/image.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::teaching {

/// 8-bit r g b, interleaved, row 0 on top.
struct Picture {
  int width;
  int height;
  std::vector<unsigned char> levels;
};

/// Tone-mapped and truncated, as the course hands pictures over.
Picture picture_of(const Image& image);

/// A picture that was handed over, to the nearest level; what is no number is black.
Picture picture_of(const ImageFile& image);

/// As a tracer with that encoding would have written it; floats are clamped.
Picture picture_of(const Image& image, const diagnosis::OutputEncoding& encoding);

/// Where two pictures of one size differ: black where they agree, brighter by report::html::difference_gain.
Picture difference_of(const Picture& a, const Picture& b);

/// The two of one size, and difference_of them, as the pages show them.
report::html::ThreePictures three_pictures(const Picture& right, const Picture& yours);

}  // namespace plumb::teaching
