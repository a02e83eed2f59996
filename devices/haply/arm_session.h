// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kerf/device.h"
#include "service_text.h"

namespace kerf::haply {

/// Returns why an arm cannot be used now, and what to do; empty if it can.   [any] pure
[[nodiscard]] std::string fault_of(const Arm& arm);
/// The problem of an arm that another program drives.
inline constexpr const char* in_use =
    "another program drives the arm, and the service would add the forces of both. End that program, such as a demo of "
    "Haply Hub.";

/// The conversation with the service about one arm: which command follows which message. It knows no socket and no
/// clock. One thread calls all functions.
class ArmSession {
public:
    /// @param wanted  id of the arm; empty: the first one
    /// @param word    of a force command; nothing: it tries both
    ArmSession(std::string wanted, std::optional<ForceWord> word);

    enum class Phase : std::uint8_t {
        waits,  ///< for the first message
        tries,  ///< a small force, to learn the word of a force command
        runs,
        refused,  ///< for the reason `problem`
    };
    [[nodiscard]] Phase phase() const noexcept { return phase_; }
    /// Returns why the arm is refused or lost, and what to do; empty: it is neither.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

    /// Begins again with a new connection. The arm stays the one of the first.
    void begin() noexcept;
    /// Takes a message of the simulation channel. Returns false if it ends the connection.
    [[nodiscard]] bool take(std::string_view message);
    /// Returns the command that answers the last message.
    /// @param force  of the loop [N], frame `device`; while it runs
    [[nodiscard]] std::string command(Vec3 force);

    /// Returns the newest state; not valid while the arm is lost.
    [[nodiscard]] const kerf_device_state& state() const noexcept { return state_; }
    [[nodiscard]] bool has_grip() const noexcept { return has_grip_; }
    [[nodiscard]] const std::string& arm() const noexcept { return arm_; }
    [[nodiscard]] const std::string& type() const noexcept { return type_; }
    /// Returns whether an event is of this arm or its grip, or of the whole service.
    [[nodiscard]] bool concerns(const ServiceEvent& event) const noexcept;

private:
    [[nodiscard]] bool refuse(std::string problem);
    [[nodiscard]] bool choose(const ServiceState& message);
    [[nodiscard]] bool try_word(const Arm& arm);
    void take_state(const ServiceState& message);

    std::string wanted_;
    std::optional<ForceWord> stated_word_;
    ForceWord word_ = ForceWord::values;
    Phase phase_ = Phase::waits;
    bool must_introduce_ = false, configures_ = false, has_grip_ = false, knows_word_ = false;
    int trials_ = 0;  ///< messages that answered a trial of a word
    std::string arm_{}, type_{}, grip_{}, problem_{};
    kerf_device_state state_;
};

}  // namespace kerf::haply
