// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/field/fnv1a.h"
#include "session/recording.h"

namespace kerf::session {

/// A 64-bit hash of a run: FNV-1a over the bytes of each value. Two runs that agree bit for bit have the same hash on
/// every machine.   [any]
class ContentHash {
public:
    void add(std::uint8_t value) noexcept { add_bytes(value, 1); }
    void add(std::int16_t value) noexcept { add_bytes(static_cast<std::uint16_t>(value), 2); }
    void add(std::uint32_t value) noexcept { add_bytes(value, 4); }
    void add(std::int32_t value) noexcept { add_bytes(static_cast<std::uint32_t>(value), 4); }
    void add(std::uint64_t value) noexcept { add_bytes(value, 8); }
    void add(std::int64_t value) noexcept { add_bytes(static_cast<std::uint64_t>(value), 8); }
    void add(float value) noexcept {
        add_bytes(std::isnan(value) ? 0x7fc00000u : std::bit_cast<std::uint32_t>(value), 4);
    }
    /// Adds the bits of a number. −0 and 0 differ, since a replay must not confuse them. All NaN are equal.
    void add(double value) noexcept {
        add_bytes(std::isnan(value) ? 0x7ff8000000000000u : std::bit_cast<std::uint64_t>(value), 8);
    }
    /// Adds the bytes alone, without a length, so that a whole text gives its published FNV-1a value.
    void add(std::string_view text) noexcept { hash_.add(text); }
    void add(Vec3 v) noexcept {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(const Pose& pose) noexcept {
        add(pose.position);
        add(pose.rotation.w);
        add(Vec3{pose.rotation.x, pose.rotation.y, pose.rotation.z});
    }
    void add(const Vec6& v) noexcept {
        for (const double component : v) add(component);
    }

    [[nodiscard]] std::uint64_t value() const noexcept { return hash_.value(); }

private:
    void add_bytes(std::uint64_t bits, int count) noexcept { hash_.add_bytes(bits, count); }

    Fnv1a hash_;
};

/// Adds the loop's input and output of a tick: handle pose, tool pose, wrench on the tool and on the hand. Leaves out
/// values that follow from these or from the conditions (limits, device newtons).
inline void add_tick(ContentHash& hash, const TickRow& row) noexcept {
    hash.add(row.tick);
    hash.add(row.step);
    hash.add(row.device_from_handle);
    hash.add(row.world_from_tool);
    hash.add(row.modelled);
    hash.add(row.coupled);
}

/// Adds tick and id of an event. The text of `detail` may change between versions.
inline void add_event(ContentHash& hash, const EventRow& event) noexcept {
    hash.add(event.tick);
    hash.add(static_cast<std::uint64_t>(event.id.size()));
    hash.add(std::string_view(event.id));
}

/// Returns FNV-1a of a document's bytes.
[[nodiscard]] inline std::uint64_t hash_of_text(std::string_view text) noexcept {
    Fnv1a hash;
    hash.add(text);
    return hash.value();
}

/// Returns a hash as sixteen hexadecimal digits, as files contain it.
[[nodiscard]] inline std::string hex16(std::uint64_t value) {
    std::string digits(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 0xfu];
    return digits;
}

}  // namespace kerf::session
