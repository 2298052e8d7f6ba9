// Splits the command of a tracer, as its user wrote it, into arguments. No shell ever reads it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumb::submissions {

/// Splits at blanks. '...' keeps all; "..." and a bare \ keep the character after a \. Nothing else has a
/// meaning: no variable, no pattern, no pipe. Throws std::invalid_argument for an open quote or no word.
std::vector<std::string> split_command(std::string_view command);

/// True if an argument holds {name}.
bool mentions(const std::vector<std::string>& arguments, std::string_view name);

/// Replaces each {name} within an argument by its value, once. Values are not searched again.
std::vector<std::string> substituted(const std::vector<std::string>& arguments,
                                     const std::map<std::string, std::string>& values);

}  // namespace plumb::submissions
