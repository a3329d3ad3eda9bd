// tamp export: writes a packing of the store, or of a file in any format, in another format; or a campaign as RO-Crate.
#include "campaigns/cli/command.h"
#include "campaigns/cli/foreign_file.h"
#include "campaigns/cli/open_store.h"
#include "engine/base/error.h"
#include "engine/model/metric.h"
#include "engine/search/packing_search.h"
#include "store/formats/format.h"
#include "store/ro_crate.h"
#include "tamp_build_info.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace tamp::cli {

namespace {

struct Options {
  std::string store = kDefaultStore;
  std::string source;
  std::string format;
  std::string out;
  StatedSurroundings stated;
  ExportOptions writer;
  bool ro_crate = false;
  std::string license;
  std::string author;
};

std::string examples() {
  std::string text = "A packing is named by the key of its job, or its first digits, or it is a file to be converted.\n"
                     "Formats (r: read, w: written):\n";
  for (const Format& format : formats())
    text += fmt::format("  {:<12} {}{}  {}\n", format.name, format.read != nullptr ? 'r' : '-',
                        format.write != nullptr ? 'w' : '-', format.summary);
  return text + R"(Examples:
  tamp export 3fa91c --format xyz --out bed.xyz
  tamp export dump.bed --unit mm --format h5 --out bed.h5
With --ro-crate, FILE is a campaign: its packings, the records of all runs, also of those that failed, and the campaign
file go into the folder PATH as a Workflow Run RO-Crate (Process Run Crate 0.5), for data repositories:
  tamp export campaigns/quickstart.json --ro-crate --license CC-BY-4.0 --out crate)";
}

/// The packing whose key begins so. Throws InputError unless there is one.
Packing stored_packing(const Options& options) {
  const Store store = open_for_reading(options.store);
  return store.read_packing(whole_key(store, options.source, JobKind::generation));
}

/// How many spheres each sphere touches.
std::vector<double> contacts_of(const Packing& packing) {
  std::vector<double> contacts(packing.count(), 0);
  with_dimension(packing.dimension, [&](auto d) {
    search_of<d>(packing).for_each_pair(Metric().contact_gap, [&](const auto& pair) {
      ++contacts[pair.i];
      ++contacts[pair.j];
    });
  });
  return contacts;
}

/// "NAME" or "NAME <address>".
CrateStatements statements_of(const Options& options) {
  CrateStatements statements{options.license, options.author, {}};
  if (const std::size_t at = options.author.find(" <"); at != std::string::npos && options.author.ends_with('>')) {
    statements.author = options.author.substr(0, at);
    statements.author_id = options.author.substr(at + 2, options.author.size() - at - 3);
  }
  return statements;
}

int write_crate(const Options& options) {
  const std::vector<Plan> plans = load_campaigns({options.source});
  const Store store = open_for_reading(options.store);
  const CrateContents contents = write_ro_crate(store, plans.front(), statements_of(options), options.out);
  fmt::print("{}: {} packings, {} runs, {} of them not ok\n", options.out, contents.packings, contents.attempts,
             contents.failed);
  if (options.license.empty())
    fmt::print("no licence is stated; most repositories want one: --license CC-BY-4.0\n");
  return kOk;
}

int write_export(Options& options) {
  if (options.ro_crate)
    return write_crate(options);
  const Format& format = options.format.empty() ? format_of_ending(options.out) : format_named(options.format);
  if (format.write == nullptr)
    throw InputError(fmt::format("the format {} is read only, not written", format.name));
  const Packing packing = std::filesystem::exists(options.source)
                              ? read_foreign(options.source, surroundings_of(options.stated)).packing
                              : stored_packing(options);
  options.writer.creator_version = build_info::version;
  if (format.name == "vtp")
    options.writer.fields.push_back({"coordination", contacts_of(packing)});
  format.write(options.out, packing, options.writer);
  fmt::print("{}\n", options.out);
  return kOk;
}

} // namespace

void declare_export(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app = line.add("export", "Write a packing in another format, or a campaign as RO-Crate", examples(),
                           [options] { return write_export(*options); });
  app.add_option("packing", options->source, "Key of a job, or a file; with --ro-crate, a campaign")
      ->type_name("KEY|FILE")
      ->required();
  app.add_option("--format", options->format, "See below; without, by the ending of --out")->type_name("FORMAT");
  app.add_option("--out", options->out, "File to be written; with --ro-crate, a folder")->type_name("PATH")->required();
  app.add_option("--voxels", options->writer.voxels, "meta-image: along the longest edge")
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--subdivisions", options->writer.subdivisions, "stl: 20·4^N triangles a sphere")
      ->type_name("N")
      ->capture_default_str();
  CLI::Option* crate = app.add_flag("--ro-crate", options->ro_crate, "A whole campaign as RO-Crate");
  app.add_option("--license", options->license, "RO-Crate: licence of the data")->type_name("SPDX|URL")->needs(crate);
  app.add_option("--author", options->author, "RO-Crate: who made the data")->type_name("\"NAME <URL>\"")->needs(crate);
  add_store_option(app, options->store);
  add_surroundings_options(app, options->stated);
}

} // namespace tamp::cli
