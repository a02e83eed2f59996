// SPDX-License-Identifier: Apache-2.0
// What a law writes ends at a page that names itself.
#include "core/plugin/law_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace kerf {
namespace {

/// What the first byte behind an array reports.
std::string behind(const void* end) {
    const char* misuse = misuse_of(end);
    return misuse != nullptr ? misuse : "";
}

struct LawMemoryOf : testing::Test {
    static kerf_force force(std::uint32_t state_size, std::uint32_t state_align, std::uint32_t signals) {
        kerf_force made{};
        made.state_size = state_size;
        made.state_align = state_align;
        made.signal_count = signals;
        return made;
    }
    LawMemory memory{5000};
};

TEST_F(LawMemoryOf, ResistEndsBehindEachArray) {
    kerf_law& law = memory.new_law();
    EXPECT_NE(behind(law.channel + KERF_MAX_CHANNELS).find("`channel`, which has 16 elements"), std::string::npos);
    EXPECT_NE(behind(law.note + KERF_NOTE_BYTES).find("`note`"), std::string::npos);
    EXPECT_EQ(behind(law.channel + KERF_MAX_CHANNELS - 1), "");
    law.channel[KERF_MAX_CHANNELS - 1].tau = 1.0;
    law.note[KERF_NOTE_BYTES - 1] = 1;
    law.count = 3;
    const kerf_law& next = memory.new_law();
    EXPECT_EQ(next.channel[KERF_MAX_CHANNELS - 1].tau, 0.0);
    EXPECT_EQ(next.note[KERF_NOTE_BYTES - 1], 0);
    EXPECT_EQ(next.count, 0u);
}

TEST_F(LawMemoryOf, CommitEndsBehindEachArray) {
    memory.fit(force(8, 8, 3));
    kerf_commit_out& out = memory.new_commit_out();
    EXPECT_NE(behind(out.action + KERF_MAX_ACTIONS).find("`action`, which has 8 elements"), std::string::npos);
    EXPECT_NE(behind(out.signal + 3).find("`signal`"), std::string::npos);
    EXPECT_NE(behind(out.thread + 1).find("`thread`"), std::string::npos);
    EXPECT_NE(behind(&out + 1).find("`kerf_commit_out`"), std::string::npos);
    out.signal[2] = 4.0;
    out.thread_count = 1;
    const kerf_commit_out& next = memory.new_commit_out();
    EXPECT_EQ(next.signal[2], 4.0) << "a law that does not write a signal keeps it";
    EXPECT_EQ(next.thread_count, 0u);
}

TEST_F(LawMemoryOf, TheStateEndsWhereTheLawInHandNeedsIt) {
    for (const auto& [size, alignment] : {std::pair{8u, 8u}, {24u, 8u}, {4992u, 64u}, {1u, 1u}}) {
        memory.fit(force(size, alignment, 0));
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.state()) % alignment, 0u);
        std::fill_n(memory.state(), size, std::byte{1});
        EXPECT_NE(behind(memory.state() + size).find("`state_size`"), std::string::npos) << size;
    }
}

TEST_F(LawMemoryOf, SignalsOfALawThatDeclaresNoneCannotBeWritten) {
    memory.fit(force(8, 8, 0));
    EXPECT_NE(behind(memory.new_commit_out().signal).find("`signal`"), std::string::npos);
}

TEST(LawMemory, IsForgottenWithItsNames) {
    auto made = std::make_unique<LawMemory>(64);
    const void* const end = made->new_law().channel + KERF_MAX_CHANNELS;
    ASSERT_NE(behind(end), "");
    made.reset();
    EXPECT_EQ(behind(end), "");
}

TEST(LawMemory, OfManyRunsNeedsNoMoreNames) {
    std::string last;
    for (int run = 0; run < 2000; ++run) last = behind(LawMemory(64).new_law().channel + KERF_MAX_CHANNELS);
    EXPECT_NE(last, "");
}

}  // namespace
}  // namespace kerf
