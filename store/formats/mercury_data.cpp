// Packings as MercuryDPM's .data files.
#include "store/formats/makers.h"
#include "store/formats/statements.h"

namespace tamp {

namespace {

/// The header of a snapshot: N time, low corner, high corner.
struct Head {
  std::int64_t count = 0;
  Surroundings said;
};

bool read_head(LineReader& in, Head& head) {
  head = {};
  do {
    if (!in.next())
      return false;
  } while (trimmed(in.line()).empty());
  const std::vector<std::string_view>& f = in.fields();
  if (f.size() != 6 && f.size() != 8)
    in.fail("the header of a snapshot should stand here: N time xmin ymin [zmin] xmax ymax [zmax]");
  const std::size_t d = (f.size() - 2) / 2;
  head.count = in.to_integer(f[0], "the number of spheres");
  head.said.dimension = static_cast<int>(d);
  for (std::size_t a = 0; a < d; ++a)
    head.said.box[a] = {in.to_number(f[2 + a], "a bound of the box"), in.to_number(f[2 + d + a], "a bound of the box")};
  return true;
}

/// Passes over the spheres of a snapshot.
void skip(LineReader& in, const Head& head) {
  for (std::int64_t i = 0; i < head.count && in.next(); ++i) {
  }
}

} // namespace

void write_mercury(const std::filesystem::path& path, const Packing& packing, const ExportOptions&) {
  FileWriter out(path);
  const bool flat = packing.dimension == 2;
  if (flat)
    out.print("{} 0 0 0 {} {}\n", packing.count(), packing.size[0], packing.size[1]);
  else
    out.print("{} 0 0 0 0 {} {} {}\n", packing.count(), packing.size[0], packing.size[1], packing.size[2]);
  for (std::size_t i = 0; i < packing.count(); ++i) {
    const auto c = packing.centre_in_space(i);
    // Position, velocity, radius, angles, angular velocity, species.
    if (flat)
      out.print("{} {} 0 0 {} 0 0 0\n", c[0], c[1], packing.radii[i]);
    else
      out.print("{} {} {} 0 0 0 {} 0 0 0 0 0 0 0\n", c[0], c[1], c[2], packing.radii[i]);
  }
  out.finish();
}

ReadPacking read_mercury(const std::filesystem::path& path, const Surroundings& stated) {
  std::size_t snapshots = 0;
  Head head;
  for (LineReader scan(path); read_head(scan, head); ++snapshots)
    skip(scan, head);
  LineReader in(path);
  for (std::size_t at = 0; read_head(in, head) && at + 1 < snapshots; ++at)
    skip(in, head);
  const auto d = static_cast<std::size_t>(head.said.dimension.value_or(3));
  const std::size_t columns = d == 3 ? 14 : 8;
  PackingBuilder spheres(path, in.file_size());
  spheres.expect(head.count);
  for (std::int64_t i = 0; i < head.count; ++i) {
    in.require(fmt::format("sphere {} of {}", i + 1, head.count));
    const std::vector<std::string_view>& f = in.fields();
    if (f.size() != columns)
      in.fail(fmt::format("{} columns; a sphere in {}D has {}", f.size(), d, columns));
    std::array<double, 3> centre{};
    for (std::size_t a = 0; a < d; ++a)
      centre[a] = in.to_number(f[a], "a coordinate");
    spheres.add(in.number(), centre, in.to_number(f[2 * d], "the radius"));
  }
  return spheres.finish(head.said, stated);
}

} // namespace tamp
