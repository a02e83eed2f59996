// SPDX-License-Identifier: Apache-2.0
#include "conformance/device_reports.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

#include "conformance/words.h"
#include "core/haptics/loop/device_report.h"
#include "core/haptics/loop/stated_device.h"
#include "core/plugin/plain_text.h"
#include "kerf/device_buttons.hpp"

namespace kerf::conformance {

namespace {

constexpr std::uint32_t known_abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE |
                                          KERF_DEVICE_TORQUE | KERF_DEVICE_DEFLECTION | KERF_DEVICE_TURN |
                                          KERF_DEVICE_TURN_TORQUE | KERF_DEVICE_MODELLED;
constexpr std::uint32_t known_flags = KERF_DEVICE_VALID;

/// A limit that a device states, and the ability that has it.
struct Limit {
    const char* name;
    double kerf_device_facts::*member;
    std::uint32_t ability;
    const char* ability_name;
};
constexpr Limit limits[] = {
    {"peak_force", &kerf_device_facts::peak_force, KERF_DEVICE_FORCE, "KERF_DEVICE_FORCE"},
    {"continuous_force", &kerf_device_facts::continuous_force, KERF_DEVICE_FORCE, "KERF_DEVICE_FORCE"},
    {"peak_torque", &kerf_device_facts::peak_torque, KERF_DEVICE_TORQUE, "KERF_DEVICE_TORQUE"},
    {"continuous_torque", &kerf_device_facts::continuous_torque, KERF_DEVICE_TORQUE, "KERF_DEVICE_TORQUE"},
    {"peak_turn_torque", &kerf_device_facts::peak_turn_torque, KERF_DEVICE_TURN_TORQUE, "KERF_DEVICE_TURN_TORQUE"},
    {"continuous_turn_torque", &kerf_device_facts::continuous_turn_torque, KERF_DEVICE_TURN_TORQUE,
     "KERF_DEVICE_TURN_TORQUE"},
    {"turn_resolution", &kerf_device_facts::turn_resolution, KERF_DEVICE_TURN, "KERF_DEVICE_TURN"},
};

bool has(const kerf_device_facts& facts, std::uint32_t ability) noexcept { return (facts.abilities & ability) != 0; }

std::string fault_of_pose(const kerf_device_facts& facts, const Pose& pose) {
    if (!is_usable(pose))
        return "`device_from_handle` has the position " + number(pose.position.x) + ", " + number(pose.position.y) +
               ", " + number(pose.position.z) + " m and the rotation " + number(pose.rotation.w) + ", " +
               number(pose.rotation.x) + ", " + number(pose.rotation.y) + ", " + number(pose.rotation.z) +
               ", expected a position within " + number(max_handle_distance) +
               " m and a unit quaternion. Clear KERF_DEVICE_VALID while there is no such pose.";
    const Quat& q = pose.rotation;
    if (!has(facts, KERF_DEVICE_ROTATION) && (std::abs(q.w) != 1.0 || q.x != 0.0 || q.y != 0.0 || q.z != 0.0))
        return "`device_from_handle` is turned, but the device states no KERF_DEVICE_ROTATION. Report the rotation "
               "1, 0, 0, 0, or state the ability.";
    return {};
}

std::string fault_of_deflection(const kerf_device_facts& facts, const double (&deflection)[6]) {
    for (std::size_t i = 0; i < std::size(deflection); ++i) {
        const std::string name = "`deflection[" + std::to_string(i) + "]` is " + number(deflection[i]);
        if (!has(facts, KERF_DEVICE_DEFLECTION) && deflection[i] != 0.0)
            return name + ", expected 0 without KERF_DEVICE_DEFLECTION. Clear it, or state the ability.";
        if (!(std::abs(deflection[i]) <= 1.0))
            return name + ", expected -1 to 1. Divide by the device's range and clamp.";
    }
    return {};
}

}  // namespace

std::string fault_of_text(const char* text, std::size_t size) {
    const auto* const end = static_cast<const char*>(std::memchr(text, 0, size));
    if (end == nullptr)
        return "does not end with NUL within its " + std::to_string(size) + " bytes. Cut it at a character.";
    const std::string_view words(text, static_cast<std::size_t>(end - text));
    if (!is_utf8(words) || !is_plain(words))
        return "is " + quoted_plain(words) +
               ", expected UTF-8 without control characters. Escape what the device sends.";
    return {};
}

std::string fault_of_id(std::string_view id) {
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == '.';
    };
    if (!id.empty() && std::all_of(id.begin(), id.end(), is_allowed)) return {};
    return "is " + quoted_plain(id) +
           ", expected one or more of a-z, A-Z, 0-9, `_`, `-`, `.`: a station names the device by it. Replace others.";
}

std::string fault_of_statement(const kerf_device_facts& facts) {
    if (const std::string fault = fault_of_text(facts.name); !fault.empty()) return "its `name` " + fault;
    if (const std::uint32_t unknown = facts.abilities & ~known_abilities; unknown != 0)
        return "`abilities` has the unknown bits " + std::to_string(unknown) + ". Set only those of KERF_DEVICE_….";
    for (const Limit& limit : limits)
        if (!has(facts, limit.ability) && facts.*limit.member != 0.0)
            return std::string("`") + limit.name + "` is " + number(facts.*limit.member) + ", expected 0 without " +
                   limit.ability_name + ". Clear it, or state the ability.";
    const std::string fault = fault_of_facts(facts);
    return fault.empty() ? fault : "the host refuses it: " + fault + ".";
}

std::string fault_of_report(const kerf_device_facts& facts, const kerf_device_state& state) {
    if ((state.flags & ~known_flags) != 0)
        return "`flags` is " + std::to_string(state.flags) + ", expected 0 or KERF_DEVICE_VALID.";
    if (!std::isfinite(state.age) || state.age < 0.0)
        return "`age` is " + number(state.age) + " s, expected 0 or more. Take both times from one steady clock.";
    if ((state.flags & KERF_DEVICE_VALID) == 0) return {};
    if (has(facts, KERF_DEVICE_POSITION))
        if (std::string fault = fault_of_pose(facts, state.device_from_handle); !fault.empty()) return fault;
    if (std::string fault = fault_of_deflection(facts, state.deflection); !fault.empty()) return fault;
    if (!has(facts, KERF_DEVICE_TURN) && state.turn != 0.0)
        return "`turn` is " + number(state.turn) +
               " rad, expected 0 without KERF_DEVICE_TURN. Clear it, or state the ability.";
    if (!std::isfinite(state.turn)) return "`turn` is " + number(state.turn) + " rad, expected a number.";
    if ((state.buttons & ~button_bits(facts.button_count)) != 0)
        return "`buttons` is " + std::to_string(state.buttons) + ", but the device states " +
               std::to_string(facts.button_count) + " buttons. Clear the other bits, or state more.";
    return {};
}

}  // namespace kerf::conformance
