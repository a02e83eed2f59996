// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

/// The 8³ samples that a brick owns, one bit each.
namespace kerf {

/// Sample (x, y, z) is bit 8y + x of `slice[z]`.
struct BrickBits {
    std::array<std::uint64_t, 8> slice{};

    [[nodiscard]] static constexpr BrickBits full() noexcept {
        BrickBits bits;
        bits.slice.fill(~std::uint64_t{0});
        return bits;
    }
    [[nodiscard]] constexpr bool is_empty() const noexcept {
        std::uint64_t any = 0;
        for (const std::uint64_t s : slice) any |= s;
        return any == 0;
    }
    [[nodiscard]] constexpr bool is_full() const noexcept {
        std::uint64_t all = ~std::uint64_t{0};
        for (const std::uint64_t s : slice) all &= s;
        return all == ~std::uint64_t{0};
    }
    [[nodiscard]] constexpr int count() const noexcept {
        constexpr std::uint64_t pairs = 0x5555555555555555u, fours = 0x3333333333333333u, bytes = 0x0f0f0f0f0f0f0f0fu;
        std::uint64_t sum = 0;  // one byte per row, over all slices: at most 64
        for (const std::uint64_t s : slice) {
            const std::uint64_t of_pairs = s - (s >> 1 & pairs),
                                of_fours = (of_pairs & fours) + (of_pairs >> 2 & fours);
            sum += (of_fours + (of_fours >> 4)) & bytes;
        }
        constexpr std::uint64_t four_words = 0x00ff00ff00ff00ffu, ones = 0x0001000100010001u;
        return static_cast<int>((((sum & four_words) + (sum >> 8 & four_words)) * ones) >> 48);
    }
    [[nodiscard]] constexpr bool has(int x, int y, int z) const noexcept {
        return (slice[static_cast<std::size_t>(z)] >> (8 * y + x) & 1u) != 0;
    }
    constexpr void add(int x, int y, int z) noexcept {
        slice[static_cast<std::size_t>(z)] |= std::uint64_t{1} << (8 * y + x);
    }
    [[nodiscard]] constexpr bool meets(const BrickBits& other) const noexcept {
        std::uint64_t any = 0;
        for (std::size_t z = 0; z < 8; ++z) any |= slice[z] & other.slice[z];
        return any != 0;
    }
    constexpr BrickBits& operator|=(const BrickBits& other) noexcept {
        for (std::size_t z = 0; z < 8; ++z) slice[z] |= other.slice[z];
        return *this;
    }
    /// Returns the samples that are in this set and not in the other.
    [[nodiscard]] constexpr BrickBits without(const BrickBits& other) const noexcept {
        BrickBits left;
        for (std::size_t z = 0; z < 8; ++z) left.slice[z] = slice[z] & ~other.slice[z];
        return left;
    }
    friend constexpr bool operator==(const BrickBits&, const BrickBits&) = default;
};

/// Returns whether a sample of `a` and one of `b` are neighbours. `b` belongs to the next brick along `axis`.
[[nodiscard]] constexpr bool touch_along(std::size_t axis, const BrickBits& a, const BrickBits& b) noexcept {
    constexpr std::uint64_t first_column = 0x0101010101010101u;
    if (axis == 2) return (a.slice[7] & b.slice[0]) != 0;
    std::uint64_t any = 0;
    for (std::size_t z = 0; z < 8; ++z)
        any |= axis == 0 ? (a.slice[z] >> 7) & b.slice[z] & first_column : (a.slice[z] >> 56) & b.slice[z];
    return any != 0;
}

/// Returns all samples of `among` that are connected to `grown` over faces of voxels, within `among`. Pre: `among`
/// contains `grown`.
[[nodiscard]] constexpr BrickBits grown_within(BrickBits grown, const BrickBits& among) noexcept {
    constexpr std::uint64_t first_column = 0x0101010101010101u, last_column = first_column << 7;
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        const auto grow = [&](std::size_t z) {
            std::uint64_t s = grown.slice[z];
            if (z > 0) s |= grown.slice[z - 1];
            if (z < 7) s |= grown.slice[z + 1];
            s &= among.slice[z];
            if (s == grown.slice[z]) return;  // nothing new from the slices above and below
            for (std::uint64_t last = 0; s != last;) {
                last = s;
                s |= ((s & ~last_column) << 1) | ((s & ~first_column) >> 1) | (s << 8) | (s >> 8);
                s &= among.slice[z];
            }
            grown.slice[z] = s;
            has_grown = true;
        };
        for (std::size_t z = 0; z < 8; ++z) grow(z);
        for (std::size_t z = 8; z-- > 0;) grow(z);
    }
    return grown;
}

/// Removes from `left` its first sample and all that are connected to it over faces of voxels; returns them. Pre:
/// `left` is not empty.
[[nodiscard]] constexpr BrickBits take_component(BrickBits& left) noexcept {
    constexpr std::uint64_t first_column = 0x0101010101010101u, last_column = first_column << 7;
    BrickBits component;
    for (std::size_t z = 0; z < 8; ++z)
        if (left.slice[z] != 0) {
            std::uint64_t s = left.slice[z] & (~left.slice[z] + 1);
            for (std::uint64_t last = 0; s != last;) {
                last = s;
                s |= ((s & ~last_column) << 1) | ((s & ~first_column) >> 1) | (s << 8) | (s >> 8);
                s &= left.slice[z];
            }
            component.slice[z] = s;
            break;
        }
    component = grown_within(component, left);
    left = left.without(component);
    return component;
}

}  // namespace kerf
