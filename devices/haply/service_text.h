// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kerf/device.h"
#include "kerf/math.hpp"

/// Messages of Haply's Inverse Service, formats 3.1 to 3.5, as text and back. All functions are pure.   [any]
///
/// Source: docs.haply.co, "Simulation Channel" of 3.1 and "WebSocket Protocol" and "Events" of 3.5. Its frame has +x to
/// the right, +y away from the user and +z up; positions here are in Kerf's frame `device`.
namespace kerf::haply {

inline constexpr std::size_t max_message = 1u << 18;  ///< [bytes] a longer message is none of the service

/// An arm, an Inverse3 or Minverse, in a message.
struct Arm {
    std::string id{};
    std::string type{};              ///< "inverse3", "minverse"; only in the first message
    std::optional<Vec3> position{};  ///< [m] of its cursor; nothing: none of numbers
    std::optional<Vec3> force{};     ///< [N] that it makes; nothing before 3.5
    bool is_calibrated = true, is_in_use = false, is_ready = true, has_power = true;  ///< if the message states it
};

/// Returns the name of an arm, for people.
[[nodiscard]] std::string name_of_arm(std::string_view type, const std::string& id);

/// A grip with an orientation, wired or wireless.
struct Grip {
    std::string id{};
    std::optional<Quat> rotation{};  ///< frame `device`, unit
    std::uint32_t buttons = 0;       ///< bit 0: a, or the only one; 1: b; 2: c
};

/// One message of the simulation channel: the state of all devices.
struct ServiceState {
    bool has_session = false;  ///< it names a session: 3.5
    std::vector<Arm> arms{};
    std::vector<Grip> grips{};

    [[nodiscard]] const Arm* arm(std::string_view id) const noexcept;
    [[nodiscard]] const Grip* grip(std::string_view id) const noexcept;
};

/// Returns a message, or nothing with the reason in `fault` if it is none of the service.
[[nodiscard]] std::optional<ServiceState> read_state(std::string_view text, std::string& fault);

/// The word of a force command: `vector` by the pages of 3.5, `values` by those of 3.1 and by all public programs.
enum class ForceWord : std::uint8_t { values, vector };

/// Returns the command that makes a force [N], frame `device`, for one period of the service.
[[nodiscard]] std::string force_command(std::string_view arm, ForceWord word, Vec3 force);

/// Returns the first command of a session. It names Kerf, and sets what another program may have changed: origin, axes
/// and damping of the arm.
/// @param configures  the service knows these words: 3.5
[[nodiscard]] std::string first_command(std::string_view arm, ForceWord word, bool configures);

/// An event of the service that people should know.
struct ServiceEvent {
    std::string name{};    ///< "device-busy"
    std::string device{};  ///< id; may be empty
    std::string safety{};  ///< of "device-safety-triggered": "ebrake_triggered"
};

/// Returns an event, or nothing if the text is none.
[[nodiscard]] std::optional<ServiceEvent> read_event(std::string_view text);
/// Returns what an event of the open arm means for its user, and what to do; empty if nothing is wrong.
[[nodiscard]] std::string problem_of(const ServiceEvent& event);

}  // namespace kerf::haply
