#include "references/renderers/povray.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

#include "exporters/povray.hpp"
#include "references/renderers/povray_state.hpp"
#include "references/system/process.hpp"
#include "tracer/image/io.hpp"
#include "tracer/system/descriptor.hpp"
#include "tracer/system/files.hpp"
#include "tracer/text/numbers.hpp"

namespace plumb::renderers {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::string line;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      if (!line.empty()) lines.push_back(std::exchange(line, {}));
    } else {
      line += c;
    }
  }
  if (!line.empty()) lines.push_back(line);
  return lines;
}

/// `File 'in.pov' line 12: Parse Error: ...` gets that line of the SDL beside it.
std::string with_sdl_line(const std::string& message, const std::string& sdl) {
  const std::size_t at = message.find(" line ");
  if (message.find("File '") == std::string::npos || at == std::string::npos) return message;
  const long wanted = std::strtol(message.c_str() + at + 6, nullptr, 10);
  std::istringstream stream(sdl);
  std::string line;
  for (long number = 1; std::getline(stream, line); ++number) {
    if (number == wanted) return message + " | " + line.substr(0, 120);
  }
  return message;
}

std::string lines_with(const std::string& output, std::initializer_list<const char*> words,
                       const std::string& sdl) {
  std::string found;
  for (const std::string& line : lines_of(output)) {
    for (const char* word : words) {
      if (line.find(word) == std::string::npos) continue;
      found += (found.empty() ? "" : "\n") + with_sdl_line(line, sdl);
      break;
    }
  }
  return found;
}

std::string why_it_failed(const system::ProcessResult& result, const PovrayJob& job) {
  if (result.timed_out) return "POV-Ray took longer than " + to_text(job.time_limit_seconds) + " s";
  const std::string said = lines_with(result.output, {"rror"}, job.text);
  if (result.signal != 0)
    return "POV-Ray ended by signal " + std::to_string(result.signal) + (said.empty() ? "" : ": " + said);
  if (result.exit_code == 0) return {};
  return "POV-Ray ended with " + std::to_string(result.exit_code) + ": " +
         (said.empty() ? "it gave no reason" : said);
}

/// The bytes of a file that POV-Ray left: a regular one of a size that fits the picture, as far as it was
/// written then, so that reading it comes to an end.
std::string bytes_left(const std::string& path, const PovrayJob& job) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat info {};
  if (file.number() < 0 || ::fstat(file.number(), &info) != 0)
    throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
  constexpr std::int64_t bytes_of_a_pixel = 64;  // because a state file holds five floats of it
  constexpr std::int64_t bytes_beside = std::int64_t{1} << 26;
  const std::int64_t most = bytes_beside + bytes_of_a_pixel * job.width * job.height;
  if (!S_ISREG(info.st_mode)) throw std::runtime_error(path + ": is no regular file");
  if (info.st_size > most) {
    throw std::runtime_error(path + ": found " + std::to_string(info.st_size) + " bytes, expected at most " +
                             std::to_string(most));
  }
  std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t size = 0;
  for (ssize_t got = 1; got > 0 && size < bytes.size();
       size += static_cast<std::size_t>(std::max(got, ssize_t{0})))
    got = ::read(file.number(), bytes.data() + size, bytes.size() - size);
  bytes.resize(size);
  return bytes;
}

Image read_png(const std::string& path, const PovrayJob& job) {
  const system::TemporaryDirectory own;  // out of the program's reach
  const std::string copy = own.path() + "/out.png";
  write_file(copy, bytes_left(path, job));
  const ImageFile file = read_image(copy);
  if (file.width != job.width || file.height != job.height || file.channels != 3) {
    throw std::runtime_error("its PNG has another size or channel count than asked for");
  }
  Image image(file.width, file.height);
  image.rgb = file.values;
  return image;
}

/// The checked fall-back when the state file cannot be used.
void fall_back_to_png(const std::string& path, const PovrayJob& job, const std::string& why,
                      Rendered& picture) {
  try {
    picture.image = read_png(path, job);
  } catch (const std::runtime_error& error) {
    throw PovrayError("POV-Ray left no usable picture: " + why + "; " + error.what());
  }
  picture.holds = Holds::bits16;
  picture.warnings += (picture.warnings.empty() ? "" : "\n") + why +
                      ": 16 bits of its PNG are used, clamped at 1 and off by up to 7.7e-6";
}

/// An exported scene spans about so many of POV-Ray's units, in which its tolerances are.
constexpr double exported_units = 1e4;

double exported_extent(const Scene& scene, const Camera& camera) {
  return exported_units / exporters::export_space(scene, camera).scale;
}

}  // namespace

