// SPDX-License-Identifier: Apache-2.0
#include "devices/pedal/report.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "devices/pedal/pedal.h"

namespace kerf::pedal {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Source of the eight reports: github.com/fenimore/scribouillage, driver.go.
TEST(PedalReport, HasABitForEachPedal) {
    for (std::uint8_t pressed = 0; pressed < 8; ++pressed) EXPECT_EQ(decode(Bytes{pressed, 0}), pressed);
}

TEST(PedalReport, RefusesOtherBytes) {
    for (const Bytes& bytes : {Bytes{}, Bytes{1}, Bytes{8, 0}, Bytes{1, 1}, Bytes{1, 0, 0}, Bytes{0xff, 0xff}})
        EXPECT_FALSE(decode(bytes)) << bytes.size();
}

TEST(Pedal, HasThreeButtonsAndNoAbility) {
    const hid::HidModel pedal = model();
    EXPECT_TRUE(pedal.is_one({.path = "", .vendor = 0x05f3, .product = 0x00ff}));
    EXPECT_FALSE(pedal.is_one({.path = "", .vendor = 0x05f3, .product = 0x0268}));
    EXPECT_EQ(pedal.facts({}).abilities, 0u);
    EXPECT_EQ(pedal.facts({}).button_count, 3u);
}

TEST(Pedal, HoldsAButtonInSilence) {
    const auto decoder = model().decoder();
    kerf_device_state state{};
    ASSERT_TRUE(decoder->take(Bytes{4, 0}, 0.0, state));
    EXPECT_FALSE(decoder->expire(1e3, state));
    EXPECT_EQ(state.buttons, 4u);
    EXPECT_FALSE(decoder->take(Bytes{9, 9}, 1e3, state));
    EXPECT_EQ(state.buttons, 4u);
}

}  // namespace
}  // namespace kerf::pedal
