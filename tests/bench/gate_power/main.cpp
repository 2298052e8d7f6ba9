// How many faults a gate detects and how often it raises a false alarm: ours, and those of other projects, on
// the same pictures. scripts/gate-power builds and runs it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/bench/gate_power/experiment.hpp"
#include "tests/bench/gate_power/our_gate.hpp"
#include "tests/bench/gate_power/rules.hpp"
#include "tracer/format/reader.hpp"
#include "tracer/system/files.hpp"
#include "tracer/system/in_parallel.hpp"

namespace plumb::gate_power {
namespace {

constexpr double visible = 1e-4;  // a fault counts when it changes a linear component by more

struct Options {
  std::vector<std::string> scenes;
  std::string json;
  std::uint32_t seed = 1;
  int width = 160;
  int height = 120;
  int threads = 0;
};

Subject load(const std::string& path, const Options& options) {
  const ReadResult read = read_scene(read_file(path));
  if (read.has_errors()) throw std::runtime_error(path + ": the scene has errors; see plumb lint");
  const std::string camera = read.scene.renders.front().camera;
  Subject s{std::filesystem::path(path).stem().string(), read.scene, read.scene.camera(camera), {}, {}};
  s.job.width = options.width;
  s.job.height = options.height;
  s.job.threads = 1;
  s.right = textbook::render(s.scene, s.camera, s.job);
  return s;
}

double largest_change(const Image& right, const Image& given) {
  double largest = 0;
  for (std::size_t i = 0; i < right.rgb.size(); ++i) {
    const double change = std::abs(double{given.rgb[i]} - double{right.rgb[i]});
    largest = std::isfinite(change) ? std::max(largest, change) : 1e30;
  }
  return largest;
}

/// Whether each gate passed a picture; the first is ours, told how the picture was made, then ours without.
struct Verdicts {
  double change = 0;
  OurVerdict ours = OurVerdict::passes;  ///< told how the picture was made
  std::vector<bool> passes;
};

Verdicts judge(const Experiment& experiment, const Subject& subject) {
  const Image given = experiment.render(subject);
  Verdicts verdicts{largest_change(subject.right, given), OurVerdict::passes, {}};
  if (experiment.is_fault && verdicts.change <= visible) return verdicts;
  verdicts.ours = our_verdict(subject, given, experiment.made);
  const bool needs_no_word = experiment.made == Made::in_double;
  const OurVerdict untold = needs_no_word ? verdicts.ours : our_verdict(subject, given, Made::in_double);
  for (const OurVerdict ours : {verdicts.ours, untold}) verdicts.passes.push_back(ours == OurVerdict::passes);
  const Pair pair = pair_of(subject.right, given, experiment.made);
  for (const Rule& rule : rules()) verdicts.passes.push_back(rule.passes(pair));
  return verdicts;
}

struct Tally {
  int faults = 0;
  int benign = 0;
  std::vector<int> detected;
  std::vector<int> false_alarms;
};

std::vector<std::string> gates() {
  std::vector<std::string> names{"plumb", "plumb, told nothing"};
  for (const Rule& rule : rules()) names.emplace_back(rule.name);
  return names;
}

Tally count(const std::vector<Experiment>& experiments, const std::vector<Verdicts>& verdicts) {
  Tally tally{0, 0, std::vector<int>(gates().size()), std::vector<int>(gates().size())};
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (verdicts[i].passes.empty()) continue;
    (experiments[i].is_fault ? tally.faults : tally.benign) += 1;
    for (std::size_t g = 0; g < gates().size(); ++g)
      (experiments[i].is_fault ? tally.detected : tally.false_alarms)[g] += verdicts[i].passes[g] ? 0 : 1;
  }
  return tally;
}

double per_cent(int part, int whole) { return whole == 0 ? 0 : 100.0 * part / whole; }

void print_table(const Tally& tally) {
  std::printf("| gate | faults detected, of %d | false alarms, of %d |\n|---|---|---|\n", tally.faults,
              tally.benign);
  for (std::size_t g = 0; g < gates().size(); ++g) {
    std::printf("| %s | %.1f %% | %.1f %% |\n", gates()[g].c_str(), per_cent(tally.detected[g], tally.faults),
                per_cent(tally.false_alarms[g], tally.benign));
  }
}

/// The experiments on which our gate said something, so that they can be looked into.
template <class Said>
nlohmann::json those_where(const std::vector<Experiment>& experiments, const std::vector<Verdicts>& verdicts,
                           const std::vector<Subject>& subjects, const Said& said) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (verdicts[i].passes.empty() || !said(experiments[i], verdicts[i])) continue;
    list.push_back({{"scene", subjects[experiments[i].subject].name},
                    {"kind", experiments[i].kind},
                    {"fault", experiments[i].is_fault},
                    {"largest_change", verdicts[i].change}});
  }
  return list;
}

