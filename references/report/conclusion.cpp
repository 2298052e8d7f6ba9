#include "references/report/conclusion.hpp"

#include <algorithm>
#include <cctype>

namespace plumb::report {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::size_t count_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<std::size_t>() : 0;
}

const Json& part_of(const Json& object, const char* key) {
  static const Json nothing = Json::object();
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : nothing;
}

std::string pixels(std::size_t count) { return std::to_string(count) + (count == 1 ? " pixel" : " pixels"); }

std::string as_sentence(std::string text) {
  text = text.substr(0, text.find('\n'));
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text.back() == '.' ? text : text + ".";
}

/// Pixels that count: where regions are left out, those that are not.
std::size_t compared_pixels(const Json& result) {
  const Json& bounds = part_of(result, "bounds");
  return bounds.contains("pixels_compared") ? count_of(bounds, "pixels_compared")
                                            : count_of(result, "width") * count_of(result, "height");
}

/// Of a result that leaves pixels out, how many it does not; else empty.
std::string of_the_compared(const Json& result) {
  if (count_of(part_of(result, "bounds"), "pixels_ignored") == 0) return {};
  return ", of the " + std::to_string(compared_pixels(result)) + " that were compared";
}

std::string unverified_text(const Json& result) {
  const std::size_t unverified = count_of(result, "unverified");
  return unverified == 0 ? "" : ", " + std::to_string(unverified) + " of them unverified";
}

std::string why_it_is_right(const Json& result, std::size_t over) {
  if (over == 0) return "no pixel is over the tolerance" + of_the_compared(result);
  const Json& budget = part_of(result, "budget");
  if (!budget.empty() && count_of(budget, "unexplained") == 0)
    return "each of the " + pixels(over) + " over the tolerance is explained by a proof" +
           unverified_text(result);
  return pixels(over) + (over == 1 ? " is" : " are") + " over the tolerance" + of_the_compared(result) +
         ", as the bounds allow";
}

std::string what_differs(const Json& result, std::size_t over) {
  const std::size_t all = compared_pixels(result);
  std::string text = all > over ? std::to_string(over) + " of " + pixels(all)
                     : all > 1  ? "all " + pixels(over)
                                : pixels(over);
  if (!of_the_compared(result).empty()) text += " that were compared";
  text += over == 1 ? " is over the tolerance" : " are over the tolerance";
  if (const std::size_t open = count_of(part_of(result, "budget"), "unexplained"); open > 0)
    text += ", " + std::to_string(open) + " of them unexplained";
  text += unverified_text(result);
  if (const std::size_t odd = count_of(result, "non_finite"); odd > 0)
    text += ", " + std::to_string(odd) + " not finite";
  if (const std::string cause = text_of(part_of(result, "likely_cause"), "text"); !cause.empty())
    text += "; likely cause: " + cause;
  return text;
}

}  // namespace

std::string conclusion_of(const Json& result) {
  const std::string status = text_of(result, "status"), message = text_of(result, "message");
  if (const std::string why = text_of(result, "not_compared"); !why.empty()) return as_sentence(why);
  if (status == "error") return as_sentence("nothing was compared: " + message);
  const std::size_t over = count_of(result, "pixels_over");
  if (status == "agree") return "Yours is right: " + why_it_is_right(result, over) + ".";
  if (over == 0 && !message.empty()) return as_sentence("yours differs: " + message);
  return "Yours differs: " + what_differs(result, over) + ".";
}

std::string conclusion_of_all(const Json& entries) {
  if (entries.size() == 1) return text_of(entries[0], "conclusion");
  const auto count = [&](const char* status) {
    return static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), [&](const Json& entry) {
      return text_of(part_of(entry, "result"), "status") == status;
    }));
  };
  const std::size_t all = entries.size(), differ = count("differ"), trouble = count("error");
  const auto some = [&](std::size_t number, const char* one, const char* several) {
    return std::to_string(number) + " of " + std::to_string(all) + (number == 1 ? one : several);
  };
  if (differ + trouble == 0) return "All " + std::to_string(all) + " are right.";
  std::string text = differ > 0 ? some(differ, " differs", " differ") : "";
  if (trouble > 0) text += (text.empty() ? "" : "; ") + some(trouble, " is in trouble", " are in trouble");
  const std::size_t right = all - differ - trouble;
  return text +
         (right == 0 ? "." : "; " + std::to_string(right) + (right == 1 ? " is right." : " are right."));
}

}  // namespace plumb::report
