// SPDX-License-Identifier: Apache-2.0
#include "session/packed_column.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/loop_guard.h"

namespace kerf::session {
namespace {

using Cells = std::vector<std::uint64_t>;
using Bytes = std::vector<unsigned char>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity(),
                 subnormal = std::numeric_limits<double>::denorm_min();

Cells cells_of(std::size_t count, const std::function<double(std::size_t)>& number) {
    Cells cells;
    for (std::size_t row = 0; row < count; ++row) cells.push_back(to_cell(number(row)));
    return cells;
}

struct Kept {
    int differences = 0;
    Bytes bytes;
};

Kept packed(const Cells& cells, NumberFormat format) {
    ColumnPacker packer;
    const auto [differences, bytes] = packer.pack(cells, format);
    return {differences, {bytes.begin(), bytes.end()}};
}

/// Empty where the bytes are not that many numbers.
Cells unpacked(const Kept& kept, NumberFormat format, std::size_t count) {
    ColumnUnpacker unpacker;
    Cells cells(count);
    return unpacker.unpack(kept.bytes, kept.differences, format, cells) ? cells : Cells();
}

/// Each of them in 1, 2 and 4096 rows.
std::vector<Cells> odd_columns() {
    const std::vector<std::function<double(std::size_t)>> numbers{
        [](std::size_t) { return 0.0; },
        [](std::size_t) { return -0.0; },
        [](std::size_t row) { return row % 2 == 0 ? 0.0 : -0.0; },
        [](std::size_t row) { return row % 3 == 0 ? not_a_number : 1.0; },
        [](std::size_t) { return std::bit_cast<double>(std::uint64_t{0xfff8'0000'dead'beef}); },  // a NaN of its own
        [](std::size_t row) { return row % 2 == 0 ? infinity : -infinity; },
        [](std::size_t row) { return subnormal * static_cast<double>(row); },
        [](std::size_t row) { return (row % 2 == 0 ? 1.0 : -1.0) * std::numeric_limits<double>::max(); },
        [](std::size_t) { return 0.1; },
        [](std::size_t row) { return 1e-3 * static_cast<double>(row); },
        [](std::size_t row) { return std::sin(1e-3 * static_cast<double>(row)); },
        [](std::size_t row) { return std::bit_cast<double>(0x9e37'79b9'7f4a'7c15u * (row + 1)); },  // noise
    };
    std::vector<Cells> columns;
    for (const std::size_t count : {std::size_t{1}, std::size_t{2}, max_block_rows})
        for (const auto& number : numbers) columns.push_back(cells_of(count, number));
    return columns;
}

TEST(PackedColumn, GivesBackEachBitOfADouble) {
    for (const Cells& cells : odd_columns())
        EXPECT_EQ(unpacked(packed(cells, NumberFormat::float64), NumberFormat::float64, cells.size()), cells)
            << double_of(cells[0]);
}

TEST(PackedColumn, GivesBackEachInteger) {
    for (const Cells& cells : odd_columns())  // the same bits, as integers of either sign
        EXPECT_EQ(unpacked(packed(cells, NumberFormat::int64), NumberFormat::int64, cells.size()), cells);
    EXPECT_EQ(integer_of(to_cell(std::int64_t{-7})), -7);
}

TEST(PackedColumn, RoundsToFloatWhereItMay) {
    for (const Cells& cells : odd_columns()) {
        const Cells back = unpacked(packed(cells, NumberFormat::float32), NumberFormat::float32, cells.size());
        ASSERT_EQ(back.size(), cells.size());
        for (std::size_t row = 0; row < cells.size(); ++row) {
            const double written = static_cast<double>(static_cast<float>(double_of(cells[row])));
            if (std::isnan(written))
                EXPECT_TRUE(std::isnan(double_of(back[row])));
            else
                EXPECT_EQ(back[row], to_cell(written));
        }
    }
}

TEST(PackedColumn, TakesDifferencesOfASmoothMotion) {
    const auto smooth =
        packed(cells_of(max_block_rows, [](std::size_t row) { return 0.3 + 1e-8 * static_cast<double>(row * row); }),
               NumberFormat::float64);
    EXPECT_GE(smooth.differences, 2);
    const auto still = packed(cells_of(max_block_rows, [](std::size_t) { return 0.3; }), NumberFormat::float64);
    EXPECT_EQ(still.differences, 1);
    EXPECT_LT(still.bytes.size(), 200u);
}

TEST(PackedColumn, KeepsLittleOfWhatAnotherColumnGuesses) {
    // Given a column that is another one times a factor, but for a few rows and what is not finite
    constexpr double factor = 0.06375;
    const Cells noise = cells_of(max_block_rows,
                                 [](std::size_t row) { return std::sin(1e3 * static_cast<double>(row * row)); }),
                scaled = cells_of(max_block_rows, [&](std::size_t row) {
                    return row % 1000 == 7 ? infinity : row % 1000 == 8 ? 5.0 : factor * double_of(noise[row]);
                });
    ColumnPacker packer;
    const auto [differences, bytes] = packer.pack(scaled, NumberFormat::float32, {noise, factor});
    EXPECT_LT(bytes.size(), packed(scaled, NumberFormat::float32).bytes.size() / 5);

    // Then it comes back with the other one as it was kept itself
    const Cells kept_noise = unpacked(packed(noise, NumberFormat::float32), NumberFormat::float32, noise.size());
    ColumnUnpacker unpacker;
    Cells back(scaled.size());
    ASSERT_TRUE(unpacker.unpack(bytes, differences, NumberFormat::float32, back, {kept_noise, factor}));
    EXPECT_EQ(back, unpacked(packed(scaled, NumberFormat::float32), NumberFormat::float32, scaled.size()));
}

TEST(PackedColumn, GuessesNothingWhereTheGuessIsNotFinite) {
    const std::vector<double> odd{not_a_number, infinity, -infinity, 3e38, 0.0, -0.0};
    const Cells other = cells_of(odd.size(), [&](std::size_t row) { return odd[row]; }),
                cells = cells_of(odd.size(), [](std::size_t row) { return 0.5 * static_cast<double>(row); });
    for (const double factor : {100.0, infinity, not_a_number, 0.0}) {
        ColumnPacker packer;
        ColumnUnpacker unpacker;
        const auto [differences, bytes] = packer.pack(cells, NumberFormat::float32, {other, factor});
        Cells back(cells.size());
        ASSERT_TRUE(unpacker.unpack(bytes, differences, NumberFormat::float32, back, {other, factor}));
        EXPECT_EQ(back, cells) << factor;
    }
}

TEST(PackedColumn, GivesTheSameBytesAgain) {
    // Given a packer that has packed something else before
    const Cells first = cells_of(max_block_rows, [](std::size_t row) { return std::sin(static_cast<double>(row)); }),
                second = cells_of(100, [](std::size_t row) { return std::cos(static_cast<double>(row)); });
    ColumnPacker packer;
    (void)packer.pack(first, NumberFormat::float32);
    const auto [differences, bytes] = packer.pack(second, NumberFormat::float64);

    const Kept fresh = packed(second, NumberFormat::float64);
    EXPECT_EQ(differences, fresh.differences);
    EXPECT_EQ(Bytes(bytes.begin(), bytes.end()), fresh.bytes);
}

TEST(PackedColumn, RefusesBytesThatAreNotThatManyNumbers) {
    const Cells cells = cells_of(100, [](std::size_t row) { return std::sin(static_cast<double>(row)); });
    const Kept sound = packed(cells, NumberFormat::float64);
    const auto refuses = [&](const Kept& kept, std::size_t count, NumberFormat format = NumberFormat::float64) {
        return unpacked(kept, format, count).empty();
    };
    ASSERT_FALSE(refuses(sound, 100));

    // Another length than they have
    EXPECT_TRUE(refuses(sound, 99));
    EXPECT_TRUE(refuses(sound, 101));
    EXPECT_TRUE(refuses(sound, max_block_rows));
    EXPECT_TRUE(refuses(sound, 100, NumberFormat::float32));
    EXPECT_TRUE(refuses(sound, 100, NumberFormat::none));
    EXPECT_TRUE(refuses(sound, max_block_rows + 1));
    ColumnUnpacker unpacker;
    EXPECT_FALSE(unpacker.unpack(sound.bytes, sound.differences, NumberFormat::float64, {}));

    // Cut short at each byte, with bytes behind the end, with one byte changed
    for (std::size_t length = 0; length < sound.bytes.size(); ++length)
        EXPECT_TRUE(refuses(
            {sound.differences, {sound.bytes.begin(), sound.bytes.begin() + static_cast<std::ptrdiff_t>(length)}}, 100))
            << length;
    Kept longer = sound;
    longer.bytes.push_back(0);
    EXPECT_TRUE(refuses(longer, 100));
    for (std::size_t at = 0; at < sound.bytes.size(); ++at) {
        Kept changed = sound;
        changed.bytes[at] ^= 0x10u;
        // zlib's check sum finds whatever still unpacks; a bit that fills up the last byte is none of a number
        const Cells back = unpacked(changed, NumberFormat::float64, 100);
        EXPECT_TRUE(back.empty() || back == cells) << at;
    }

    // Differences that no packer takes
    for (const int differences : {-1, ColumnPacker::max_differences + 1, 1'000'000})
        EXPECT_TRUE(refuses({differences, sound.bytes}, 100)) << differences;
}

TEST(PackedColumn, UnpacksWithoutAllocating) {
    const Cells cells = cells_of(max_block_rows, [](std::size_t) { return 0.0; });
    const Kept kept = packed(cells, NumberFormat::float64);
    ColumnUnpacker unpacker;
    Cells few(10), all(max_block_rows);
    (void)unpacker.unpack(kept.bytes, kept.differences, NumberFormat::float64, few);  // zlib's window, once

    const std::size_t before = test::allocations_here();
    const bool is_few = unpacker.unpack(kept.bytes, kept.differences, NumberFormat::float64, few);
    const bool is_all = unpacker.unpack(kept.bytes, kept.differences, NumberFormat::float64, all);
    EXPECT_EQ(test::allocations_here(), before);
    EXPECT_FALSE(is_few);
    EXPECT_TRUE(is_all);
}

}  // namespace
}  // namespace kerf::session
