#include "references/renderers/reference_source.hpp"

#include <utility>

namespace plumb::references {

ReferenceSource::ReferenceSource(bool stored) {
  if (stored) {
    use_stored("--stored");
    return;
  }
  try {
    povray_ = std::make_unique<Povray>();
  } catch (const PovrayError& absent) {
    use_stored(absent.what());
    return;
  }
  version_ = cache_.version_of(*povray_);
}

void ReferenceSource::use_stored(const std::string& why) {
  stored_ = std::make_unique<StoredReferences>(StoredReferences::default_directory());
  version_ = stored_->all().empty() ? "" : stored_->all().front().version;
  notice_ = "NO POV-RAY IS RUN: stored reference images are used (" + why + ")";
}

ReferencePicture ReferenceSource::picture(const PovrayJob& job) const {
  if (stored_) return stored_picture(job);
  auto found = cache_.find(job, version_);
  const bool cached = found.has_value();
  if (!found) {
    found = povray_->render(job);
    // Else it may go better next time.
    if (found->holds == Holds::float32) cache_.store(job, version_, *found);
  }
  const double cpu_seconds = cached ? 0 : found->cpu_seconds;
  return {std::move(found->image), found->holds, found->warnings, cpu_seconds, cached, false};
}

ReferencePicture ReferenceSource::stored_picture(const PovrayJob& job) const {
  const auto entry = stored_->find(job.text, job.width, job.height);
  if (!entry) {
    throw PovrayError("no stored reference image for this export at " + std::to_string(job.width) + " x " +
                      std::to_string(job.height) + "; run with POV-Ray");
  }
  return {stored_->load(*entry), Holds::float32, "", 0, true, true};
}

}  // namespace plumb::references
