// libFuzzer on the scene reader: any text gives findings or a scene that can be written, read again and
// exported.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "exporters/povray.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/format/writer.hpp"

namespace {

constexpr const char* dialects[] = {"strict", "loose",
                                    "loose,refl-opacity-ior,la-ld,light-color,la-ld-brightness",
                                    "loose,transparency-ior-m,brightness-rgb,post", "trs,skip-refl"};

void check(std::string_view text, const plumb::Dialect& dialect) {
  const plumb::ReadResult result = plumb::read_scene(text, dialect);
  if (result.has_errors()) return;
  const plumb::Scene& scene = result.scene;
  const std::string written = plumb::write_scene(scene);
  const plumb::ReadResult again = plumb::read_scene(written);
  if (again.has_errors() || !(again.scene == scene)) std::abort();
  constexpr std::size_t small = 200;  // exporting many is slow, not instructive
  if (scene.shapes.size() > small) return;
  plumb::exporters::export_povray(plumb::shot_of(scene, {}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* const dialect : dialects) check(text, plumb::parse_dialect(dialect));
  plumb::propose_dialects(text);
  return 0;
}
