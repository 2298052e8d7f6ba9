// What may happen to values between a renderer and a file.
#pragma once

namespace plumb::comparison::curves {

/// The curve of IEC 61966-2-1, continued as its line below 0 and as its power above 1.
double srgb_encoded(double linear);
double srgb_decoded(double encoded);
/// c / (c + 1), as in the course's framework; negative colours become 0.
double tone_mapped(double linear);
/// Returns the nearest half float (IEEE 754 binary16, ties to even) to a value below its overflow.
float half_rounded(float value);
/// True if the value is k / most for an integer k from 0 to `most` (255, 65535), as a float holds it.
bool is_level(float value, int most);

}  // namespace plumb::comparison::curves
