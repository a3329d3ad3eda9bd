// Reads VTK PolyData whose arrays are appended, as raw bytes or in base64, not compressed.
#include "engine/base/error.h"
#include "engine/base/line_reader.h"
#include "store/formats/makers.h"
#include "store/formats/statements.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <map>

namespace tamp {

namespace {

constexpr std::size_t kLongestHead = std::size_t{1} << 20U; // bytes before the appended data

/// The value of name="…" in a tag; empty if it has none.
std::string attribute(std::string_view tag, std::string_view name) {
  const std::string key = fmt::format(" {}=\"", name);
  const std::size_t at = tag.find(key);
  if (at == std::string_view::npos)
    return {};
  const std::size_t begin = at + key.size();
  return std::string(tag.substr(begin, tag.find('"', begin) - begin));
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// One array as the head describes it.
struct ArrayAt {
  std::string type;
  std::size_t components = 1;
  std::size_t offset = 0;
};

class VtpFile {
public:
  explicit VtpFile(const std::filesystem::path& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_)
      fail("cannot be opened");
    size_ = std::filesystem::file_size(path);
    head_.resize(std::min<std::uintmax_t>(size_, kLongestHead));
    file_.read(head_.data(), static_cast<std::streamsize>(head_.size()));
    const std::size_t appended = head_.find("<AppendedData");
    const std::size_t mark = appended == std::string::npos ? appended : head_.find('_', head_.find('>', appended));
    if (head_.find("<VTKFile") == std::string::npos || head_.find("<PolyData") == std::string::npos)
      fail("this is no VTK PolyData in XML");
    if (mark == std::string::npos)
      fail("no appended data: save the arrays appended, or the file is truncated");
    base64_ = attribute(tag_at(appended), "encoding") == "base64";
    begin_ = mark + 1;
    head_.resize(appended);
    const std::string_view top = tag_at(head_.find("<VTKFile"));
    if (attribute(top, "byte_order") == "BigEndian" || !attribute(top, "compressor").empty())
      fail("the arrays are compressed or big-endian; save them uncompressed and little-endian");
    length_size_ = attribute(top, "header_type") == "UInt64" ? 8 : 4;
  }

  [[noreturn]] void fail(std::string_view message) const { fail_in_line(path_, 0, message); }
  [[nodiscard]] std::uintmax_t size() const { return size_; }
  [[nodiscard]] const std::string& head() const { return head_; }
  /// Empty where there is no tag.
  [[nodiscard]] std::string_view tag_at(std::size_t at) const {
    if (at >= head_.size())
      return {};
    return std::string_view(head_).substr(at, head_.find('>', at) - at);
  }

  /// An array that must have `count` numbers.
  std::vector<double> numbers(const ArrayAt& array, std::size_t count, std::string_view name) {
    const std::size_t width = array.type == "Float64" ? 8 : array.type == "Float32" ? 4 : 0;
    if (width == 0)
      fail(fmt::format("the array {} is of type {}; allowed: Float64, Float32", name, array.type));
    if (count > size_ / width)
      fail(fmt::format("the file is too short for the array {} of {} numbers: it is truncated", name, count));
    start(array.offset);
    std::array<char, 8> stated{};
    take(stated.data(), length_size_, name);
    if (std::bit_cast<std::uint64_t>(stated) != width * count)
      fail(fmt::format("the array {} has {} bytes instead of {}", name, std::bit_cast<std::uint64_t>(stated),
                       width * count));
    std::vector<double> values(count);
    for (double& value : values) {
      std::array<char, 8> bytes{};
      take(bytes.data(), width, name);
      if (width == 8) {
        value = std::bit_cast<double>(bytes);
      } else {
        float single = 0;
        std::memcpy(&single, bytes.data(), sizeof single);
        value = static_cast<double>(single);
      }
    }
    return values;
  }

private:
  void start(std::size_t offset) {
    if (offset > size_)
      fail("an array begins beyond the end of the file: it is truncated");
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(begin_ + offset));
    pending_.clear();
  }

  void take(char* to, std::size_t count, std::string_view name) {
    if (!base64_) {
      if (!file_.read(to, static_cast<std::streamsize>(count)))
        fail(fmt::format("the file ends within the array {}: it is truncated", name));
      return;
    }
    while (pending_.size() < count)
      decode_group(name);
    pending_.copy(to, count);
    pending_.erase(0, count);
  }

  /// Four digits are three bytes; padding ends a part, as the length may be coded by itself.
  void decode_group(std::string_view name) {
    std::array<char, 4> digits{};
    if (!file_.read(digits.data(), digits.size()))
      fail(fmt::format("the file ends within the array {}: it is truncated", name));
    std::uint32_t bits = 0;
    std::size_t padding = 0;
    for (const char c : digits) {
      const int digit = base64_digit(c);
      if (digit < 0 && c != '=')
        fail(fmt::format("the array {} is not in base64", name));
      padding += c == '=' ? 1 : 0;
      bits = (bits << 6U) | static_cast<std::uint32_t>(std::max(digit, 0));
    }
    for (std::size_t i = 0; i + std::min<std::size_t>(padding, 2) < 3; ++i)
      pending_ += static_cast<char>((bits >> (16U - 8U * i)) & 0xFFU);
  }

