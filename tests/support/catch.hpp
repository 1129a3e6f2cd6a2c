/// \file
/// The only file that knows which Catch2 this is (Debian 12: version 2).
#pragma once
#if __has_include(<catch2/catch.hpp>)
#include <catch2/catch.hpp>
#else
#include <catch2/catch_all.hpp>
#endif
