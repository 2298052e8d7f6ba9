#include "references/attribution/terms.hpp"

#include <algorithm>

namespace plumb::attribution {
namespace {

/// Takes out of a material what does not belong to the term.
void reduce(Term term, Material& m) {
  const bool lit = term != Term::ambient;
  const bool whole = term == Term::mirror || term == Term::refraction;
  if (term != Term::ambient && !whole) m.ka = Rgbd(0);
  if (!lit || term == Term::specular) m.kd = Rgbd(0);
  if (!lit || term == Term::diffuse) m.ks = Rgbd(0);
  if (term != Term::mirror) m.mirror = Rgbd(0);
  if (term != Term::refraction) m.transmit = Rgbd(0);
}

}  // namespace

const char* to_string(Term term) {
  constexpr std::array<const char*, all_terms.size()> names{"ambient", "diffuse", "specular",
                                                            "shadow",  "mirror",  "refraction"};
  return names.at(static_cast<std::size_t>(term));
}

TermScene only(Term term, const Scene& scene, const RenderOptions& options) {
  TermScene reduced{scene, options};
  for (Material& m : reduced.scene.materials) reduce(term, m);
  reduced.options.shadows =
      options.shadows && (term == Term::shadow || term == Term::mirror || term == Term::refraction);
  return reduced;
}

bool has(Term term, const Scene& scene) {
  const auto any = [&](const auto& is) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), is);
  };
  switch (term) {
    case Term::ambient:
      return scene.ambient != Rgbd(0) && any([](const Material& m) { return m.ka != Rgbd(0); });
    case Term::diffuse:
      return !scene.lights.empty() && any([](const Material& m) { return m.kd != Rgbd(0); });
    case Term::specular:
      return !scene.lights.empty() && any([](const Material& m) { return m.ks != Rgbd(0); });
    case Term::shadow:
      return !scene.lights.empty();
    case Term::mirror:
      return any([](const Material& m) { return m.mirrors(); });
    case Term::refraction:
      break;
  }
  return any([](const Material& m) { return m.transmits(); });
}

}  // namespace plumb::attribution
