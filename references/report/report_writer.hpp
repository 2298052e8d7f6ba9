// Writes the report: one page, index.html, that needs no network and no server.
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "references/report/report_entry.hpp"

namespace plumb::report {

/// Pictures are kept bit by bit (float32, NaN and infinities too). Up to `most_inline` bytes of them stand in
/// the page. With more, all lie beside it in pictures/, and the page loads each when it is looked at.
class ReportWriter {
 public:
  static constexpr std::size_t default_most_inline = 50'000'000;

  /// Makes the directory. Throws std::runtime_error naming it when it cannot.
  ReportWriter(std::string directory, std::string title, std::string subtitle,
               std::size_t most_inline = default_most_inline);

  /// Adds an entry; the page lists entries as they are added. Several threads may call it. Throws
  /// std::invalid_argument for an entry whose pictures or notes do not fit each other.
  void add(const ReportEntry& entry);

  /// Replaces index.html, after all that it loads is in place, then removes pictures of earlier reports.
  /// Throws std::runtime_error; an earlier report is then as it was.
  void finish();

 private:
  struct Picture {
    std::string id;    ///< "" when the scene has none
    std::string text;  ///< base64; "" once it lies beside the page
  };

  void move_beside(Picture& picture) const;
  void remove_old_pictures() const;
  std::string blocks() const;

  const std::string directory_;
  const std::string title_;
  const std::string subtitle_;
  const std::size_t most_inline_;
  std::mutex mutex_;
  nlohmann::ordered_json scenes_ = nlohmann::ordered_json::array();
  std::vector<Picture> pictures_;
  std::size_t inline_bytes_ = 0;
  bool is_beside_ = false;
};

}  // namespace plumb::report
