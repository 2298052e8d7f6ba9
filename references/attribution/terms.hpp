// The shading term by term: on both sides the same scene, with all but one term taken out.
#pragma once

#include <array>
#include <string>

#include "tracer/scene/render_options.hpp"
#include "tracer/scene/scene.hpp"

namespace plumb::attribution {

/// Each stands on those before it, so a difference lives in the first one that differs.
enum class Term {
  ambient,     ///< Ia ka alone
  diffuse,     ///< Ip kd (n.l) alone, without shadows
  specular,    ///< Ip ks (r.v)^m alone, without shadows
  shadow,      ///< diffuse and specular with shadows
  mirror,      ///< everything but transmission
  refraction,  ///< everything but mirrors
};
inline constexpr std::array<Term, 6> all_terms{Term::ambient, Term::diffuse, Term::specular,
                                               Term::shadow,  Term::mirror,  Term::refraction};

/// Returns the name in JSON.
const char* to_string(Term term);

struct TermScene {
  Scene scene;
  RenderOptions options;
};

/// Returns what both sides have to render to show only this term.
TermScene only(Term term, const Scene& scene, const RenderOptions& options);

/// True if the scene has the term at all: a light, a mirror, glass.
bool has(Term term, const Scene& scene);

}  // namespace plumb::attribution
