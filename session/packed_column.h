// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace kerf::session {

/// Rows of a block. A column has at most 8 bytes per row before compression.
inline constexpr std::size_t max_block_rows = 4096;

/// Storage format of a compressed column's numbers, as named in `columns.format`.
enum class NumberFormat {
    none,     ///< the column is never compressed
    int64,    ///< exact
    float64,  ///< exact, including the sign of a zero and the bits of a NaN
    float32,  ///< rounded to 24 bits
};
[[nodiscard]] std::string_view to_text(NumberFormat format) noexcept;

/// Converts numbers to and from 64 bits: the bits of an integer or of a double.   [any]
[[nodiscard]] std::uint64_t to_cell(double number) noexcept;
[[nodiscard]] std::uint64_t to_cell(std::int64_t number) noexcept;
[[nodiscard]] double double_of(std::uint64_t cell) noexcept;
[[nodiscard]] std::int64_t integer_of(std::uint64_t cell) noexcept;

/// A prediction of a float32 column: another float32 column of the same rows, times a factor. Only the difference is
/// stored. The product is rounded to float32; the prediction is 0 where that is not finite.
struct Guess {
    std::span<const std::uint64_t> like;  ///< #N numbers of the other column; empty: no prediction
    double factor = 1.0;
};

/// Compresses columns of numbers one after the other, with one zlib stream.
///
///     numbers → bits of the format, little-endian → minus the bits of the guess → `differences` times the difference
///     to the row before → 2 d, or −2 d − 1 where d is negative → byte 0 of all rows, byte 1 of all rows … → zlib
///
/// Bits are integers modulo 2^64, or 2^32 for float32. Equal numbers give equal bytes with the same version
/// of zlib. [one thread at a time]
class ColumnPacker {
public:
    ColumnPacker();
    ~ColumnPacker();
    ColumnPacker(const ColumnPacker&) = delete;
    ColumnPacker& operator=(const ColumnPacker&) = delete;

    struct Packed {
        int differences = 0;                   ///< 0 … max_differences
        std::span<const unsigned char> bytes;  ///< until the next call; empty if zlib has no memory
    };
    static constexpr int max_differences = 3;

    /// @param cells   #N numbers, 1 … max_block_rows
    [[nodiscard]] Packed pack(std::span<const std::uint64_t> cells, NumberFormat format, const Guess& guess = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Decompresses columns of ColumnPacker.   [one thread at a time]
class ColumnUnpacker {
public:
    ColumnUnpacker();
    ~ColumnUnpacker();
    ColumnUnpacker(const ColumnUnpacker&) = delete;
    ColumnUnpacker& operator=(const ColumnUnpacker&) = delete;

    /// Fills `cells`. Returns false, with `cells` undefined, if the bytes do not contain exactly that many numbers.
    /// Allocates nothing, whatever the bytes are.
    /// @param cells   #N numbers, 1 … max_block_rows
    [[nodiscard]] bool unpack(std::span<const unsigned char> bytes, int differences, NumberFormat format,
                              std::span<std::uint64_t> cells, const Guess& guess = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace kerf::session
