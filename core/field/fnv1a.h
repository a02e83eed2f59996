// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace kerf {

/// 64-bit FNV-1a hash. It detects accidental changes, not forgery.
///
///     h ← (h ⊕ byte) · 1099511628211,   h₀ = 14695981039346656037
///
/// Numbers are hashed byte by byte, least significant first, with the same result on every machine.
/// [any] nonblocking.
class Fnv1a {
public:
    /// Adds the `count` low bytes of `bits`.
    void add_bytes(std::uint64_t bits, int count) noexcept {
        for (int i = 0; i < count; ++i) {
            hash_ = (hash_ ^ (bits & 0xffu)) * 1099511628211u;
            bits >>= 8;
        }
    }
    /// Adds the bytes without their count: the hash of a whole text is its published FNV-1a value.
    void add(std::string_view text) noexcept {
        for (const char c : text) add_bytes(static_cast<std::uint8_t>(c), 1);
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

}  // namespace kerf
