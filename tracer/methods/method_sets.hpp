// Other ways to compute what the lecture draws. Each replaces a few entries of the textbook tracer's table.
#pragma once

#include <string_view>
#include <vector>

#include "tracer/image/image.hpp"
#include "tracer/scene/scene.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::methods {

struct MethodSet {
  std::string_view id;      ///< lower case, words joined by -
  std::string_view title;   ///< a few words
  std::string_view source;  ///< author, year, title of the paper; or where it is common
};

/// All sets; the first is "lecture", the default formulas.
const std::vector<MethodSet>& method_sets();

/// Returns the set of that id, or null.
const MethodSet* find_method_set(std::string_view id);

/// Renders with the textbook tracer and the entries of `set`, in job.real. Colours may not be finite. Throws
/// what textbook::render throws, and std::invalid_argument for a set that is none of method_sets().
Image render_with_methods(const MethodSet& set, const Scene& scene, const Camera& camera,
                          const textbook::RenderJob& job);

}  // namespace plumb::methods
