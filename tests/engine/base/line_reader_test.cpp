// Lines of any length and ending, numbers and no numbers, and files that are whole or not there.
#include "engine/base/error.h"
#include "engine/base/file_writer.h"
#include "engine/base/files.h"
#include "engine/base/line_reader.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace tamp;
using Catch::Matchers::Contains;

TEST_CASE("a line reader gives the lines that were written") {
  const ScratchFolder folder;
  // More than two windows full, so that lines lie across their edges.
  std::vector<std::string> lines;
  std::size_t bytes = 0;
  for (std::size_t i = 0; bytes < 5 * LineReader::kLongestLine / 2; ++i) {
    lines.emplace_back((i * 7919) % 3001, static_cast<char>('a' + i % 26));
    bytes += lines.back().size() + 1;
  }
  for (const std::string end : {"\n", "\r\n"}) {
    for (const bool last_end : {true, false}) {
      std::ofstream out(folder / "text", std::ios::binary);
      for (std::size_t i = 0; i < lines.size(); ++i)
        out << lines[i] << (i + 1 < lines.size() || last_end ? end : "");
      out.close();
      LineReader in(folder / "text");
      std::size_t wrong = 0;
      for (const std::string& line : lines)
        wrong += !in.next() || in.line() != line;
      CHECK(wrong == 0);
      CHECK(in.number() == lines.size());
      CHECK_FALSE(in.next());
    }
  }
}

TEST_CASE("a line is cut at blanks or separators") {
  const ScratchFolder folder;
  std::ofstream(folder / "text") << " a\tb  c \n\n a; ;b\n";
  LineReader in(folder / "text");
  REQUIRE(in.next());
  CHECK(in.fields() == std::vector<std::string_view>{"a", "b", "c"});
  REQUIRE(in.next());
  CHECK(in.fields().empty());
  REQUIRE(in.next());
  CHECK(in.fields(';') == std::vector<std::string_view>{"a", "", "b"});
  CHECK_THROWS_WITH(in.to_number("1.5x", "the radius"), Contains("text:3: the radius is \"1.5x\", which is no number"));
  CHECK_THROWS_WITH(in.require("the end"), Contains("text:4: the file ends before the end"));
}

TEST_CASE("a number is the whole text or none") {
  double value = 0;
  CHECK((parse_number("+1.5e-3", value) && value == 1.5e-3));
  CHECK((parse_number("-7", value) && value == -7));
  for (const char* wrong : {"", " 1", "1 ", "1,5", "0x1p3", "--1", "+-1", "1e999", "one"})
    CHECK_FALSE(parse_number(wrong, value));
  std::int64_t integer = 0;
  CHECK((parse_integer("12", integer) && integer == 12));
  for (const char* wrong : {"", "1.0", "99999999999999999999"})
    CHECK_FALSE(parse_integer(wrong, integer));
}

TEST_CASE("a file writer leaves the whole file or nothing") {
  const ScratchFolder folder;
  {
    FileWriter out(folder / "large");
    for (int i = 0; i < 200000; ++i)
      out.print("{}\n", i);
    out.write("end");
    out.finish();
  }
  const std::string text = read_file(folder / "large");
  CHECK(text.size() == 1288890 + 3);
  CHECK(text.ends_with("199999\nend"));
  {
    FileWriter out(folder / "large");
    out.write("other");
  }
  CHECK(read_file(folder / "large") == text);
  CHECK(folder.size() == 1);
  CHECK_THROWS_AS(FileWriter(folder / "no such folder" / "file"), Error);
}
