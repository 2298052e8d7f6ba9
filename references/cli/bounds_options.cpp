#include "references/cli/bounds_options.hpp"

#include "references/cli/options.hpp"

namespace plumb::cli {

Table bounds_options(gates::Bounds& bounds) {
  const auto reader = [](std::vector<gates::Region>& regions, const char* name) {
    return [&regions, name](const std::string& text) { regions.push_back(gates::parse_region(text, name)); };
  };
  constexpr const char* region = "X,Y,W,H|MASK";
  const auto read_allowed = [&bounds](const std::string& text) {
    bounds.allow_over = gates::parse_allow_over(text, "--allow-over");
  };
  return {{"--allow-over",
           read_allowed,
           "how many pixels may be over: a number, or a percentage of those compared; never one "
           "that is not finite",
           {.value = "N|P%", .default_text = bounds.allow_over.text()}},
          {"--relative",
           &bounds.limit.relative,
           "a component also agrees when it differs by at most T * |reference|",
           {.value = "T", .complaint = complaint_about_size}},
          {"--ignore",
           reader(bounds.ignore, "--ignore"),
           "leave out this rectangle, or the pixels of this mask image that are not black; repeatable",
           {.value = region, .is_repeatable = true}},
          {"--only",
           reader(bounds.only, "--only"),
           "compare nothing but this rectangle or mask; repeatable",
           {.value = region, .is_repeatable = true}}};
}

}  // namespace plumb::cli
