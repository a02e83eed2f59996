// SPDX-License-Identifier: Apache-2.0
// The first byte is k for a datagram with the tag of a key, else for one without.
#include "devices/udp/datagram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "tests/fuzz/fuzz_target.h"

bool kerf::fuzz::reads(std::string_view input) {
    if (input.empty()) return false;
    const udp::Key some_key{1, 2, 3};
    const udp::Key* const key = input[0] == 'k' ? &some_key : nullptr;
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(input.data()) + 1, input.size() - 1);
    udp::DatagramFault fault{};
    const auto datagram = udp::decode(bytes, key, fault);
    require(datagram.has_value() == (fault == udp::DatagramFault::none), "a fault has a reason");
    require(datagram.has_value() || *udp::text_of(fault) != '\0', "a reason has a text");
    if (!datagram) return false;
    udp::Bytes again{};
    require(udp::encode(*datagram, key, again) == bytes.size(), "it has the size of its type");
    const auto second = udp::decode({again.data(), bytes.size()}, key, fault);
    require(second.has_value() && second->content.index() == datagram->content.index(), "what was read can be written");
    if (const auto* pose = std::get_if<udp::PoseReport>(&datagram->content)) {
        const kerf_quat& q = pose->device_from_handle.rotation;
        require(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) < 1e-3, "a rotation is of unit length");
        require(std::isfinite(pose->device_from_handle.position.x), "a position is a number");
    }
    if (const auto* hello = std::get_if<udp::Hello>(&datagram->content))
        require(hello->facts.resolution > 0.0 && hello->facts.button_count <= 32, "a device has limits that can be");
    return true;
}
