// The page's own parts, bundled from references/report/web when plumb is built.
#pragma once

#include <string_view>

namespace plumb::report::web {

extern const std::string_view page;    ///< HTML with {{title}}, {{policy}}, {{style}} and {{body}}
extern const std::string_view style;   ///< CSS
extern const std::string_view script;  ///< one classic script

}  // namespace plumb::report::web
