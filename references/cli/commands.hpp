// The commands of plumb: each adds itself to the command line and returns what to run when it is chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace plumb::cli {

/// Runs the command with the options parsed; returns the exit code: 0 agrees, 1 differs, 2 trouble.
using Run = std::function<int()>;

struct Command {
  CLI::App* app;
  Run run;
};

Command add_render(CLI::App& plumb);
Command add_export(CLI::App& plumb);
Command add_verify(CLI::App& plumb);
Command add_compare(CLI::App& plumb);
Command add_explain(CLI::App& plumb);
Command add_lint(CLI::App& plumb);
Command add_needs(CLI::App& plumb);
Command add_references(CLI::App& plumb);
Command add_regress(CLI::App& plumb);
Command add_faults(CLI::App& plumb);
Command add_diagnose(CLI::App& plumb);
Command add_stability(CLI::App& plumb);
Command add_chart(CLI::App& plumb);
Command add_judge(CLI::App& plumb);

inline constexpr int exit_agrees = 0;
inline constexpr int exit_differs = 1;
inline constexpr int exit_trouble = 2;

}  // namespace plumb::cli
