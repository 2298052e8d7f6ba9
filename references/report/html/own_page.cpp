#include "references/report/html/own_page.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace plumb::report {

void refuse_to_replace_others(const std::string& page) {
  if (!std::filesystem::is_regular_file(page)) return;
  std::ifstream file(page, std::ios::binary);
  std::string head(1000, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.find(generator_tag) != std::string::npos) return;
  throw std::runtime_error(page + ": is no page of plumb's and is not replaced; choose another directory");
}

}  // namespace plumb::report
