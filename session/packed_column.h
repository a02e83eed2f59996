// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

namespace kerf {

/// Rows of a block; a column of it has at most 8 bytes for each before it is compressed.
inline constexpr std::size_t max_block_rows = 4096;

/// How a compressed column keeps a number, as `columns.format` names it.
enum class NumberFormat {
    none,     ///< the column is never compressed
    int64,    ///< exact
    float64,  ///< exact, with the sign of a zero and the bits of a NaN
    float32,  ///< rounded to 24 bits
};
[[nodiscard]] std::string_view to_text(NumberFormat format) noexcept;

/// A number as 64 bits: of an integer, or of a double.   [any]
[[nodiscard]] std::uint64_t to_cell(double number) noexcept;
[[nodiscard]] std::uint64_t to_cell(std::int64_t number) noexcept;
[[nodiscard]] double double_of(std::uint64_t cell) noexcept;
[[nodiscard]] std::int64_t integer_of(std::uint64_t cell) noexcept;

/// A prediction of a float32 column: another such column of the same rows, times a factor. Only the difference is kept.
/// The product is rounded to float32; where that is not finite, the guess is 0.
struct Guess {
    std::span<const std::uint64_t> like;  ///< #N numbers of the other column; empty for no guess
    double factor = 1.0;
};

/// Compresses columns of numbers, one after the other, with one zlib stream.
///
///     numbers → bits of the format, little-endian → minus the bits of the guess → `differences` times the difference
///     to the row before → 2 d, or −2 d − 1 where d is negative → byte 0 of all rows, byte 1 of all rows … → zlib
///
/// Bits are integers modulo 2^64, of float32 modulo 2^32. The same numbers give the same bytes with the same zlib.
/// [one thread at a time]
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

/// Decompresses what ColumnPacker made.   [one thread at a time]
class ColumnUnpacker {
public:
    ColumnUnpacker();
    ~ColumnUnpacker();
    ColumnUnpacker(const ColumnUnpacker&) = delete;
    ColumnUnpacker& operator=(const ColumnUnpacker&) = delete;

    /// Fills `cells`. False, and `cells` are undefined, if the bytes are not exactly that many numbers. Allocates
    /// nothing, whatever the bytes say.
    /// @param cells   #N numbers, 1 … max_block_rows
    [[nodiscard]] bool unpack(std::span<const unsigned char> bytes, int differences, NumberFormat format,
                              std::span<std::uint64_t> cells, const Guess& guess = {});

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace kerf
