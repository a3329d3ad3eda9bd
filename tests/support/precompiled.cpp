// Makes CMake compile the precompiled header, which main.cpp cannot use.
#include <catch2/catch.hpp>
