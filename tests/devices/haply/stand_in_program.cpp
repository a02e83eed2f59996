// SPDX-License-Identifier: Apache-2.0
// stand_in_program DISTANCE SPEED: a stand-in for Haply's service as a program, until its input ends. It prints its
// ports. A hand, a mass on a soft spring, pushes the handle away from the user by DISTANCE [mm] at SPEED [mm/s].
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/devices/haply/mock_service.h"

int main(int argc, char** argv) {
    using namespace kerf;
    if (argc != 3) return 2;
    const double distance = 1e-3 * std::atof(argv[1]), speed = 1e-3 * std::atof(argv[2]);
    haply::MockService service;
    std::printf("%d %d\n", service.port(), service.events_port());
    std::fflush(stdout);
    constexpr double dt = 1e-3, mass = 0.6, damping = 30.0, stiffness = 300.0;
    double aim = 0.0, at = 0.0, velocity = 0.0;
    auto next = std::chrono::steady_clock::now();
    for (pollfd input{STDIN_FILENO, POLLIN, 0}; poll(&input, 1, 0) == 0;) {
        if (service.messages() > 2000) aim = std::min(aim + speed * dt, distance);  // a run has begun
        velocity += (stiffness * (aim - at) - damping * velocity - service.force().z) / mass * dt;
        at += velocity * dt;
        service.set_handle({{0.0, 0.15, 0.12 - at}, {1, 0, 0, 0}}, 1u);
        std::this_thread::sleep_until(next += std::chrono::milliseconds(1));
    }
}
