// Renders a scene, has the reference renderer render its export, and compares every pixel.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "references/attribution/attribution.hpp"
#include "references/attribution/terms.hpp"
#include "references/comparison/comparison.hpp"
#include "references/comparison/metrics/metrics.hpp"
#include "references/comparison/pixel_mask.hpp"
#include "references/gates/picture_options.hpp"
#include "references/gates/pictures.hpp"
#include "references/renderers/registry.hpp"
#include "references/truth/judgement.hpp"
#include "tracer/textbook/render.hpp"

namespace plumb::gates {

enum class Status { agree, differ, error };

const char* to_string(Status status);

struct VerifyOptions : PictureOptions {
  renderers::ReferenceOptions reference;
  int jobs = 0;        ///< scenes at once; 0: as many as keep the machine busy
  bool terms = false;  ///< also compare each term of the shading alone
  bool judge = false;  ///< also say, of each pixel over, who is wrong: ours nowhere, or it differs
  std::function<void(const std::string&)> on_notice;  ///< called first, when there is one; may be empty
  const renderers::Renderer* ours =
      nullptr;  ///< renders our side in place of `tracer`, to be judged; may be null
};

/// One term of the shading alone, on both sides.
struct TermResult {
  attribution::Term term;
  bool in_scene = true;  ///< both sides are black where the scene has none of it
  std::optional<comparison::Comparison>
      comparison;               ///< of a term in the scene; nothing when it could not be made
  std::size_t unexplained = 0;  ///< pixels
  std::string trouble{};        ///< why it could not be made; else empty
};

/// Why there are no figures.
enum class NoFigures { trouble, nothing_approved, other_size };

/// A float picture that differs.
struct FloatSuspect {
  /// The largest error against our own picture in double: whether float is all that is wrong shows in it.
  /// Nothing when there is no such picture.
  std::optional<double> error;
};

struct SceneResult {
  std::string scene;
  Status status = Status::error;
  std::string trouble;  ///< what went wrong, where the status is error
  int width = 0;
  int height = 0;
  std::optional<NoFigures> no_figures = NoFigures::trouble;  ///< nothing when there are figures
  comparison::Comparison comparison;
  comparison::PixelMask mask;   ///< of the pixels that count; some do not where bounds leave regions out
  comparison::Metrics metrics;  ///< the cheap ones
  attribution::Budget budget;
  bool has_causes = false;  ///< they were sought; else all pixels over are unexplained
  std::optional<attribution::BrokenBound> broken_bound;  ///< of the budget
  std::vector<TermResult> terms;                         ///< all, when they were asked for
  std::optional<truth::Judgement> judgement;             ///< when it was asked for
  std::string reference_title;                           ///< of the reference renderer, for people
  std::string reference_warnings;                        ///< of the reference renderer
  bool is_of_one_colour = false;                         ///< our picture: agreement means little then
  std::size_t scene_warnings = 0;                        ///< of reading the scene
  std::optional<FloatSuspect> suspect;                   ///< where float may be all that is wrong
  double seconds_ours = 0;                               ///< of CPU time
  double seconds_reference = 0;                          ///< of CPU time, when it was rendered
  bool cached = false;                                   ///< or stored: the reference was not rendered now
  bool stored = false;
  std::shared_ptr<const Pictures> pictures;  ///< when they are kept and both sides were rendered
};

/// Compares the pictures, attributes every pixel over, and sets the figures and the status; where there is a
/// judgement already, what it refutes is unexplained. Width and height are set already.
void judge(const attribution::AttributionJob& job, SceneResult& result);

struct VerifyReport {
  renderers::RendererFacts reference;  ///< what was compared with
  std::string reference_version;
  std::string notice;               ///< to be said loudly: stored images are used because ...
  std::string complaint;            ///< to be said: the cache cannot be written; figures and verdicts stand
  std::vector<SceneResult> scenes;  ///< in the order asked for

  /// 0 all agree, 1 some differ, 2 trouble.
  int exit_code() const;
};

/// Verifies all scenes. One bad scene never stops the others. `done` is called in the order of the scenes, by
/// one thread at a time.
VerifyReport verify(const std::vector<std::string>& scenes, const VerifyOptions& options,
                    const std::function<void(SceneResult&)>& done);

}  // namespace plumb::gates
