// SPDX-License-Identifier: Apache-2.0
#include "conformance/kit_version.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "conformance/procedures.h"
#include "text/sha256.h"

namespace kerf::conformance {
namespace {

/// Each test with its level, one a line.
std::string listed_tests() {
    std::string list;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(
        popen(KERF_BUILD_DIR "/libexec/kerf/kerf-check-child --list", "r"), &pclose);
    char line[1000];
    while (pipe != nullptr && std::fgets(line, sizeof line, pipe.get()) != nullptr) {
        const auto test = nlohmann::json::parse(line);
        list += test.value("test", "") + " " + std::to_string(test.value("level", 0)) + "\n";
    }
    for (const std::string& id : procedure_tests()) list += id + " 5\n";
    return list;
}

TEST(KitVersion, RisesWithTheTests) {
    const std::string list = listed_tests();
    EXPECT_EQ(kit_version, 3);
    EXPECT_EQ(text::sha256_of(list).substr(0, 16), "e1fadf6692415e24")
        << "The list of tests has changed: raise kit_version in conformance/kit_version.h by 1, then write both here.\n"
        << list;
}

}  // namespace
}  // namespace kerf::conformance
