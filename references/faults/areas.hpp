// The catalogue's parts, one for each area of the lecture.
#pragma once

#include "references/faults/fault.hpp"

namespace plumb::faults {

std::vector<Fault> of_the_camera();
std::vector<Fault> families_of_the_image_plane();
std::vector<Fault> families_of_the_transforms();
std::vector<Fault> of_the_lighting();
std::vector<Fault> of_the_lights();
std::vector<Fault> of_the_shadows();
std::vector<Fault> of_the_transforms();
std::vector<Fault> of_the_shapes();
std::vector<Fault> of_the_recursion();
std::vector<Fault> of_the_output();
std::vector<Fault> of_what_is_missing();
std::vector<Fault> families_of_the_shading();

}  // namespace plumb::faults
