// tamp audit: judges packings of any program by all metrics.
#include "campaigns/cli/audit.h"
#include "campaigns/cli/command.h"
#include "campaigns/cli/foreign_file.h"
#include "engine/base/error.h"
#include "store/formats/format.h"

#include <CLI/Validators.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace tamp::cli {

namespace {

struct Options {
  std::vector<std::string> files;
  std::string law;
  std::string campaign;
  std::string format = "text";
  double contact_gap = Metric().contact_gap;
  bool as_it_is = false;
  StatedSurroundings stated;
};

constexpr const char* kExamples =
    R"(Files may have any format that `tamp export --help` lists as read. Without a law the radii are compared with a
lognormal law fitted to them. A file that is damaged, or makes no packing, is answered with the line (exit code 2).
Examples:
  tamp audit bed.dump --campaign campaigns/lognormal-3d.json
  tamp audit bed.csv --law lognormal,mu_ln=0.3,sigma_ln=0.68,r_min=0.1,r_max=50,unit=um
  tamp audit a.xyz b.vtp --boundary periodic,periodic,wall --box 60,60,120 --format json)";

int run_audit(const Options& options) {
  if (!options.law.empty() && !options.campaign.empty())
    throw InputError("--law and --campaign both state a law; give one");
  std::optional<StatedLaw> law;
  if (!options.law.empty())
    law = law_of_words(options.law);
  if (!options.campaign.empty())
    law = law_of_campaign(options.campaign);
  const Surroundings stated = surroundings_of(options.stated);
  std::vector<Audit> audits;
  for (const std::string& file : options.files) {
    ReadPacking read = read_foreign(file, stated);
    if (law)
      bring_to_unit(read, *law, file, options.as_it_is);
    audits.push_back(audit(file, std::move(read), law, options.contact_gap));
    audits.back().read.packing.positions = {}; // the findings stay; of large files the places would be too many
    audits.back().read.ids = {};
  }
  if (options.format == "json") {
    fmt::print("{}", audit_json(audits));
    return kOk;
  }
  for (const Audit& one : audits)
    fmt::print("{}\n", audit_text(one));
  if (audits.size() > 1)
    fmt::print("{}", comparison_of(audits));
  return kOk;
}

} // namespace

void declare_audit(CommandLine& line) {
  const auto options = std::make_shared<Options>();
  CLI::App& app =
      line.add("audit", "Judge packings that any program made", kExamples, [options] { return run_audit(*options); });
  app.add_option("files", options->files, "Packings")->type_name("FILE...")->required();
  app.add_option("--law", options->law, "Size law: NAME,parameter=value,... as in campaign files")->type_name("LAW");
  app.add_option("--campaign", options->campaign, "Campaign file whose first powder is the law")->type_name("FILE");
  app.add_option("--format", options->format, "text or json")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"text", "json"}))
      ->capture_default_str();
  app.add_option("--contact-gap", options->contact_gap, "Largest gap of a contact, in smaller radii")
      ->type_name("GAP")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag("--as-it-is", options->as_it_is, "Do not ask about sizes that look like another unit");
  add_surroundings_options(app, options->stated);
}

} // namespace tamp::cli
