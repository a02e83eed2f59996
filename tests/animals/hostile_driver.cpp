// SPDX-License-Identifier: Apache-2.0
// A driver of a stylus that stays where it is, with one fault, `kerf_how`, which each library brings along. A fault of
// its reports comes 0.3 s after it was opened, when some of a run is recorded. "is_a_knob" is a sound knob on a spring.
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <kerf/device_driver.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/animals/hostile.h"

namespace {

using namespace kerf;
using hostile::does;

void misbehave(std::string_view place) {
    if (does("crashes", place)) *reinterpret_cast<volatile int*>(static_cast<std::uintptr_t>(hostile::sink + 16)) = 1;
    if (does("aborts", place)) std::abort();
    if (does("exits", place)) std::exit(0);
    if (does("throws", place)) throw std::runtime_error("not today");
    if (does("sleeps", place))
        for (;;) sleep(1000);
}

class Stylus final : public DeviceLink {
public:
    ~Stylus() override { misbehave("close"); }
    [[nodiscard]] kerf_device_facts facts() const override {
        kerf_device_facts facts{};
        if (is_knob) {
            facts.abilities = KERF_DEVICE_TURN | KERF_DEVICE_TURN_TORQUE;
            facts.peak_turn_torque = 1.0;
            facts.continuous_turn_torque = 0.5;
            facts.turn_resolution = 1e-3;
            return facts;
        }
        facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_ROTATION | KERF_DEVICE_FORCE;
        facts.button_count = 1;
        facts.peak_force = 3.0;
        facts.continuous_force = 1.0;
        facts.largest_stiffness = 500.0;
        facts.largest_damping = 2.0;
        facts.mass = 0.05;
        facts.resolution = 1e-5;
        return facts;
    }
    [[nodiscard]] kerf_device_state read() noexcept override {
        if (++reads_ > 300) misbehave("read");
        kerf_device_state state{};
        state.device_from_handle.rotation.w = 1.0;
        state.flags = KERF_DEVICE_VALID;
        state.turn = is_knob ? turn_ : 0.0;
        return state;
    }
    void write(const kerf_device_command& command) noexcept override {
        turn_ = (hostile::is("is_a_reversed_knob") ? -2.0 : 2.0) * command.turn_torque;
        if (reads_ > 300) misbehave("write");
    }
    [[nodiscard]] std::string problem() override {
        misbehave("problem");
        return {};
    }

private:
    static inline const bool is_knob = hostile::is("is_a_knob") || hostile::is("is_a_reversed_knob");
    int reads_ = 0;
    double turn_ = 0.0;  ///< [rad]
};

struct StillStylus {
    static constexpr auto about() { return describe("still", "A stylus that stays where it is."); }
    [[nodiscard]] std::vector<DeviceFound> find() const {
        misbehave("find");
        return {{.id = "one", .name = "the stylus", .problem = ""}};
    }
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& /*request*/) const {
        misbehave("open");
        return std::make_unique<Stylus>();
    }
};

}  // namespace

KERF_PLUGIN("test.driver", "0.1.0", "Apache-2.0", StillStylus)
