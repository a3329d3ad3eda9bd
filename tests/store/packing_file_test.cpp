// Packings survive the way through HDF5, equal packings give equal bytes, and damaged files are refused.
#include "engine/base/error.h"
#include "engine/base/files.h"
#include "engine/base/process.h"
#include "store/packing_file.h"
#include "tests/engine/base/failing_file_system.h"
#include "tests/engine/base/scratch_folder.h"
#include "tests/store/examples.h"

#include <catch2/catch.hpp>
#include <hdf5.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <thread>

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 forgets memory of its own when it meets damaged metadata; that is not ours to report.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

using namespace tamp;
using Catch::Matchers::Contains;

namespace {

const PackingLabel label{"abc123", R"({"kind":"generation"})", "drop-and-roll", "0.1.0"};

void check_equal(const Packing& a, const Packing& b) {
  CHECK(a.dimension == b.dimension);
  CHECK(a.unit == b.unit);
  CHECK(a.size == b.size);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(a.dimension); ++axis)
    CHECK(a.boundary[axis] == b.boundary[axis]);
  CHECK((a.positions == b.positions));
  CHECK((a.radii == b.radii));
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator all("/proc/self/fd");
  return std::distance(begin(all), end(all));
}

} // namespace

TEST_CASE("a packing reads back as it was written") {
  const ScratchFolder folder;
  for (const int dimension : {2, 3}) {
    for (const std::size_t count : {0U, 1U, 1000U}) {
      const Packing packing = example_packing(dimension, count);
      write_packing(folder / "p.h5", packing, label);
      check_equal(read_packing(folder / "p.h5"), packing);
    }
  }
  CHECK(folder.size() == 1);
}

TEST_CASE("the label of a packing file reads back, however long its canonical text") {
  const ScratchFolder folder;
  for (const std::size_t length : {std::size_t{0}, std::size_t{30}, std::size_t{300'000}}) {
    const PackingLabel written{"", std::string(length, 'x'), "lattice", "0.1.0"};
    write_packing(folder / "p.h5", example_packing(2, 3), written);
    const PackingLabel read = read_packing_label(folder / "p.h5");
    CHECK(read.key.empty());
    CHECK((read.canonical == written.canonical));
    CHECK(read.method == "lattice");
    CHECK(read.creator_version == "0.1.0");
  }
}

TEST_CASE("equal packings give equal bytes, others do not") {
  const ScratchFolder folder;
  const Packing packing = example_packing(3, 5000);
  write_packing(folder / "a.h5", packing, label);
  const std::string bytes = read_file(folder / "a.h5");
  // Used memory, other files open, another second: nothing of that may show.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  for (int i = 0; i < 5; ++i) {
    write_packing(folder / "other.h5", example_packing(2, static_cast<std::size_t>(100 * i), std::to_string(i)), label);
    write_packing(folder / "b.h5", packing, label);
    CHECK((read_file(folder / "b.h5") == bytes));
  }
  Packing moved = packing;
  moved.positions[7] = std::nextafter(moved.positions[7], 2);
  write_packing(folder / "c.h5", moved, label);
  CHECK_FALSE((read_file(folder / "c.h5") == bytes));
}

TEST_CASE("several threads may write and read packings at once") {
  const ScratchFolder folder;
  std::vector<std::thread> threads;
  std::array<bool, 4> good{};
  for (std::size_t t = 0; t < good.size(); ++t) {
    threads.emplace_back([&, t] {
      const Packing packing = example_packing(2, 500 + t);
      const auto path = folder / (std::to_string(t) + ".h5");
      good[t] = true;
      for (int i = 0; i < 20; ++i) {
        write_packing(path, packing, label);
        good[t] = good[t] && read_packing(path).positions == packing.positions;
      }
    });
  }
  for (auto& thread : threads)
    thread.join();
  for (const bool g : good)
    CHECK(g);
}

TEST_CASE("a truncated packing is refused wherever it is cut") {
  const ScratchFolder folder;
  write_packing(folder / "p.h5", example_packing(3, 200), label);
  const std::string bytes = read_file(folder / "p.h5");
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    write_bytes(folder / "cut.h5", bytes.substr(0, length));
    REQUIRE_THROWS_AS(read_packing(folder / "cut.h5"), Error);
    REQUIRE_THROWS_WITH(read_packing(folder / "cut.h5"), Contains("cut.h5"));
  }
  write_bytes(folder / "cut.h5", bytes.substr(0, bytes.size() - 1));
  CHECK_THROWS_WITH(read_packing(folder / "cut.h5"), Contains("truncated"));
}

