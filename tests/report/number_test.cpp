// Digits of numbers at the places where rounding is delicate.
#include "report/number.h"
#include "report/table.h"

#include <catch2/catch.hpp>

using namespace tamp;

TEST_CASE("A spread leaves two significant digits of itself") {
  CHECK(decimals_of_spread(0.0123) == 3);
  CHECK(decimals_of_spread(0.0996) == 2); // rounds to 0.10
  CHECK(decimals_of_spread(0.0994) == 3);
  CHECK(decimals_of_spread(0.1) == 2);
  CHECK(decimals_of_spread(1) == 1);
  CHECK(decimals_of_spread(35) == 0);
  CHECK(decimals_of_spread(99.6) == -1); // rounds to 100
  CHECK(decimals_of_spread(1234) == -2);
}

TEST_CASE("Fixed digits, also to tens, and no negative zero") {
  CHECK(fixed(0.8197, 3) == "0.820");
  CHECK(fixed(20987, 0) == "20987");
  CHECK(fixed(20987, -2) == "21000");
  CHECK(fixed(-0.0004, 3) == "0.000");
  CHECK(fixed(-0.0006, 3) == "-0.001");
}

TEST_CASE("Scientific notation") {
  CHECK(scientific(2.13e-14).mantissa == "2.1");
  CHECK(scientific(2.13e-14).exponent == -14);
  CHECK(scientific(9.97e-3).mantissa == "1.0");
  CHECK(scientific(9.97e-3).exponent == -2);
  CHECK_FALSE(scientific(0).exponent);
}

TEST_CASE("A share is 1 only if it is") {
  CHECK(share(1) == "1");
  CHECK(share(0.9999999) == "0.999999");
  CHECK(share(0.99995) == "0.99995");
  CHECK(share(0.5) == "0.5");
  CHECK(share(0) == "0");
}

TEST_CASE("Thousands are grouped from five digits on") {
  CHECK(grouped("20654", " ") == "20 654");
  CHECK(grouped("1234", " ") == "1234");
  CHECK(grouped("-1234567.1234567", ",") == "-1,234,567.1234567");
  CHECK(grouped("+123456", " ") == "+123 456");
  CHECK(grouped("0.123456", " ") == "0.123456");
}

TEST_CASE("The paper's times come out in the units it prints") {
  CHECK(time_unit(4.65).name == "s");
  CHECK(time_unit(600).name == "min");
  CHECK(time_unit(1932).name == "min");
  CHECK(time_unit(38880).name == "h");
  CHECK(time_unit(92448).name == "d");
}

namespace {

Cell cell(double value, double spread, CellStyle style = CellStyle::fixed) {
  Cell c;
  c.value = value;
  c.spread = spread;
  c.style = style;
  return c;
}

} // namespace

TEST_CASE("The value of a cell is rounded where its spread is") {
  const CellText phi = show(cell(0.81968, 0.00084));
  CHECK(phi.value == "0.81968");
  CHECK(phi.spread == "0.00084");
  const CellText count = show(cell(20987.4, 123.4));
  CHECK(count.value == "20990");
  CHECK(count.spread == "120");
}

TEST_CASE("A spread of zero or of rounding is none, and the digits are the column's") {
  for (const double spread : {0.0, 2.7e-15, 2e-10}) {
    Cell exact = cell(0.7487616634028189, spread);
    exact.decimals = 4;
    CHECK(show(exact).value == "0.7488");
    CHECK(show(exact).spread.empty());
    exact.style = CellStyle::duration;
    CHECK(show(exact).spread.empty());
  }
  CHECK(show(cell(0.25, 1e-8)).spread == "0.000000010");
  CHECK(show(cell(0, 0)).spread.empty());
  CHECK(show(cell(0.25, Cell::kNone)).spread.empty());
}

TEST_CASE("A duration is scaled together with its spread") {
  const CellText time = show(cell(1932, 6, CellStyle::duration));
  CHECK(time.value == "32.20");
  CHECK(time.spread == "0.10");
  CHECK(time.unit == "min");
  CHECK(show(cell(0.000123456, Cell::kNone, CellStyle::duration)).value == "0.000123");
}

TEST_CASE("Ratios have two digits, differences a sign") {
  CHECK(show(cell(20.4, Cell::kNone, CellStyle::ratio)).value == "20");
  CHECK(show(cell(0.531, Cell::kNone, CellStyle::ratio)).value == "0.53");
  CHECK(show(cell(14321, Cell::kNone, CellStyle::ratio)).value == "14000");
  Cell difference = cell(0.0087, Cell::kNone);
  difference.sign = true;
  difference.decimals = 3;
  CHECK(show(difference).value == "+0.009");
  difference.value = -0.0002;
  CHECK(show(difference).value == "0.000");
}

TEST_CASE("A cell without a finite value is empty") {
  CHECK(Cell{}.empty());
  CHECK(cell(1.0 / 0.0, 0).empty());
  CHECK_FALSE(cell(0, 0).empty());
}
