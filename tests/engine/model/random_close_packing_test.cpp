// The estimate of random close packing against the figures its authors print.
#include "engine/model/random_close_packing.h"
#include "tests/engine/model/psd_examples.h"

#include <catch2/catch.hpp>

using namespace tamp;
using namespace tamp::test;

TEST_CASE("the estimate of random close packing has the values of Farr and Groot") {
  CHECK(random_close_packing(SizeLaw(monodisperse_psd(3), 3), 3) == Approx(0.6435).margin(2e-3));
  CHECK(random_close_packing(SizeLaw(lognormal_psd(0.30, 0.3, 0.01, 100), 3), 3) == Approx(0.671).margin(2e-3));
  CHECK(random_close_packing(SizeLaw(lognormal_psd(0.30, 0.68, 0.01, 500), 3), 3) == Approx(0.742).margin(2e-3));
  CHECK(random_close_packing(SizeLaw(bimodal_psd(1, 2, 0.75), 3), 3) == Approx(0.682).margin(2e-3));
  CHECK(random_close_packing(SizeLaw(bimodal_psd(1, 10, 0.75), 3), 3) == Approx(0.827).margin(2e-3));
  CHECK(random_close_packing(SizeLaw(bimodal_psd(1, 40, 0.75), 3), 3) == Approx(0.851).margin(3e-3));
}