nlohmann::json kinds(const std::vector<Experiment>& experiments, const std::vector<Verdicts>& verdicts) {
  std::map<std::string, Tally> by_kind;
  for (const Experiment& e : experiments) {
    if (by_kind.contains(e.kind)) continue;
    std::vector<Experiment> of_kind;
    std::vector<Verdicts> theirs;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      if (experiments[i].kind != e.kind) continue;
      of_kind.push_back(experiments[i]);
      theirs.push_back(verdicts[i]);
    }
    by_kind[e.kind] = count(of_kind, theirs);
  }
  nlohmann::json all = nlohmann::json::object();
  for (const auto& [kind, tally] : by_kind) {
    all[kind] = {{"faults", tally.faults},
                 {"benign", tally.benign},
                 {"detected", tally.detected},
                 {"false_alarms", tally.false_alarms}};
  }
  return all;
}

int run(const Options& options) {
  std::vector<Subject> subjects;
  for (const std::string& path : options.scenes) subjects.push_back(load(path, options));
  std::mt19937 random(options.seed);
  std::vector<Experiment> experiments = fault_experiments(subjects, random);
  for (Experiment& e : benign_experiments(subjects, random)) experiments.push_back(std::move(e));
  std::vector<Verdicts> verdicts(experiments.size());
  in_parallel(experiments.size(), options.threads > 0 ? options.threads : processors(),
              [&](std::size_t i) { verdicts[i] = judge(experiments[i], subjects[experiments[i].subject]); });
  const Tally tally = count(experiments, verdicts);
  print_table(tally);
  const nlohmann::json errors =
      those_where(experiments, verdicts, subjects,
                  [](const Experiment& e, const Verdicts& v) { return v.passes.front() == e.is_fault; });
  const nlohmann::json by_bounds =
      those_where(experiments, verdicts, subjects, [](const Experiment& e, const Verdicts& v) {
        return e.is_fault && v.ours == OurVerdict::out_of_bounds;
      });
  std::printf("\nFaults that the budget shows as unexplained pixels: %d of %d; by a bound alone: %zu.\n",
              tally.detected.front() - static_cast<int>(by_bounds.size()), tally.faults, by_bounds.size());
  if (options.json.empty()) return 0;
  const nlohmann::json report{{"seed", options.seed},
                              {"size", {options.width, options.height}},
                              {"gates", gates()},
                              {"faults", tally.faults},
                              {"benign", tally.benign},
                              {"detected", tally.detected},
                              {"false_alarms", tally.false_alarms},
                              {"kinds", kinds(experiments, verdicts)},
                              {"our_errors", errors},
                              {"detected_by_bounds_alone", by_bounds}};
  write_file(options.json, report.dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace plumb::gate_power

int main(int argc, char** argv) {
  CLI::App app(
      "Detection and false-alarm rates of our gate and of others, on seeded faults and benign changes.");
  plumb::gate_power::Options options;
  app.add_option("SCENE", options.scenes, "scene files")->required();
  app.add_option("--json", options.json, "also write the figures, by kind, and our gate's errors");
  app.add_option("--seed", options.seed, "of parameters and moves");
  app.add_option("--width", options.width, "of the pictures")->check(CLI::Range(8, 4096));
  app.add_option("--height", options.height, "of the pictures")->check(CLI::Range(8, 4096));
  app.add_option("--threads", options.threads, "default: all");
  CLI11_PARSE(app, argc, argv);
  try {
    return plumb::gate_power::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "gate-power: %s\n", error.what());
    return 2;
  }
}
