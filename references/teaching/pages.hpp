// Pages for students: each fault with its formula and a pair of pictures.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "references/diagnosis/output_encoding.hpp"
#include "references/faults/fault.hpp"
#include "references/report/html/document.hpp"
#include "tracer/image/image_file.hpp"

namespace plumb::references::teaching {

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
Picture picture_of(const Image& image, const OutputEncoding& encoding);

/// Where two pictures of one size differ: black where they agree, brighter by html::difference_gain.
Picture difference_of(const Picture& a, const Picture& b);

/// The two of one size, and difference_of them, as the pages show them.
html::ThreePictures three_pictures(const Picture& right, const Picture& yours);

/// <section id=FAULT>: what is wrong, both formulas, how common it is, and the fault's own scene rendered
/// right and wrong. `remark` is HTML that follows the sentence. Throws std::runtime_error when the scene is
/// not in the directory.
std::string section_of(const Fault& fault, const std::string& scenes, const std::string& remark = "");

/// All faults, by slide. `progress` is called with 0 to 1.
std::string faults_page(const std::string& scenes, const std::function<void(double)>& progress);

}  // namespace plumb::references::teaching
