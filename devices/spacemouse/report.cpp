// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <algorithm>
#include <cstddef>

namespace kerf::spacemouse {

namespace {

enum Id : std::uint8_t { translation = 1, rotation = 2, buttons = 3, battery = 0x17 };

constexpr double range = 350.0;                                    // counts, of the descriptor; larger values occur
constexpr std::size_t half_size = 7, whole_size = 13;              // [bytes]
constexpr std::size_t min_buttons_size = 2, max_buttons_size = 7;  // [bytes]

double component(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
    const auto counts = static_cast<std::int16_t>(bytes[at] | bytes[at + 1] << 8);
    return std::clamp(counts / range, -1.0, 1.0);
}

/// Returns three numbers in the device's axes: up is against the cap's z, towards the user is its y.
Vec3 vector(std::span<const std::uint8_t> bytes, std::size_t at) noexcept {
    return {component(bytes, at), -component(bytes, at + 4), component(bytes, at + 2)};
}

}  // namespace

std::optional<Report> decode(std::span<const std::uint8_t> bytes) noexcept {
    if (bytes.size() < 2) return std::nullopt;
    switch (bytes[0]) {
        case Id::translation:
            if (bytes.size() == half_size) return Report{.translation = vector(bytes, 1)};
            if (bytes.size() == whole_size)
                return Report{.translation = vector(bytes, 1), .rotation = vector(bytes, half_size)};
            return std::nullopt;
        case Id::rotation:
            if (bytes.size() == half_size) return Report{.rotation = vector(bytes, 1)};
            return std::nullopt;
        case Id::buttons: {
            if (bytes.size() < min_buttons_size || bytes.size() > max_buttons_size) return std::nullopt;
            std::uint32_t mask = 0;
            for (std::size_t i = 1; i < std::min(bytes.size(), 1 + sizeof mask); ++i)
                mask |= static_cast<std::uint32_t>(bytes[i]) << (8 * (i - 1));
            return Report{.buttons = mask};
        }
        case Id::battery:
            return Report{};
        default:
            return std::nullopt;
    }
}

}  // namespace kerf::spacemouse
