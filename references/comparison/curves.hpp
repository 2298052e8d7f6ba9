// What happens to values between a renderer and a file.
#pragma once

namespace plumb::references::curves {

/// IEC 61966-2-1, continued as its line below 0 and as its power above 1.
double srgb_encoded(double linear);
double srgb_decoded(double encoded);
/// c / (c + 1) of the course's framework; negative colours count as 0.
double tone_mapped(double linear);
/// The nearest half float (IEEE 754 binary16, ties to even) below its overflow.
float half_rounded(float value);
/// Whether it is k / most for a whole k from 0 to `most` (255, 65535), as a float holds it.
bool is_level(float value, int most);

}  // namespace plumb::references::curves
