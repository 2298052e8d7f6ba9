#include "tracer/image/codecs/exr_layout.hpp"

#include <algorithm>
#include <charconv>

#include "tracer/image/channel_names.hpp"
#include "tracer/image/codecs/damage.hpp"

namespace plumb::codecs {
namespace {

struct Bounds {
  std::int64_t left, top, right, bottom;  ///< inclusive
};

class ExrLayoutReader {
 public:
  ExrLayoutReader(const Source& source, exr_const_context_t context) : source_(source), context_(context) {}

  ExrLayout layout() {
    expect(exr_get_count(context_, &parts_), "number of parts");
    layout_.part = chosen_part();
    expect(exr_get_storage(context_, layout_.part, &layout_.storage), "kind of part");
    if (is_deep(layout_.storage)) fail("deep EXR isn't supported; flatten it before it is compared");
    expect(exr_get_compression(context_, layout_.part, &layout_.compression), "compression");
    read_channels();
    read_windows();
    note_what_is_left();
    return std::move(layout_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(source_.path + ": cannot be read: " + why);
  }
  void expect(exr_result_t result, const std::string& what) const {
    if (result != EXR_ERR_SUCCESS) refuse_damaged(source_.path, "found no valid " + what + " in its header");
  }
  static bool is_deep(exr_storage_t storage) {
    return storage == EXR_STORAGE_DEEP_SCANLINE || storage == EXR_STORAGE_DEEP_TILED;
  }

  std::string name_of(int part) const {
    const char* name = nullptr;
    const bool is_named = exr_get_name(context_, part, &name) == EXR_ERR_SUCCESS && name != nullptr;
    return is_named ? printable(name) : "";
  }

  int chosen_part() const {
    if (source_.part.empty()) return 0;
    std::string names;
    for (int i = 0; i < parts_; ++i) {
      const std::string name = name_of(i);
      if (name == source_.part || std::to_string(i + 1) == source_.part) return i;
      names += (i == 0 ? "" : ", ") + (name.empty() ? std::to_string(i + 1) : "'" + name + "'");
    }
    fail("found no part '" + printable(source_.part) + "', expected one of " + names);
  }

  void read_channels() {
    const exr_attr_chlist_t* list = nullptr;
    expect(exr_get_channels(context_, layout_.part, &list), "list of channels");
    constexpr int most = 1024;
    if (list->num_channels < 1 || list->num_channels > most)
      fail("found " + std::to_string(list->num_channels) + " channels, expected 1 to " +
           std::to_string(most));
    std::vector<std::string> names;
    bool are_half = true, have_whole = false;
    for (int c = 0; c < list->num_channels; ++c) {
      const exr_attr_chlist_entry_t& entry = list->entries[c];
      names.push_back(printable({entry.name.str, static_cast<std::size_t>(entry.name.length)}));
      if (entry.x_sampling != 1 || entry.y_sampling != 1)
        fail("channel " + names.back() + " has fewer pixels than the picture (subsampling), which isn't " +
             "supported; write all channels at full resolution");
      layout_.channels.push_back({entry.pixel_type, 0});
      are_half = are_half && entry.pixel_type == EXR_PIXEL_HALF;
      have_whole = have_whole || entry.pixel_type == EXR_PIXEL_UINT;
    }
    layout_.shape.channels = list->num_channels;
    layout_.shape.sample = are_half ? Sample::half : Sample::float32;
    layout_.shape.component = have_whole ? Component::float64 : Component::float32;
    const std::vector<std::size_t> order = channel_order(names);
    for (std::size_t i = 0; i < order.size(); ++i) {
      layout_.channels[order[i]].place = i;
      layout_.shape.contents.channels.push_back(names[order[i]]);
      if (have_whole)
        layout_.shape.contents.are_whole.push_back(layout_.channels[order[i]].type == EXR_PIXEL_UINT);
    }
  }

  static Bounds bounds(const exr_attr_box2i_t& box) { return {box.min.x, box.min.y, box.max.x, box.max.y}; }

  Window window_of(const Bounds& b) const {
    const std::int64_t width = b.right - b.left + 1, height = b.bottom - b.top + 1;
    source_.limits.check(source_.path, width, height, 0);
    return {static_cast<int>(b.left), static_cast<int>(b.top), static_cast<int>(width),
            static_cast<int>(height)};
  }

  void read_windows() {
    exr_attr_box2i_t data{}, display{};
    expect(exr_get_data_window(context_, layout_.part, &data), "data window");
    expect(exr_get_display_window(context_, layout_.part, &display), "display window");
    const Bounds d = bounds(data), s = bounds(display);
    layout_.data = window_of(d);
    layout_.shape.contents.display = window_of(s);
    const Window all = window_of({std::min(d.left, s.left), std::min(d.top, s.top),
                                  std::max(d.right, s.right), std::max(d.bottom, s.bottom)});
    layout_.shape.contents.window = all;
    layout_.shape.width = all.width;
    layout_.shape.height = all.height;
    const auto area = [](const Window& w) { return std::int64_t{w.width} * w.height; };
    outside_ = area(all) - area(layout_.data);
  }

  void note_what_is_left() {
    FileContents& contents = layout_.shape.contents;
    for (int i = 0; i < parts_ && parts_ > 1; ++i) {
      const std::string name = name_of(i), place = std::to_string(i + 1) + " of " + std::to_string(parts_);
      const std::string text = name.empty() ? "part " + place : "part '" + name + "' (" + place + ")";
      if (i == layout_.part)
        contents.part = name.empty() ? std::to_string(i + 1) : name;
      else
        contents.not_read.push_back(text);
    }
    std::int32_t wide = 1, high = 1;
    if (layout_.storage == EXR_STORAGE_TILED &&
        exr_get_tile_levels(context_, layout_.part, &wide, &high) == EXR_ERR_SUCCESS &&
        std::max(wide, high) > 1)
      contents.not_read.emplace_back("the smaller levels of a mipmap");
    if (outside_ > 0)
      contents.not_read.push_back(std::to_string(outside_) +
                                  " pixels outside its data window, which it does not hold: taken as 0");
  }

  const Source& source_;
  exr_const_context_t context_;
  int parts_ = 0;
  std::int64_t outside_ = 0;  ///< number of pixels that are in the display window alone
  ExrLayout layout_;
};

}  // namespace

ExrLayout exr_layout(const Source& source, exr_const_context_t context) {
  return ExrLayoutReader(source, context).layout();
}

}  // namespace plumb::codecs
