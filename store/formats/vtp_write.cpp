// Packings as VTK PolyData for ParaView: points with arrays, appended as raw bytes.
#include "store/formats/makers.h"
#include "store/formats/statements.h"

#include <bit>
#include <string>

namespace tamp {

namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

/// Appends arrays and knows where the next one begins.
class Layout {
public:
  /// The element that describes an array of `count` values of 8 bytes.
  std::string element(std::string_view type, std::string_view name, std::size_t components, std::size_t count) {
    std::string text = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, offset_);
    offset_ += 8 * (count + 1);
    return text;
  }

private:
  std::size_t offset_ = 0;
};

template <class Value>
void write_value(FileWriter& out, Value value) {
  static_assert(sizeof(Value) == 8);
  const auto bytes = std::bit_cast<std::array<char, 8>>(value);
  out.write({bytes.data(), bytes.size()});
}

/// An array: its length in bytes, then its values.
template <class F>
void write_array(FileWriter& out, std::size_t count, F&& value_of) {
  write_value(out, static_cast<std::uint64_t>(8 * count));
  for (std::size_t i = 0; i < count; ++i)
    write_value(out, value_of(i));
}

/// A text as VTK writes it in XML: the codes of its bytes, a 0 at the end.
std::string text_array(std::string_view name, std::string_view text) {
  std::string element = fmt::format("<Array type=\"String\" Name=\"{}\" NumberOfTuples=\"1\" format=\"ascii\">", name);
  for (const char c : text)
    element += fmt::format("{} ", static_cast<int>(c));
  return element + "0</Array>\n";
}

std::string box_array(const Packing& packing) {
  std::string element = "<DataArray type=\"Float64\" Name=\"box\" NumberOfComponents=\"1\" NumberOfTuples=\"";
  element += fmt::format("{}\" format=\"ascii\">", packing.dimension);
  for (std::size_t a = 0; a < static_cast<std::size_t>(packing.dimension); ++a)
    element += fmt::format("{} ", packing.size[a]);
  return element + "</DataArray>\n";
}

} // namespace

void write_vtp(const std::filesystem::path& path, const Packing& packing, const ExportOptions& options) {
  const std::size_t n = packing.count();
  FileWriter out(path);
  Layout layout;
  out.print("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n");
  out.print("{}{}{}</FieldData>\n", text_array("unit", name_of(packing.unit)),
            text_array("boundary", boundary_text(packing)), box_array(packing));
  out.print("<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
            "NumberOfPolys=\"0\">\n<PointData Scalars=\"radius\">\n",
            n);
  out.write(layout.element("Float64", "radius", 1, n));
  out.write(layout.element("Int64", "id", 1, n));
  for (const SphereField& field : options.fields)
    out.write(layout.element("Float64", field.name, 1, n));
  out.print("</PointData>\n<Points>\n{}</Points>\n<Verts>\n", layout.element("Float64", "Points", 3, 3 * n));
  out.write(layout.element("Int64", "connectivity", 1, n));
  out.print("{}</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_",
            layout.element("Int64", "offsets", 1, n));
  write_array(out, n, [&](std::size_t i) { return packing.radii[i]; });
  write_array(out, n, [](std::size_t i) { return static_cast<std::int64_t>(i + 1); });
  for (const SphereField& field : options.fields)
    write_array(out, n, [&](std::size_t i) { return field.values[i]; });
  write_array(out, 3 * n, [&](std::size_t i) { return packing.centre_in_space(i / 3)[i % 3]; });
  write_array(out, n, [](std::size_t i) { return static_cast<std::int64_t>(i); });
  write_array(out, n, [](std::size_t i) { return static_cast<std::int64_t>(i + 1); });
  out.print("\n</AppendedData>\n</VTKFile>\n");
  out.finish();
}

} // namespace tamp
