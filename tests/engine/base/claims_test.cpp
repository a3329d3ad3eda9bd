// Claims of two objects, and of a process that is killed.
#include "engine/base/claims.h"
#include "tests/engine/base/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

using namespace tamp;

namespace {

const std::string kOne = std::string(15, '0') + "1 and more";
const std::string kTwo = std::string(14, '0') + "2 and more";
const std::string kLast = std::string(64, 'f');

} // namespace

TEST_CASE("a key has one claimant at a time") {
  const ScratchFolder folder;
  Claims a(folder / "claims");
  Claims b(folder / "claims");
  for (const std::string& key : {kOne, kTwo, kLast}) {
    CHECK(a.take(key));
    CHECK_FALSE(b.take(key));
  }
  a.give_back(kTwo);
  CHECK(b.take(kTwo));
  CHECK_FALSE(b.take(kOne));
  CHECK_FALSE(a.take(kTwo));
  CHECK(std::filesystem::file_size(folder / "claims") == 0);
  CHECK_THROWS_AS(a.take("no key"), Error);
  CHECK_THROWS_AS(a.take("abc"), Error);
}

TEST_CASE("many are here together, or one is alone") {
  const ScratchFolder folder;
  Claims a(folder / "claims");
  Claims b(folder / "claims");
  CHECK(a.be_here());
  CHECK(b.be_here());
  CHECK_FALSE(a.be_alone());
  b.go();
  CHECK(a.be_alone());
  CHECK_FALSE(b.be_here());
  a.go();
  CHECK(b.be_alone());
  CHECK(a.take(kOne)); // keys do not know of that
}

TEST_CASE("claims of a killed process are free") {
  const ScratchFolder folder;
  int ready[2];
  REQUIRE(::pipe(ready) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    Claims claims(folder / "claims");
    const char taken = claims.take(kOne) && claims.be_here() ? 'y' : 'n';
    if (::write(ready[1], &taken, 1) == 1)
      ::pause();
    ::_exit(1);
  }
  char taken = ' ';
  REQUIRE(::read(ready[0], &taken, 1) == 1);
  CHECK(taken == 'y');
  Claims claims(folder / "claims");
  CHECK_FALSE(claims.take(kOne));
  CHECK_FALSE(claims.be_alone());
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  CHECK(claims.take(kOne));
  CHECK(claims.be_alone());
  ::close(ready[0]);
  ::close(ready[1]);
}
