// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/replay.h"
#include "documents/station.h"
#include "kerf/device_driver.hpp"
#include "run/clock/tick_clock.h"
#include "run/device/opened_device.h"
#include "run/run_procedure.h"
#include "session/read_session.h"
#include "tests/support/drill_rig.h"

/// Runs with devices that a test makes, through the table of a driver, on a virtual clock.
namespace kerf::run {

/// A driver without parameters; the tests make its links.
struct Double {
    static constexpr auto about() { return describe("double", "A device of a test."); }
    [[nodiscard]] std::vector<DeviceFound> find() const { return {}; }
    [[nodiscard]] std::unique_ptr<DeviceLink> open(const DeviceRequest& /*request*/) const { return nullptr; }
};

inline std::unique_ptr<OpenedDevice> opened(std::unique_ptr<DeviceLink> link) {
    kerf_device_open_out out{};
    out.facts = link->facts();
    out.device = static_cast<DeviceLink*>(link.release());
    std::string error;
    auto device = OpenedDevice::take(PluginTables<Double>::components[0], out, "double", error);
    EXPECT_EQ(error, "");
    return device;
}

/// A clock that misses no period.
class SteadyClock final : public TickClock {
public:
    [[nodiscard]] std::uint32_t wait() noexcept override { return 0; }
};

/// The axes of the device are those of the patient.
inline documents::DeviceStation station_in_world() { return {.device = "double", .right = {1, 0, 0}, .up = {0, 1, 0}}; }

/// Returns the inputs that the run recorded in this folder.
inline session::RecordedInputs inputs_in(const std::string& folder) {
    std::string error;
    const auto inputs = session::read_session(folder + "/session.db", error);
    EXPECT_TRUE(inputs) << error;
    return inputs.value_or(session::RecordedInputs{});
}

inline RunOutcome replayed(const Scene& scene, const session::RecordedInputs& inputs) {
    RunRequest again;
    EXPECT_EQ(app::repeat(inputs, "session.db", again), "");
    return run_procedure(scene, test::plugins(), again);
}

}  // namespace kerf::run
