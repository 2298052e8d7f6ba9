// The template that every page fills.
#pragma once

#include <string>
#include <string_view>

namespace plumb::report::html {

/// A whole page in the style sheet that all pages have. It loads nothing from a network, and nothing in it
/// runs but what `script_sources` allows. `title` is text, `body` is HTML; `script_sources` is a list as
/// Content Security Policy has it, empty where nothing may run.
std::string filled_template(std::string_view title, std::string_view body,
                            std::string_view script_sources = "");

/// Names an inline script or style in a policy (Content Security Policy Level 3, section 2.3.1).
std::string hash_source(std::string_view text);

}  // namespace plumb::report::html