const Resolution& povray_resolution() {
  static constexpr Resolution resolution{
      .extent = &exported_extent,
      .step = 1e-4 / exported_units,  // because it takes the nearer of two hits only when they are 1e-4 apart
      .steps_to_blocker = 10,         // because its shadow tolerance is 1e-3
      .touched_edge = 1e-7,           // ten steps
      .one_place = 1e-6,              // 100 steps, for rays that graze the surfaces
      .told_apart = 2.5e-8,           // two steps; beyond, only the shadow tolerance acts
      .shadow = 2e-7,                 // twice the shadow tolerance
      .is_of_plumb = false};
  return resolution;
}

std::vector<std::string> povray_arguments(const PovrayJob& job) {
  std::vector<std::string> arguments{"+Iin.pov",
                                     "+Oout.png",
                                     "+W" + std::to_string(job.width),
                                     "+H" + std::to_string(job.height),
                                     job.holds == Holds::bits8 ? "+FN8" : "+FN16",
                                     "-D",
                                     "-A",
                                     "File_Gamma=1.0",
                                     "+WT2",
                                     "-GD",
                                     "-GR"};
  if (job.without_bounding) arguments.emplace_back("-MB");
  arguments.insert(arguments.end(), job.more_arguments.begin(), job.more_arguments.end());
  return arguments;
}

ExportedShot exported_by(const PovrayJob& job) {
  return {"povray", povray_arguments(job), job.text, job.width, job.height, job.holds};
}

Povray::Povray() : program_(system::find_program("povray")) {
  if (program_.empty())
    throw PovrayError("povray is not on PATH; install it (apt-get install povray) or use --stored");
}

std::string Povray::version() const {
  const system::TemporaryDirectory directory;
  system::ProcessLimits limits;
  limits.seconds = 60;
  const system::ProcessResult result = system::run_process({program_, "--version"}, directory.path(), limits);
  constexpr std::string_view before = "POV-Ray ";
  const std::size_t at = result.output.find(before);
  if (at == std::string::npos) throw PovrayError(program_ + " does not tell its version; is it POV-Ray?");
  const std::size_t begin = at + before.size();
  return result.output.substr(begin, result.output.find_first_of(" \r\n", begin) - begin);
}

Rendered Povray::render(const PovrayJob& job) const {
  const system::TemporaryDirectory directory;
  const std::string state = directory.path() + "/t.state";
  write_file(directory.path() + "/in.pov", job.text);
  // POV-Ray unlinks its state file at the end; as a symbolic link only the link goes.
  if (symlink("t.state", (directory.path() + "/out.pov-state").c_str()) != 0) {
    throw PovrayError(directory.path() + ": no symbolic link can be made there");
  }
  system::ProcessLimits limits;
  limits.seconds = job.time_limit_seconds;
  std::vector<std::string> command = povray_arguments(job);
  command.insert(command.begin(), program_);
  const system::ProcessResult result = system::run_process(command, directory.path(), limits);
  const std::string failure = why_it_failed(result, job);
  if (!failure.empty()) throw PovrayError(failure);

  Rendered picture;
  picture.cpu_seconds = result.cpu_seconds;
  picture.warnings = lines_with(result.output, {"Warning"}, job.text);
  picture.holds = job.holds;
  if (job.holds != Holds::float32) {
    picture.image = read_png(directory.path() + "/out.png", job);
    return picture;
  }
  try {
    picture.image = read_povray_state(bytes_left(state, job), job.width, job.height);
  } catch (const std::runtime_error& error) {
    fall_back_to_png(directory.path() + "/out.png", job, error.what(), picture);
  }
  return picture;
}

PovrayRenderer::PovrayRenderer(PovraySettings settings)
    : ProgramRenderer({"povray", "POV-Ray", settings.holds, povray_resolution()}),
      settings_(std::move(settings)) {}

PovrayJob PovrayRenderer::job_of(const Shot& shot) const {
  const auto space = settings_.in_own_units ? exporters::ExportSpace{1, Vec3d(0), false, false}
                                            : exporters::export_space(shot.scene, shot.camera);
  const auto exported = exporters::export_povray(shot, space);
  return {exported.text,
          shot.width,
          shot.height,
          exported.needs_flat_objects,
          settings_.time_limit_seconds,
          settings_.more_arguments,
          settings_.holds};
}

ExportedShot PovrayRenderer::exported(const Shot& shot) const { return exported_by(job_of(shot)); }

Rendered PovrayRenderer::render(const Shot& shot) const { return Povray().render(job_of(shot)); }

std::unique_ptr<const ProgramRenderer> povray_renderer(double time_limit_seconds) {
  PovraySettings settings;
  settings.time_limit_seconds = time_limit_seconds;
  return std::make_unique<PovrayRenderer>(std::move(settings));
}

}  // namespace plumb::renderers
