// Compares one image with its baseline, within bounds.
#pragma once

#include "references/gates/bounds.hpp"
#include "references/gates/verify.hpp"

namespace plumb::gates {

/// An image and its baseline, of one size.
struct BaselineJob {
  const Image& baseline;
  const Image& image;
  const Bounds& bounds;
  bool keeps_pictures;
};

/// Sets figures and status. What plumb rendered is traced again: a pixel over the limit that is proven an
/// edge, or the like, differs by chance; the resolution is the baseline's. It agrees, too, when no more
/// pixels are over than may be.
BoundedComparison judge_own(const Shot& shot, const renderers::Resolution& resolution, const BaselineJob& job,
                            SceneResult& result);

/// The same for somebody else's image. Nothing is known of how its pixels are made, so none is explained.
BoundedComparison judge_others(const BaselineJob& job, SceneResult& result);

}  // namespace plumb::gates
