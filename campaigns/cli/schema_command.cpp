// tamp schema: prints the JSON Schema of campaign files.
#include "campaigns/cli/command.h"
#include "campaigns/schema.h"

#include <fmt/format.h>

#include <cstdio>

namespace tamp::cli {

namespace {

constexpr const char* kExamples =
    R"(Editors complete and check campaign files that name the schema: {"$schema": "schema.json", ...}.
Example:
  tamp schema > campaigns/schema.json)";

} // namespace

void declare_schema(CommandLine& line) {
  line.add("schema", "Print the JSON Schema of campaign files", kExamples, [] {
    fmt::print("{}", schema_json());
    return kOk;
  });
}

} // namespace tamp::cli
