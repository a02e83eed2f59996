// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/brick_memory.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace kerf {
namespace {

constexpr std::size_t large = std::size_t{64} << 20;

/// What the kernel says of the mapping that holds a place: the line of its flags; empty where it has none.
std::string flags_of(const void* place) {
    std::ifstream in("/proc/self/smaps");
    bool is_it = false;
    for (std::string line; std::getline(in, line);) {
        unsigned long long first = 0, end = 0;
        if (std::sscanf(line.c_str(), "%llx-%llx ", &first, &end) == 2)
            is_it = first <= reinterpret_cast<std::uintptr_t>(place) && reinterpret_cast<std::uintptr_t>(place) < end;
        if (is_it && line.starts_with("VmFlags:")) return line + " ";
    }
    return {};
}

/// [bytes] of the process that are on the machine.
std::size_t resident() {
    std::ifstream in("/proc/self/statm");
    std::size_t all = 0, here = 0;
    in >> all >> here;
    return here * 4096;
}

TEST(BrickMemory, LargeOnesAreInHugePagesWhereTheSystemHasThem) {
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage/enabled"))
        GTEST_SKIP() << "this system has no huge pages";
    void* memory = map_brick_memory(large);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % (std::size_t{2} << 20), 0u) << "begins with a huge page";
    const std::string flags = flags_of(memory);
    if (flags.empty()) GTEST_SKIP() << "this system does not tell of its mappings";
    EXPECT_NE(flags.find(" hg "), std::string::npos) << flags;
    unmap_brick_memory(memory, large);
}

TEST(BrickMemory, WhatIsReservedCostsNothingBeforeItIsTouched) {
    const std::size_t before = resident();
    void* memory = map_brick_memory(large);
    EXPECT_LT(resident(), before + large / 8);
    unmap_brick_memory(memory, large);
}

TEST(BrickMemory, AVectorThatReservedGrowsWithoutMoving) {
    BrickSamples<std::int16_t> samples;
    samples.reserve(large / sizeof(std::int16_t));
    const std::int16_t* first = samples.data();
    samples.resize(1000, 7);
    samples.resize(3000000, 9);
    EXPECT_EQ(samples.data(), first);
    EXPECT_EQ(samples[999], 7);
    EXPECT_EQ(samples[2999999], 9);
}

}  // namespace
}  // namespace kerf
