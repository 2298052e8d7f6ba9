#include "tracer/image/netpbm_writers.hpp"

#include <bit>
#include <cstring>
#include <string>

namespace plumb {
namespace {

std::string size_line(int width, int height) {
  return std::to_string(width) + " " + std::to_string(height) + "\n";
}

class PfmWriter final : public RowWriter<float> {
 public:
  PfmWriter(ByteSink& file, int width, int height)
      : file_(file), row_(3 * static_cast<std::size_t>(width)), rows_left_(static_cast<std::size_t>(height)) {
    static_assert(std::endian::native == std::endian::little);
    const std::string header = "PF\n" + size_line(width, height) + "-1.0\n";
    file.write(header);
    header_ = header.size();
  }
  void write(std::span<const float> rows) override {
    const std::size_t row_bytes = row_ * sizeof(float);
    std::string bytes(rows.size_bytes(), '\0');
    char* to = bytes.data();
    for (std::size_t end = rows.size(); end > 0; end -= row_, to += row_bytes)
      std::memcpy(to, &rows[end - row_], row_bytes);
    rows_left_ -= rows.size() / row_;
    file_.seek(header_ + rows_left_ * row_bytes);
    file_.write(bytes);
  }
  void finish() override {}

 private:
  ByteSink& file_;
  std::size_t row_, rows_left_, header_;  ///< values, rows, bytes
};

class PpmWriter final : public RowWriter<std::uint8_t> {
 public:
  PpmWriter(ByteSink& file, int width, int height) : file_(file), row_(3 * static_cast<std::size_t>(width)) {
    file.write("P3\n" + size_line(width, height) + "255\n");
  }
  void write(std::span<const std::uint8_t> rows) override {
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      text += std::to_string(rows[i]);
      text += (i + 1) % row_ == 0 ? '\n' : ' ';
    }
    file_.write(text);
  }
  void finish() override {}

 private:
  ByteSink& file_;
  std::size_t row_;  ///< values
};

}  // namespace

std::unique_ptr<RowWriter<float>> pfm_writer(ByteSink& file, int width, int height) {
  return std::make_unique<PfmWriter>(file, width, height);
}

std::unique_ptr<RowWriter<std::uint8_t>> ppm_writer(ByteSink& file, int width, int height) {
  return std::make_unique<PpmWriter>(file, width, height);
}

}  // namespace plumb
