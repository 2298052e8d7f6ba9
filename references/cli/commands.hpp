// The commands of plumb, in the order of its help.
#pragma once

#include "references/cli/command_line.hpp"

namespace plumb::cli {

Command render_command();
Command export_command();
Command verify_command();
Command compare_command();
Command explain_command();
Command lint_command();
Command references_command();
Command regress_command();
Command needs_command();
Command stability_command();
Command chart_command();
Command faults_command();
Command diagnose_command();
Command judge_command();
Command manual_command();

inline std::vector<Command> all_commands() {
  return {render_command(), export_command(),     verify_command(),   compare_command(), explain_command(),
          lint_command(),   references_command(), regress_command(),  needs_command(),   stability_command(),
          chart_command(),  faults_command(),     diagnose_command(), judge_command(),   manual_command()};
}

}  // namespace plumb::cli