  std::filesystem::path path_;
  std::ifstream file_;
  std::uintmax_t size_ = 0;
  std::string head_;
  std::size_t begin_ = 0;
  bool base64_ = false;
  std::size_t length_size_ = 8;
  std::string pending_;
};

/// The whole numbers or numbers between the tags of an array that is written out in the head.
std::vector<double> inline_numbers(const VtpFile& in, std::size_t tag) {
  const std::size_t begin = in.head().find('>', tag) + 1;
  std::string_view text = std::string_view(in.head()).substr(begin, in.head().find('<', begin) - begin);
  std::vector<double> values;
  while (!(text = trimmed(text)).empty()) {
    const std::size_t end = std::min(text.find_first_of(" \t\n"), text.size());
    double value = 0;
    if (!parse_number(text.substr(0, end), value))
      in.fail("an array in the head is not of numbers");
    values.push_back(value);
    text.remove_prefix(end);
  }
  return values;
}

std::string inline_text(const VtpFile& in, std::size_t tag) {
  std::string text;
  for (const double code : inline_numbers(in, tag)) {
    if (code > 0 && code < 128)
      text += static_cast<char>(code);
  }
  return text;
}

/// All arrays of the head by name, and what our own arrays say of the surroundings.
std::map<std::string, ArrayAt> read_head(const VtpFile& in, Surroundings& said) {
  std::map<std::string, ArrayAt> arrays;
  for (std::size_t at = in.head().find("Array "); at != std::string::npos; at = in.head().find("Array ", at + 1)) {
    const std::string_view tag = in.tag_at(at);
    const std::string name = attribute(tag, "Name");
    if (attribute(tag, "format") == "appended") {
      std::int64_t offset = 0;
      std::int64_t components = 1;
      const std::string width = attribute(tag, "NumberOfComponents");
      if (!parse_integer(attribute(tag, "offset"), offset) || offset < 0 ||
          (!width.empty() && (!parse_integer(width, components) || components < 1)))
        in.fail(fmt::format("the array {} has no sound offset or number of components", name));
      arrays[name] = {attribute(tag, "type"), static_cast<std::size_t>(components), static_cast<std::size_t>(offset)};
    } else if (name == "unit") {
      said.unit = enum_of<LengthUnit>(inline_text(in, at));
    } else if (name == "boundary") {
      said.boundary = read_boundary(inline_text(in, at));
    } else if (name == "box") {
      const std::vector<double> edges = inline_numbers(in, at);
      for (std::size_t a = 0; a < std::min<std::size_t>(edges.size(), 3); ++a)
        said.box[a] = {0, edges[a]};
      said.dimension = edges.size() == 2 ? 2 : 3;
    }
  }
  return arrays;
}

} // namespace

ReadPacking read_vtp(const std::filesystem::path& path, const Surroundings& stated) {
  VtpFile in(path);
  Surroundings said;
  const std::map<std::string, ArrayAt> arrays = read_head(in, said);
  const std::size_t piece = in.head().find("<Piece ");
  std::int64_t count = 0;
  if (piece == std::string::npos || in.head().find("<Piece ", piece + 1) != std::string::npos)
    in.fail("there must be one <Piece>");
  if (!parse_integer(attribute(in.tag_at(piece), "NumberOfPoints"), count) || count < 1)
    in.fail("there is no sphere in the file");
  const std::size_t section = in.head().find("<Points>");
  const std::size_t points_tag = section == std::string::npos ? section : in.head().find("Array ", section);
  const auto points =
      points_tag == std::string::npos ? arrays.end() : arrays.find(attribute(in.tag_at(points_tag), "Name"));
  if (points == arrays.end() || points->second.components != 3)
    in.fail("no appended array of Points with three components");
  auto radius = arrays.end();
  for (const char* name : {"radius", "Radius", "radii", "diameter", "Diameter"})
    radius = radius == arrays.end() ? arrays.find(name) : radius;
  if (radius == arrays.end())
    in.fail("no appended array radius or diameter, so the spheres have no sizes");
  const double to_radius = radius->first == "diameter" || radius->first == "Diameter" ? 0.5 : 1;
  const auto n = static_cast<std::size_t>(count);
  if (n > in.size() / 3)
    in.fail(fmt::format("the file is too short for {} spheres: it is truncated", n));
  const std::vector<double> centres = in.numbers(points->second, 3 * n, points->first);
  const std::vector<double> sizes = in.numbers(radius->second, n, radius->first);
  PackingBuilder spheres(path, in.size());
  spheres.expect(count);
  for (std::size_t i = 0; i < n; ++i)
    spheres.add(0, {centres[3 * i], centres[3 * i + 1], centres[3 * i + 2]}, to_radius * sizes[i]);
  ReadPacking read = spheres.finish(said, stated);
  for (const auto& [name, array] : arrays)
    read.columns.push_back(name);
  return read;
}

} // namespace tamp
