#include "references/gates/approved_images.hpp"

#include <algorithm>
#include <filesystem>

#include "references/gates/scene_directory.hpp"

namespace plumb::gates {

ApprovedImages::ApprovedImages(const std::string& directory, const std::string& variant)
    : plain_(baselines_of(directory)) {
  if (!variant.empty()) variant_.emplace(baselines_of(directory, variant));
}

std::optional<ApprovedImages::Found> ApprovedImages::find(const std::string& name) const {
  if (variant_) {
    if (const renderers::Baseline* const record = variant_->baselines.find(name))
      return Found{&variant_->baselines, record};
    // An image without its record is an error that the caller reports.
    if (std::filesystem::exists(variant_->baselines.image_path(name))) return std::nullopt;
  }
  const renderers::Baseline* const record = plain_.baselines.find(name);
  return record == nullptr ? std::nullopt : std::optional(Found{&plain_.baselines, record});
}

bool ApprovedImages::has_own(const std::string& name) const {
  return (variant_ ? variant_->baselines : plain_.baselines).find(name) != nullptr;
}

std::vector<std::string> ApprovedImages::names() const {
  std::vector<std::string> names = plain_.baselines.names();
  if (!variant_) return names;
  const std::vector<std::string> more = variant_->baselines.names();
  names.insert(names.end(), more.begin(), more.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::string ApprovedImages::image_path(const std::string& name) const {
  const std::string of_variant = variant_ ? variant_->baselines.image_path(name) : "";
  if (std::filesystem::exists(of_variant)) return of_variant;
  return plain_.baselines.image_path(name);
}

Bounds ApprovedImages::bounds_of(const std::string& name, const Bounds& usual) const {
  const Bounds plain = plain_.bounds.bounds_of(name, usual);
  return variant_ ? variant_->bounds.bounds_of(name, plain) : plain;
}

std::string ApprovedImages::complaint_about_bounds(const std::vector<std::string>& scenes) const {
  const std::string complaint = plain_.bounds.complaint_about_others(scenes);
  return complaint.empty() && variant_ ? variant_->bounds.complaint_about_others(scenes) : complaint;
}

}  // namespace plumb::gates
