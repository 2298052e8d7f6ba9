// What is said of results, for people: results hold facts, and the words are made here alone.
#pragma once

#include <string>

#include "references/comparison/mismatch.hpp"
#include "references/gates/bounds.hpp"
#include "references/gates/regress.hpp"
#include "references/gates/verify.hpp"

namespace plumb::report {

/// What pixels over are, what is wrong, and what agreement means little without; empty when there is nothing
/// to say. Of a scene in trouble, what went wrong.
std::string message_of(const gates::SceneResult& result);

/// In lines: what differs from the baseline, who approved that, and the bounds with their reason.
std::string message_of(const gates::RegressedScene& scene);
/// The same without the bounds.
std::string message_without_bounds(const gates::RegressedScene& scene);

/// Why there are no figures; empty when there are.
std::string not_compared_text(const gates::SceneResult& result);

std::string in_words(const attribution::BrokenBound& broken);

/// What a reader of the counts must know when pixels were not examined; else empty.
std::string note_of(const attribution::Budget& budget);

/// What a reader must know: that our side is wrong somewhere, or that pixels were not judged; else empty.
std::string note_of(const truth::Judgement& judgement);

/// E.g. "ours wrong 0, reference wrong 12, both wrong 0, undecided 3".
std::string judgement_text(const truth::Judgement& judgement);

/// Who is wrong, and the colour of the scene as it is written; a line.
std::string judged_text(const truth::JudgedPixel& pixel);

/// E.g. "rows are flipped (then 0 pixels over)".
std::string cause_text(const comparison::LikelyCause& cause);

/// What was allowed, what was ignored and why; empty when nothing but the tolerance decides.
std::string bounds_text(const gates::Bounds& bounds, const gates::BoundedComparison& result);

}  // namespace plumb::report
