// The facts of the machine against independent sources, and the clocks against each other.
#include "engine/base/host.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

using namespace tamp;
using namespace std::chrono_literals;

TEST_CASE("The facts of the host are there and stay the same", "[host]") {
  const auto facts = host_facts();
  char name[256] = {};
  REQUIRE(::gethostname(name, sizeof name - 1) == 0);
  CHECK(facts.name == name);
  CHECK_FALSE(facts.cpu_model.empty());
  CHECK(facts.cpu_model.front() != ' ');
  CHECK(facts.kernel.starts_with("Linux "));
  CHECK(facts.boot_id.size() == 36);
  CHECK(facts.boot_id == host_facts().boot_id);
  CHECK(facts.hardware_threads >= static_cast<int>(usable_cores().size()));
  CHECK(facts.memory_bytes > peak_rss_bytes());
  CHECK(load_average()[0] >= 0);
}

TEST_CASE("UTC is written with microseconds, before and after 1970", "[host]") {
  using std::chrono::system_clock;
  const auto at = [](std::chrono::microseconds since_epoch) { return to_utc(system_clock::time_point(since_epoch)); };
  CHECK(at(0us) == "1970-01-01T00:00:00.000000Z");
  CHECK(at(1us) == "1970-01-01T00:00:00.000001Z");
  CHECK(at(-1us) == "1969-12-31T23:59:59.999999Z");
  CHECK(at(951'782'400s + 123'456us) == "2000-02-29T00:00:00.123456Z");
  CHECK(at(1'715'933'350s) == "2024-05-17T08:09:10.000000Z");
}

TEST_CASE("The present is between two readings of the clock, and texts sort as times do", "[host]") {
  const auto before = to_utc(std::chrono::system_clock::now());
  const auto now = utc_now();
  const auto after = to_utc(std::chrono::system_clock::now());
  CHECK(before <= now);
  CHECK(now <= after);
  auto shape = now;
  std::replace_if(
      shape.begin(), shape.end(), [](char c) { return c >= '0' && c <= '9'; }, '0');
  CHECK(shape == "0000-00-00T00:00:00.000000Z");
}

TEST_CASE("Sleep takes wall time and no CPU time; work takes both", "[host]") {
  const double wall = steady_seconds(), thread = thread_cpu_seconds();
  std::this_thread::sleep_for(100ms);
  CHECK(steady_seconds() - wall >= 0.1);
  CHECK(thread_cpu_seconds() - thread < 0.05);

  const double process = process_cpu_seconds(), own = thread_cpu_seconds();
  double worker = 0;
  std::thread([&] {
    while (thread_cpu_seconds() < 0.1)
      continue;
    worker = thread_cpu_seconds();
  }).join();
  CHECK(worker >= 0.1);
  CHECK(process_cpu_seconds() - process >= 0.09);
  CHECK(thread_cpu_seconds() - own < 0.09);
}

TEST_CASE("Peak memory grows with what is touched, and stays when it is freed", "[host]") {
  const auto before = peak_rss_bytes();
  CHECK(before > 0);
  constexpr std::size_t size = 300u << 20;
  { const std::vector<char> ballast(size, 'x'); }
  CHECK(peak_rss_bytes() >= size);
  CHECK(peak_rss_bytes() < before + 6 * size); // Not closer, as sanitizers keep a shadow of what is touched.
  CHECK(peak_rss_bytes(::getpid()) == peak_rss_bytes());
  CHECK(peak_rss_bytes(0x7ffffff0) == 0);
}
