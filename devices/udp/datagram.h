// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "kerf/device.h"
#include "siphash.h"

/// The datagrams between Kerf and a device's program, as pure functions. docs/guide/devices.md states their bytes.
namespace kerf::udp {

enum class Type : std::uint8_t { hello = 1, welcome = 2, pose = 3, force = 4, goodbye = 5 };

/// Beginning of each datagram.
struct Header {
    Type type = Type::hello;
    std::uint64_t session = 0;   ///< number that the welcome gave; 0 in a hello
    std::uint64_t sequence = 0;  ///< grows from datagram to datagram of a sender
};

/// The device's program states what it drives.
struct Hello {
    std::string name;
    kerf_device_facts facts{};
};
/// Kerf has taken the device.
struct Welcome {
    std::uint32_t period_us = 0, watchdog_ms = 0;
};
struct PoseReport {
    kerf_pose device_from_handle{};
    std::uint32_t buttons = 0;
};
struct ForceCommand {
    std::uint64_t answered = 0;  ///< sequence of the newest pose
    kerf_device_command command{};
};
struct Goodbye {};

using Content = std::variant<Hello, Welcome, PoseReport, ForceCommand, Goodbye>;

struct Datagram {
    Header header;
    Content content;
};

/// The reason why bytes cannot be read.
enum class DatagramFault { none, foreign, version, type, size, tag, value };
/// Returns a sentence for people.
[[nodiscard]] const char* text_of(DatagramFault fault) noexcept;

inline constexpr std::size_t max_size = 160;  ///< [bytes]
using Bytes = std::array<std::uint8_t, max_size>;

/// Writes a datagram, with a tag if there is a key. Returns its size [bytes].   [any] pure, nonblocking
[[nodiscard]] std::size_t encode(const Datagram& datagram, const Key* key, Bytes& bytes) noexcept;
/// Reads a datagram. With a key it must have the right tag; without one it must have none. Numbers must be finite,
/// rotations of unit length, and limits positive.   [any] pure
[[nodiscard]] std::optional<Datagram> decode(std::span<const std::uint8_t> bytes, const Key* key, DatagramFault& fault);

}  // namespace kerf::udp
