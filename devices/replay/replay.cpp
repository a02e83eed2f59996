// SPDX-License-Identifier: Apache-2.0
#include "replay.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include "devices/motion/modelled_handle.h"
#include "devices/motion/motion_file.h"

namespace kerf::replay {

namespace {

class Link final : public DeviceLink {
public:
    explicit Link(motion::Motion motion) : motion_(std::move(motion)) {}

    [[nodiscard]] kerf_device_facts facts() const override {
        return motion::facts_of_handle("recorded handle", motion_.button_count());
    }
    [[nodiscard]] kerf_device_state read() noexcept override {
        if (is_running_) ++millisecond_;
        const motion::MotionRow row = motion_.at(millisecond_);
        return motion::report_of(row.device_from_handle, row.buttons, ++reports_);
    }
    void write(const kerf_device_command& command) noexcept override {
        is_running_ = is_running_ || (command.flags & KERF_DEVICE_RUNNING) != 0;
    }

private:
    motion::Motion motion_;
    std::uint64_t millisecond_ = 0, reports_ = 0;
    bool is_running_ = false;
};

}  // namespace

std::unique_ptr<DeviceLink> Replay::open(const DeviceRequest& request) const {
    motion::require_no_id(request, "replay");
    std::optional<motion::Motion> motion = motion::motion_of(request);
    if (!motion)
        throw std::runtime_error("it has no motion. Write `motion: FILE` under `device: replay` in the station; `kerf "
                                 "devices test ID --record FILE` writes such a file.");
    return std::make_unique<Link>(*std::move(motion));
}

}  // namespace kerf::replay
