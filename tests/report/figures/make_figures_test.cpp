// Every kind of figure, drawn by the real gnuplot: the same bytes twice, and what is said where there is none.
#include "engine/base/process.h"
#include "tests/report/figures/synthetic_figures.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

using namespace tamp;
using namespace tamp::test;

namespace {

bool has_gnuplot() {
  static const bool found = [] {
    try {
      return run_process({.argv = {"gnuplot", "--version"}}).succeeded();
    } catch (const std::exception&) {
      return false;
    }
  }();
  return found;
}

const std::string* find_file(const ReportFigures& figures, const std::string& name) {
  const auto found = std::find_if(figures.files.begin(), figures.files.end(),
                                  [&](const FigureFile& file) { return file.name == name; });
  return found == figures.files.end() ? nullptr : &found->bytes;
}

} // namespace

TEST_CASE("Each kind of figure is drawn without a complaint, in three formats, and all names differ") {
  if (!has_gnuplot())
    return; // the figures' scripts are tested all the same below
  const ReportFigures figures = figures_of(everything());
  std::set<std::string> names;
  for (const DrawnFigure& figure : figures.drawn) {
    CHECK(names.insert(figure.name).second);
    CHECK(figure.svg.find("<svg") != std::string::npos);
    CHECK(figure.svg.ends_with("</svg>\n\n"));
    CHECK(find_file(figures, figure.name + ".pdf")->starts_with("%PDF"));
    CHECK(find_file(figures, figure.name + ".png")->substr(1, 3) == "PNG");
  }
  for (const char* name : {"accuracy_against_time", "phi_over_size_ratio", "furnas_plane_d_r", "convergence_with_size",
                           "time_over_count", "phi_over_contact", "accuracy_front", "accuracy_knobs"})
    CHECK(names.count(name) == 1);
  CHECK(std::count_if(names.begin(), names.end(), [](const auto& name) { return name.starts_with("packing_"); }) == 12);
  CHECK(std::count_if(names.begin(), names.end(), [](const auto& name) { return name.starts_with("radii_"); }) == 12);
  for (const std::string& sentence : figures.missing)
    UNSCOPED_INFO(sentence);
  // Only the packings beyond the limit are missing, no figure that gnuplot could not draw.
  REQUIRE(figures.missing.size() == 1);
  CHECK(figures.missing.front().find("left out") != std::string::npos);
}

TEST_CASE("The same records and packings give the same bytes, in every format and at any time") {
  if (!has_gnuplot())
    return;
  SyntheticCampaign campaign;
  add_measured(campaign, bimodal_job(2, 0.75), "A", {{"N", 8}, {"phi", 0.6}}, 1);
  Job other = bimodal_job(2, 0.75);
  other.method.name = MethodName::dem_isostatic;
  add_measured(campaign, other, "B", {{"N", 8}, {"phi", 0.7}}, 2);
  const ReportFigures first = figures_of(campaign);
  run_process({.argv = {"sleep", "1.1"}}); // a PDF knows the second of its making
  const ReportFigures second = figures_of(campaign);
  REQUIRE(first.files.size() == second.files.size());
  CHECK(first.drawn.size() == 5);
  for (std::size_t i = 0; i < first.files.size(); ++i) {
    INFO(first.files[i].name);
    CHECK(first.files[i].name == second.files[i].name);
    CHECK(first.files[i].bytes == second.files[i].bytes);
  }
}

TEST_CASE("Without gnuplot the scripts and data are there, and the page says how to draw them") {
  const ReportFigures figures = figures_of(everything(), "no-such-gnuplot");
  CHECK(figures.drawn.empty());
  CHECK(find_file(figures, "tamp_style.gp") != nullptr);
  CHECK(find_file(figures, "furnas_plane_d_r.gp") != nullptr);
  CHECK(find_file(figures, "furnas_plane_d_r.dat") != nullptr);
  CHECK(find_file(figures, "furnas_plane_d_r.svg") == nullptr);
  REQUIRE(!figures.missing.empty());
  CHECK(figures.missing.back().find("gnuplot accuracy_against_time.gp") != std::string::npos);
  CHECK(figures.missing.back().find("gnuplot-nox") != std::string::npos);
}

