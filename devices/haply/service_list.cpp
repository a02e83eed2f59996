// SPDX-License-Identifier: Apache-2.0
#include "service_list.h"

#include <exception>
#include <string>

#include "arm_session.h"
#include "kerf/device_exchange.hpp"
#include "service_text.h"
#include "web_sockets.h"

namespace kerf::haply {

namespace {

constexpr double patience = 0.5;  // [s]

/// Takes the first message, in which the service lists its devices, and sends nothing.
struct FirstMessage final : SocketUser {
    void opened() noexcept override {}
    [[nodiscard]] bool received(std::string_view message) noexcept override {
        try {
            std::string fault;
            if (const auto state = read_state(message, fault))
                for (const Arm& arm : state->arms)
                    found.push_back({.id = arm.id,
                                     .name = name_of_arm(arm.type, arm.id),
                                     .problem = arm.is_in_use ? in_use : fault_of(arm)});
        } catch (const std::exception&) {
            found.clear();  // out of memory
        }
        is_done = true;
        return false;
    }
    void closed(std::string_view /*reason*/) noexcept override { is_done = true; }

    std::vector<DeviceFound> found{};
    bool is_done = false;
};

}  // namespace

std::vector<DeviceFound> list_arms(std::uint16_t port) {
    if (!has_web_sockets()) return {};
    FirstMessage first;
    WebSockets sockets;
    sockets.connect(0, port, first);
    for (const double end = device_time() + patience; !first.is_done && device_time() < end;) sockets.serve(20);
    return first.found;
}

}  // namespace kerf::haply
