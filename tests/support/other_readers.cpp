#include "tests/support/other_readers.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>

#include "references/system/process.hpp"
#include "tracer/system/files.hpp"

namespace plumb::tests {
namespace {

/// A P6 of 8 bits as oiiotool writes it. Not by our own reader, because that one is judged.
ImageFile pixels_of_p6(const std::string& bytes) {
  std::istringstream in(bytes);
  std::string magic;
  int most = 0;
  ImageFile file;
  in >> magic >> file.width >> file.height >> most;
  EXPECT_EQ(magic, "P6");
  EXPECT_EQ(most, 255);
  const auto values = 3 * static_cast<std::size_t>(file.width) * static_cast<std::size_t>(file.height);
  if (bytes.size() < values) return file;
  file.channels = 3;
  file.sample = Sample::bits8;
  for (const char byte : bytes.substr(bytes.size() - values))
    file.values.push_back(static_cast<float>(static_cast<std::uint8_t>(byte)) / 255);
  return file;
}

}  // namespace

ImageFile as_oiiotool_reads(const std::string& path) {
  const system::TemporaryDirectory directory;
  const std::string copy = directory.path() + "/copy.ppm";
  const std::string tool = system::find_program("oiiotool");
  EXPECT_NE(tool, "") << "openimageio-tools is not installed";
  if (tool.empty()) return {};
  const auto run = system::run_process({tool, path, "-o", copy}, directory.path(), {});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return run.exit_code == 0 ? pixels_of_p6(read_file(copy)) : ImageFile{};
}

}  // namespace plumb::tests