TEST_CASE("A representative size is marked where the table has one: of H by its excess over the floor") {
  SyntheticCampaign campaign;
  for (const double edge : {110.0, 150.0, 210.0}) {
    Scene scene = paper_scene(3);
    scene.size = {edge, edge, edge};
    for (const int replicate : {0, 1}) {
      const std::string key = campaign.add_ok(scene, replicate, 0.64 + 0.001 * replicate, 1);
      campaign.add_metric(key, 0, {{"H_N", 10 / edge}, {"H_N_floor", 10 / edge}}); // 0.09 to 0.05
    }
  }
  const ReportFigures figures = figures_of(campaign, "no-such-gnuplot");
  const std::string* script = find_file(figures, "convergence_with_size.gp");
  REQUIRE(script != nullptr);
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (std::size_t at = script->find(words); at != std::string::npos; at = script->find(words, at + 1))
      ++found;
    return found;
  };
  CHECK(count("set arrow from first 110,") == 2);     // phi and H_N
  CHECK(count("set arrow from graph 0, first") == 1); // the plateau of phi
}

TEST_CASE("A campaign that has not run has no figures and names the command") {
  SyntheticCampaign campaign;
  campaign.plan_job(bimodal_job(2, 0.75).scene, 0);
  const ReportFigures figures = figures_of(campaign);
  CHECK(figures.drawn.empty());
  CHECK(figures.files.empty());
  REQUIRE(figures.missing.size() == 3);
  CHECK(figures.missing[0].find("tamp run synthetic.json") != std::string::npos);
  CHECK(figures.missing[1].find("tamp run synthetic.json") != std::string::npos);
  CHECK(figures.missing[2].find("campaigns/furnas.json") != std::string::npos);
  CHECK(figures.missing[2].find("some may come with what has not run: tamp run synthetic.json") != std::string::npos);
}

TEST_CASE("A packing that cannot be read costs its own figures alone") {
  SyntheticCampaign campaign;
  add_measured(campaign, bimodal_job(2, 0.75), "A", {{"N", 8}, {"phi", 0.6}}, 1);
  const FigureSettings settings{true, [](const std::string&) -> Packing { throw Error("packing.h5: damaged"); },
                                "no-such-gnuplot"};
  const ReportFigures figures = make_figures(campaign.runs(), "tamp run x.json", settings);
  CHECK(figures.files.empty());
  CHECK(figures.missing.front() ==
        "No figure of the packing of A: packing.h5: damaged. To make what is lost again: tamp run x.json");
}

TEST_CASE("What a report lacks stands in report.md and is warned of, with the command that helps") {
  SyntheticCampaign campaign;
  campaign.plan.report.tables = {"bimodal_3d"};
  add_measured(campaign, bimodal_job(2, 0.75), "A", {{"N", 8}, {"phi", 0.6}}, 1);
  add_measured(campaign, bimodal_job(5, 0.75), "A", {{"N", 8}, {"phi", 0.7}}, 1);
  const std::vector<Run> runs = campaign.runs();
  const auto read = [](const std::string&) -> Packing { throw Error("packing.h5: damaged"); };
  ReportInput input{campaign.plan, runs, "tamp run x.json"};
  input.packing = read;
  input.figures = {true, read, "no-such-gnuplot"};
  std::vector<std::string> warnings;
  input.warn = [&](std::string_view sentence) { warnings.emplace_back(sentence); };
  std::string page;
  for (const ReportFile& file : make_report(input)) {
    if (file.name == "report.md")
      page = file.bytes;
  }
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0].find("gnuplot-nox") != std::string::npos);
  CHECK(warnings[1].find("2 packings that the records promise could not be read (packing.h5: damaged)") !=
        std::string::npos);
  CHECK(warnings[1].find("tamp run x.json") != std::string::npos);
  CHECK(page.find("gnuplot-nox") != std::string::npos);
  CHECK(page.find("2 packings that the records promise") != std::string::npos);
}

TEST_CASE("A report shows its figures in the page, in LaTeX and in Markdown") {
  if (!has_gnuplot())
    return;
  SyntheticCampaign campaign = everything();
  campaign.plan.report.tables = {"domain_size"};
  const std::vector<Run> runs = campaign.runs();
  ReportInput input{campaign.plan, runs, "tamp run x.json"};
  input.figures.wanted = true; // without packings
  std::map<std::string, std::string> files;
  for (const ReportFile& file : make_report(input))
    CHECK(files.emplace(file.name, file.bytes).second);
  CHECK(files.at("index.html").find("<figure id=\"figure-time_over_count\"><svg") != std::string::npos);
  CHECK(files.at("tables.tex").find("{time_over_count.pdf}") != std::string::npos);
  CHECK(files.at("report.md").find("](time_over_count.svg)") != std::string::npos);
  CHECK(files.count("time_over_count.png") == 1);
}