TEST_CASE("a damaged packing never does worse than an error") {
  const ScratchFolder folder;
  const Packing packing = example_packing(2, 20);
  write_packing(folder / "p.h5", packing, label);
  const std::string bytes = read_file(folder / "p.h5");
  int refused = 0;
  const auto descriptors = open_descriptors();
  RandomStream random("damage", 0);
  for (int i = 0; i < 500; ++i) {
    std::string damaged = bytes;
    damaged[random.below(damaged.size())] = static_cast<char>(random.below(256));
    write_bytes(folder / "bad.h5", damaged);
    try {
      const Packing read = read_packing(folder / "bad.h5");
      REQUIRE(read.positions.size() == 2 * read.count());
    } catch (const Error&) {
      ++refused;
    }
  }
  CHECK(refused > 0);
  CHECK(open_descriptors() <= descriptors);
}

TEST_CASE("files that are no packings are refused by name and reason") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(read_packing(folder / "none.h5"), Contains("none.h5") && Contains("No such file"));
  write_bytes(folder / "text.h5", "x,y,r\n0,0,1\n");
  CHECK_THROWS_WITH(read_packing(folder / "text.h5"), Contains("text.h5") && Contains("HDF5"));
  CHECK_THROWS_AS(read_packing(folder.path()), Error);

  const auto foreign = folder / "foreign.h5";
  H5Fclose(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  CHECK_THROWS_WITH(read_packing(foreign), Contains("foreign.h5") && Contains("lacks /h5md"));

  write_packing(folder / "p.h5", example_packing(2, 5), label);
  const hid_t file = H5Fopen((folder / "p.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "/particles/powder/radius", H5P_DEFAULT);
  H5Fclose(file);
  CHECK_THROWS_WITH(read_packing(folder / "p.h5"), Contains("lacks /particles/powder/radius"));
}

TEST_CASE("an impossible packing is not written") {
  const ScratchFolder folder;
  Packing packing = example_packing(2, 5);
  packing.positions.pop_back();
  CHECK_THROWS_WITH(write_packing(folder / "p.h5", packing, label), Contains("9 coordinates for 5"));
  packing = example_packing(2, 5);
  packing.dimension = 4;
  CHECK_THROWS_WITH(write_packing(folder / "p.h5", packing, label), Contains("4"));
  CHECK_THROWS_WITH(write_packing(folder / "no" / "p.h5", example_packing(2, 5), label), Contains("p.h5"));
  CHECK(folder.size() == 0);
}

TEST_CASE("a packing whose publication fails leaves the old file and nothing else") {
  const ScratchFolder folder;
  write_packing(folder / "p.h5", example_packing(2, 5), label);
  using Call = FailingFileSystem::Call;
  for (const Call call : {Call::open, Call::fsync, Call::rename}) {
    FailingFileSystem failing(call, 1, EIO);
    const ScopedFileSystem scope(failing);
    CHECK_THROWS_AS(write_packing(folder / "p.h5", example_packing(2, 7), label), Error);
    CHECK(failing.failed());
  }
  CHECK(read_packing(folder / "p.h5").count() == 5);
  CHECK(folder.size() == 1);
}

TEST_CASE("h5py reads what H5MD promises") {
  std::string python;
  for (const std::string candidate : {"python3", "/usr/bin/python3"}) {
    if (std::filesystem::exists("/usr/bin/python3") &&
        run_process({.argv = {candidate, "-c", "import h5py"}}).succeeded())
      python = candidate;
  }
  if (python.empty()) {
    WARN("python3-h5py is not there: the packing file was not read by another program");
    return;
  }
  const ScratchFolder folder;
  Packing packing = example_packing(3, 4);
  packing.positions[5] = 0.1;
  write_packing(folder / "p.h5", packing, label);
  const std::string script = R"(
import sys, h5py
f = h5py.File(sys.argv[1])
assert list(f['h5md'].attrs['version']) == [1, 1]
assert f['h5md/creator'].attrs['name'].decode() == 'tamp'
assert 'name' in f['h5md/author'].attrs
p = f['particles/powder']
assert p['box'].attrs['dimension'] == 3
assert [b.decode() for b in p['box'].attrs['boundary']] == ['periodic', 'none', 'none']
assert list(p['box/edges'][()]) == [0.1, 1 / 3, 7e-5]
assert p['position'].shape == (4, 3) and p['position'].dtype == 'f8' and p['position'][1, 2] == 0.1
assert p['position'].attrs['unit'].decode() == 'mm'
assert p['radius'].shape == (4,) and p['radius'].attrs['unit'].decode() == 'mm'
t = f['parameters/tamp']
assert t.attrs['key'].decode() == 'abc123'
assert [b.decode() for b in t.attrs['boundary']] == ['periodic', 'wall', 'open']
assert t['canonical'][()].decode() == '{"kind":"generation"}'
)";
  const auto result = run_process({.argv = {python, "-c", script, (folder / "p.h5").string()}, .log = folder / "log"});
  INFO(result.log_tail);
  CHECK(result.succeeded());
}
