// The command `tamp`.
#include "campaigns/cli/command.h"

int main(int argc, char** argv) {
  return tamp::cli::guarded([&] {
    tamp::cli::CommandLine line("Benchmark of powder packing generators: generate, measure, remember, report.");
    for (const tamp::cli::Command& command : tamp::cli::commands())
      command.declare(line);
    const tamp::cli::Action chosen = line.parse(argc, argv);
    return chosen();
  });
}
