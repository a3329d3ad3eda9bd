// tamp reference: prints the page of all parameters.
#include "campaigns/cli/command.h"
#include "campaigns/reference.h"

#include <fmt/format.h>

#include <cstdio>

namespace tamp::cli {

namespace {

constexpr const char* kExamples = R"(Example:
  tamp reference > campaigns/reference.md)";

} // namespace

void declare_reference(CommandLine& line) {
  line.add("reference", "Print the page of all campaign parameters", kExamples, [] {
    fmt::print("{}", reference_page());
    return kOk;
  });
}

} // namespace tamp::cli
