#pragma once

#include <string_view>

#include "render/compare/comparison.h"
#include "tests/catch.h"

/// The test of this name; fails the test case where there is none.
inline automorph::render::TestResult test_named(const automorph::render::Comparison& comparison,
                                                std::string_view name) {
    for (const automorph::render::TestResult& test : comparison.tests) {
        if (test.name == name) return test;
    }
    FAIL("no test " << name);
    return comparison.tests.front();
}
