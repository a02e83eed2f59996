// SPDX-License-Identifier: Apache-2.0
#include "session/packed_column.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "kerf/assert.hpp"

namespace kerf::session {
namespace {

constexpr int level = 6;
constexpr std::size_t max_bytes = 8 * max_block_rows;

std::size_t width_of(NumberFormat format) noexcept { return format == NumberFormat::float32 ? 4 : 8; }

/// Maps 0, −1, 1, −2 … to 0, 1, 2, 3 …, so that small differences of either sign have leading zeros.
template <class Bits>
Bits folded(Bits difference) noexcept {
    constexpr int sign = 8 * sizeof(Bits) - 1;
    return static_cast<Bits>((difference << 1) ^ (Bits{0} - (difference >> sign)));
}
template <class Bits>
Bits unfolded(Bits value) noexcept {
    return static_cast<Bits>((value >> 1) ^ (Bits{0} - (value & 1u)));
}

/// Returns the sum of the rows' bit widths, an estimate of the compressed size.
template <class Bits>
std::uint64_t total_width(std::span<const Bits> rows) noexcept {
    std::uint64_t sum = 0;
    for (const Bits row : rows) sum += static_cast<std::uint64_t>(std::bit_width(folded(row)));
    return sum;
}

template <class Bits>
void subtract_row_before(std::span<Bits> rows) noexcept {
    for (std::size_t i = rows.size() - 1; i > 0; --i) rows[i] = static_cast<Bits>(rows[i] - rows[i - 1]);
}

/// Replaces rows by differences as often as that makes them shorter. Returns how often.
template <class Bits>
int take_differences(std::span<Bits> rows, std::span<Bits> tried) noexcept {
    std::copy(rows.begin(), rows.end(), tried.begin());
    std::uint64_t shortest = total_width<Bits>(rows);
    int best = 0;
    for (int count = 1; count <= ColumnPacker::max_differences; ++count) {
        subtract_row_before(tried);
        const std::uint64_t width = total_width<Bits>(tried);
        if (width >= shortest) continue;
        shortest = width;
        best = count;
    }
    for (int count = 0; count < best; ++count) subtract_row_before(rows);
    return best;
}

template <class Bits>
void to_planes(std::span<const Bits> rows, unsigned char* planes) noexcept {
    for (std::size_t byte = 0; byte < sizeof(Bits); ++byte)
        for (const Bits row : rows) *planes++ = static_cast<unsigned char>(folded(row) >> (8 * byte));
}

template <class Bits>
void from_planes(const unsigned char* planes, std::span<Bits> rows) noexcept {
    std::fill(rows.begin(), rows.end(), Bits{0});
    for (std::size_t byte = 0; byte < sizeof(Bits); ++byte)
        for (Bits& row : rows) row |= static_cast<Bits>(Bits{*planes++} << (8 * byte));
    for (Bits& row : rows) row = unfolded(row);
}

std::uint32_t narrowed(std::uint64_t cell) noexcept {
    return std::bit_cast<std::uint32_t>(static_cast<float>(double_of(cell)));
}
std::uint64_t widened(std::uint32_t bits) noexcept { return to_cell(static_cast<double>(std::bit_cast<float>(bits))); }

/// Pre: `guess` has as many rows, or none.
template <class Combine>
void combine_with_guess(std::span<std::uint32_t> rows, const Guess& guess, Combine combine) noexcept {
    for (std::size_t i = 0; i < guess.like.size(); ++i) {
        const double like = static_cast<double>(static_cast<float>(double_of(guess.like[i])));
        const auto guessed = static_cast<float>(like * guess.factor);
        if (std::isfinite(guessed)) rows[i] = combine(rows[i], std::bit_cast<std::uint32_t>(guessed));
    }
}

template <class Bits>
void add_row_before(std::span<Bits> rows) noexcept {
    for (std::size_t i = 1; i < rows.size(); ++i) rows[i] = static_cast<Bits>(rows[i] + rows[i - 1]);
}

}  // namespace

std::string_view to_text(NumberFormat format) noexcept {
    switch (format) {
        case NumberFormat::none:
            return "";
        case NumberFormat::int64:
            return "int64";
        case NumberFormat::float64:
            return "float64";
        case NumberFormat::float32:
            return "float32";
    }
    return "";
}

std::uint64_t to_cell(double number) noexcept { return std::bit_cast<std::uint64_t>(number); }
std::uint64_t to_cell(std::int64_t number) noexcept { return static_cast<std::uint64_t>(number); }
double double_of(std::uint64_t cell) noexcept { return std::bit_cast<double>(cell); }
std::int64_t integer_of(std::uint64_t cell) noexcept { return static_cast<std::int64_t>(cell); }

// ---- packing -----------------------------------------------------------------------------------------------------

struct ColumnPacker::State {
    z_stream stream{};
    bool is_open = false;
    std::array<std::uint64_t, max_block_rows> rows, tried;
    std::array<std::uint32_t, max_block_rows> short_rows, short_tried;
    std::array<unsigned char, max_bytes> planes;
    std::vector<unsigned char> packed;
};

ColumnPacker::ColumnPacker() : state_(std::make_unique<State>()) {
    state_->is_open = deflateInit(&state_->stream, level) == Z_OK;
    if (state_->is_open) state_->packed.resize(deflateBound(&state_->stream, max_bytes));
}

ColumnPacker::~ColumnPacker() {
    if (state_->is_open) deflateEnd(&state_->stream);
}

ColumnPacker::Packed ColumnPacker::pack(std::span<const std::uint64_t> cells, NumberFormat format, const Guess& guess) {
    State& s = *state_;
    KERF_ASSERT(!cells.empty() && cells.size() <= max_block_rows, "pack a block at a time");
    KERF_ASSERT(guess.like.empty() || (format == NumberFormat::float32 && guess.like.size() == cells.size()),
                "guess columns of float32, row by row");
    if (!s.is_open) return {};
    Packed packed;
    if (format == NumberFormat::float32) {
        const std::span<std::uint32_t> rows = std::span(s.short_rows).first(cells.size());
        std::transform(cells.begin(), cells.end(), rows.begin(), narrowed);
        combine_with_guess(rows, guess, std::minus<std::uint32_t>());
        packed.differences = take_differences(rows, std::span(s.short_tried).first(cells.size()));
        to_planes<std::uint32_t>(rows, s.planes.data());
    } else {
        const std::span<std::uint64_t> rows = std::span(s.rows).first(cells.size());
        std::copy(cells.begin(), cells.end(), rows.begin());
        packed.differences = take_differences(rows, std::span(s.tried).first(cells.size()));
        to_planes<std::uint64_t>(rows, s.planes.data());
    }
    deflateReset(&s.stream);
    s.stream.next_in = s.planes.data();
    s.stream.avail_in = static_cast<unsigned>(width_of(format) * cells.size());
    s.stream.next_out = s.packed.data();
    s.stream.avail_out = static_cast<unsigned>(s.packed.size());
    if (deflate(&s.stream, Z_FINISH) != Z_STREAM_END) return {};
    packed.bytes = std::span(s.packed).first(s.packed.size() - s.stream.avail_out);
    return packed;
}

// ---- unpacking ---------------------------------------------------------------------------------------------------

struct ColumnUnpacker::State {
    z_stream stream{};
    bool is_open = false;
    std::array<std::uint32_t, max_block_rows> short_rows;
    std::array<unsigned char, max_bytes> planes;
};

ColumnUnpacker::ColumnUnpacker() : state_(std::make_unique<State>()) {
    state_->is_open = inflateInit(&state_->stream) == Z_OK;
}

ColumnUnpacker::~ColumnUnpacker() {
    if (state_->is_open) inflateEnd(&state_->stream);
}

bool ColumnUnpacker::unpack(std::span<const unsigned char> bytes, int differences, NumberFormat format,
                            std::span<std::uint64_t> cells, const Guess& guess) {
    State& s = *state_;
    KERF_ASSERT(guess.like.empty() || guess.like.size() == cells.size(), "guess columns row by row");
    const std::size_t size = width_of(format) * cells.size();
    const bool is_possible = s.is_open && format != NumberFormat::none && !bytes.empty() && differences >= 0 &&
                             differences <= ColumnPacker::max_differences && !cells.empty() &&
                             cells.size() <= max_block_rows && bytes.size() <= std::numeric_limits<unsigned>::max();
    if (!is_possible) return false;
    inflateReset(&s.stream);
    s.stream.next_in = const_cast<unsigned char*>(bytes.data());  // zlib's interface lacks const
    s.stream.avail_in = static_cast<unsigned>(bytes.size());
    s.stream.next_out = s.planes.data();
    s.stream.avail_out = static_cast<unsigned>(size);
    const bool is_whole =
        inflate(&s.stream, Z_FINISH) == Z_STREAM_END && s.stream.avail_in == 0 && s.stream.avail_out == 0;
    if (!is_whole) return false;
    if (format == NumberFormat::float32) {
        const std::span<std::uint32_t> rows = std::span(s.short_rows).first(cells.size());
        from_planes(s.planes.data(), rows);
        for (int count = 0; count < differences; ++count) add_row_before(rows);
        combine_with_guess(rows, guess, std::plus<std::uint32_t>());
        std::transform(rows.begin(), rows.end(), cells.begin(), widened);
    } else {
        from_planes(s.planes.data(), cells);
        for (int count = 0; count < differences; ++count) add_row_before(cells);
    }
    return true;
}

}  // namespace kerf::session
