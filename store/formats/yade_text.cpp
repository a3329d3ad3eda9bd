// Packings as the plain text of Yade's ymport.text and export.text.
#include "store/formats/makers.h"
#include "store/formats/statements.h"

namespace tamp {

void write_yade(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  FileWriter out(path);
  out.print("#format x_y_z_r\n");
  write_statements(out, packing);
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const auto c = packing.centre_in_space(i);
    out.print("{}\t{}\t{}\t{}\n", c[0], c[1], c[2], packing.radii[i]);
  }
  out.finish();
}

ReadPacking read_yade(const std::filesystem::path& path, const Surroundings& stated) {
  constexpr std::size_t kColumns = 4; // a fifth is the number of the material
  LineReader in(path);
  PackingBuilder spheres(path, in.file_size());
  Statements found;
  while (in.next()) {
    if (trimmed(in.line()).empty())
      continue;
    if (in.line().starts_with('#')) {
      const bool format = in.line().starts_with("#format ");
      if (format && in.fields().size() > 1 && !in.fields()[1].starts_with("x_y_z_r"))
        in.fail(fmt::format("columns {}; only x_y_z_r can be read", in.fields()[1]));
      read_statement(in, found);
      continue;
    }
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() != kColumns && f.size() != kColumns + 1)
      in.fail(fmt::format("{} columns; a sphere has x y z r", f.size()));
    spheres.add(in.number(), {in.to_number(f[0], "x"), in.to_number(f[1], "y"), in.to_number(f[2], "z")},
                in.to_number(f[3], "the radius"));
  }
  check_count(in, found, spheres.count());
  ReadPacking read = spheres.finish(found.said, stated);
  read.columns = {"x", "y", "z", "r"};
  return read;
}

} // namespace tamp
