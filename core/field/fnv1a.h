// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace kerf {

/// 64-bit FNV-1a. It finds accidents, not forgery.
///
///     h ← (h ⊕ byte) · 1099511628211,   h₀ = 14695981039346656037
///
/// Numbers count byte by byte, least significant first, so that every machine gets the same.   [any] nonblocking.
class Fnv1a {
public:
    /// The `count` low bytes of `bits`.
    void add_bytes(std::uint64_t bits, int count) noexcept {
        for (int i = 0; i < count; ++i) {
            hash_ = (hash_ ^ (bits & 0xffu)) * 1099511628211u;
            bits >>= 8;
        }
    }
    /// The bytes alone, so that a whole text gives its published value.
    void add(std::string_view text) noexcept {
        for (const char c : text) add_bytes(static_cast<std::uint8_t>(c), 1);
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

}  // namespace kerf
