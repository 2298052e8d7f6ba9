// Text that comes from scenes and files, made harmless in a page.
#pragma once

#include <string>
#include <string_view>

namespace plumb::report {

/// Stands in HTML, between tags or in a quoted attribute, as itself.
std::string html_escaped(std::string_view text);

}  // namespace plumb::report
