// Runs gnuplot, several processes at a time.
#include "report/figures/gnuplot.h"

#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/process.h"
#include "report/figures/style.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tamp {

namespace {

namespace fs = std::filesystem;

/// Drawing a figure takes a tenth of a second to a second.
constexpr double kWallLimit_s = 300;
/// gnuplot draws on one core.
constexpr std::size_t kProcesses = 2;

class TemporaryFolder {
public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "tamp-figures-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw Error(fmt::format("{}: cannot make a temporary folder", pattern));
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

/// A plain write: what stands here need not outlive a loss of power.
void write_plainly(const fs::path& path, const std::string& bytes) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
  if (!file || std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size() || std::fflush(file.get()) != 0)
    throw Error(fmt::format("{}: cannot be written", path.string()));
}

/// The date at which a PDF was made, as many blanks: it tells nothing that the records do not, and would differ.
void blank_date(std::string& pdf) {
  for (const std::string_view mark : {"/CreationDate (", "/ModDate ("}) {
    const std::size_t start = pdf.find(mark);
    const std::size_t end = start == std::string::npos ? start : pdf.find(')', start);
    if (end != std::string::npos)
      std::fill(pdf.begin() + static_cast<std::ptrdiff_t>(start), pdf.begin() + static_cast<std::ptrdiff_t>(end) + 1,
                ' ');
  }
}

ChildProcess start(const std::string& program, const fs::path& folder, std::span<const Figure* const> figures,
                   const std::string& driver) {
  std::string commands = fmt::format("cd '{}'\n", folder.string());
  for (const Figure* figure : figures)
    commands += fmt::format("load '{}.gp'\n", figure->name);
  write_plainly(folder / driver, commands);
  ProcessRequest request;
  request.argv = {program, "-d", (folder / driver).string()}; // -d: the user's own settings do not count
  request.log = folder / (driver + ".log");
  request.limits.wall_s = kWallLimit_s;
  request.environment = {{"LC_ALL", "C.UTF-8"}, {"SOURCE_DATE_EPOCH", "0"}};
  return ChildProcess::start(request);
}

std::optional<Drawing> read_drawing(const fs::path& folder, const std::string& name) {
  Drawing drawing;
  for (const auto& [ending, bytes] :
       {std::pair{".svg", &drawing.svg}, std::pair{".pdf", &drawing.pdf}, std::pair{".png", &drawing.png}}) {
    const fs::path path = folder / (name + ending);
    if (!fs::exists(path))
      return std::nullopt;
    *bytes = read_file(path);
  }
  if (drawing.png.empty()) // gnuplot opens the file before it draws
    return std::nullopt;
  blank_date(drawing.pdf);
  return drawing;
}

/// Draws the figures, `share` of them in each process. False if gnuplot could not be started.
bool run(std::span<const Figure* const> figures, std::size_t share, const std::string& program, const fs::path& folder,
         Drawings& drawings) {
  std::vector<ChildProcess> children;
  try {
    for (std::size_t first = 0; first < figures.size(); first += share) {
      children.push_back(start(program, folder, figures.subspan(first, std::min(share, figures.size() - first)),
                               fmt::format("driver_{}", first)));
    }
  } catch (const Error& error) {
    drawings.why = error.what();
    return false;
  }
  for (ChildProcess& child : children) {
    const ProcessResult result = child.wait();
    if (!result.succeeded())
      drawings.why += (drawings.why.empty() ? "" : "\n") + result.log_tail;
  }
  for (const Figure* figure : figures) {
    if (auto drawing = read_drawing(folder, figure->name))
      drawings.by_name[figure->name] = std::move(*drawing);
  }
  return true;
}

} // namespace

Drawings draw(std::span<const Figure> figures, const std::string& program) {
  Drawings drawings;
  if (figures.empty())
    return drawings;
  const TemporaryFolder folder;
  write_plainly(folder.path() / kStyleFile, style_script());
  for (const Figure& figure : figures) {
    write_plainly(folder.path() / (figure.name + ".gp"), figure_script(figure));
    for (const FigureFile& file : figure.data)
      write_plainly(folder.path() / file.name, file.bytes);
  }
  std::vector<const Figure*> all;
  for (const Figure& figure : figures)
    all.push_back(&figure);
  if (!run(all, (all.size() + kProcesses - 1) / kProcesses, program, folder.path(), drawings))
    return drawings;
  // A figure that gnuplot stumbles over takes those behind it along: they get a process each.
  std::vector<const Figure*> rest;
  for (const Figure& figure : figures) {
    if (drawings.by_name.count(figure.name) == 0)
      rest.push_back(&figure);
  }
  drawings.why.clear();
  for (const Figure* figure : rest)
    run({&figure, 1}, 1, program, folder.path(), drawings);
  return drawings;
}

} // namespace tamp
