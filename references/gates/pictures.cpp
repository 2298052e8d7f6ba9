#include "references/gates/pictures.hpp"

namespace plumb::gates {

std::shared_ptr<const Pictures> pictures_of(const attribution::AttributionJob& job) {
  Pictures pictures{std::make_shared<const Image>(job.reference), std::make_shared<const Image>(job.test),
                    Pictures::Traced{job.shot.scene, job.shot.camera, job.shot.options}};
  return std::make_shared<const Pictures>(std::move(pictures));
}

}  // namespace plumb::gates
