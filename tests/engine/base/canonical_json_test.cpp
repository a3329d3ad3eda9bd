// The canonical form against the published vectors of RFC 8785, and the hash of keys against FIPS 180-4.
#include "engine/base/canonical_json.h"
#include "engine/base/error.h"
#include "engine/base/sha256.h"

#include <catch2/catch.hpp>

#include <bit>
#include <string>

using namespace tamp;

TEST_CASE("numbers are printed as RFC 8785, appendix B, lists them") {
  struct Vector {
    std::uint64_t bits;
    const char* text;
  };
  for (const Vector& v : {Vector{0x0000000000000000, "0"},
                          {0x8000000000000000, "0"},
                          {0x0000000000000001, "5e-324"},
                          {0x8000000000000001, "-5e-324"},
                          {0x7fefffffffffffff, "1.7976931348623157e+308"},
                          {0xffefffffffffffff, "-1.7976931348623157e+308"},
                          {0x4340000000000000, "9007199254740992"},
                          {0xc340000000000000, "-9007199254740992"},
                          {0x4430000000000000, "295147905179352830000"},
                          {0x44b52d02c7e14af5, "9.999999999999997e+22"},
                          {0x44b52d02c7e14af6, "1e+23"},
                          {0x44b52d02c7e14af7, "1.0000000000000001e+23"},
                          {0x444b1ae4d6e2ef4e, "999999999999999700000"},
                          {0x444b1ae4d6e2ef4f, "999999999999999900000"},
                          {0x444b1ae4d6e2ef50, "1e+21"},
                          {0x3eb0c6f7a0b5ed8c, "9.999999999999997e-7"},
                          {0x3eb0c6f7a0b5ed8d, "0.000001"},
                          {0x41b3de4355555553, "333333333.3333332"},
                          {0x41b3de4355555554, "333333333.33333325"},
                          {0x41b3de4355555555, "333333333.3333333"},
                          {0x41b3de4355555556, "333333333.3333334"},
                          {0x41b3de4355555557, "333333333.33333343"},
                          {0xbecbf647612f3696, "-0.0000033333333333333333"},
                          {0x43143ff3c1cb0959, "1424953923781206.2"}})
    CHECK(canonical_number(std::bit_cast<double>(v.bits)) == v.text);
  CHECK_THROWS_AS(canonical_number(std::bit_cast<double>(std::uint64_t{0x7fffffffffffffff})), Error);
  CHECK_THROWS_AS(canonical_number(std::bit_cast<double>(std::uint64_t{0x7ff0000000000000})), Error);
}

TEST_CASE("numbers and string of the example in RFC 8785, section 3.2.2, have the text of section 3.2.3") {
  const JsonPaths document = {{"numbers", std::vector<double>{333333333.33333329, 1E30, 4.50, 2e-3, 1e-27}},
                              {"string", std::string("\u20ac$\x0F\x0a"
                                                     "A'\x42\x22\x5c\\\"/")}};
  CHECK(canonical_json(document) == "{\"numbers\":[333333333.3333333,1e+30,4.5,0.002,1e-27],"
                                    "\"string\":\"\u20ac$\\u000f\\nA'B\\\"\\\\\\\\\\\"/\"}");
}

TEST_CASE("keys of nested objects are sorted by themselves, not by their paths") {
  // As paths, "a!/x" precedes "a/x" although "a" precedes "a!".
  const JsonPaths document = {{"a!/x", std::int64_t{1}}, {"a/x", true}, {"a/b/c", 0.5}};
  CHECK(canonical_json(document) == R"({"a":{"b":{"c":0.5},"x":true},"a!":{"x":1}})");
}

TEST_CASE("SHA-256 gives the digests of FIPS 180-4's examples") {
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
