// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace kerf::text {

/// SHA-256 of FIPS 180-4: a digest that two different files do not have in common.   [any]
class Sha256 {
public:
    void add(std::span<const unsigned char> bytes) noexcept;
    void add(std::string_view text) noexcept;
    /// Returns the digest as 64 hexadecimal digits. Call it once, after the last `add`.
    [[nodiscard]] std::string finish();

private:
    static constexpr std::size_t block_size = 64;
    void add_block(const unsigned char* block) noexcept;

    std::array<std::uint32_t, 8> state_{0x6a09e667u, 0xbb67ae85u, 0x3c6ef372u, 0xa54ff53au,
                                        0x510e527fu, 0x9b05688cu, 0x1f83d9abu, 0x5be0cd19u};
    std::array<unsigned char, block_size> partial_{};
    std::size_t partial_size_ = 0;
    std::uint64_t size_ = 0;  ///< bytes added so far
};

/// Returns the digest of a text as 64 hexadecimal digits.   [any]
[[nodiscard]] std::string sha256_of(std::string_view text);

/// Returns whether a text is a digest as `Sha256::finish` writes it.   [any]
[[nodiscard]] bool is_sha256(std::string_view text) noexcept;

}  // namespace kerf::text
