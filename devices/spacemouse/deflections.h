// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "devices/hid/report_decoder.h"

namespace kerf::spacemouse {

/// The deflection of the cap, from reports of which each states a part. Half a pair is normal, in either order.
///
/// A deflected cap sends all the time. So a deflection that is not repeated for 100 ms counts as zero: a report was
/// lost, and the tool must stop.
class Deflections final : public hid::ReportDecoder {
public:
    [[nodiscard]] bool take(std::span<const std::uint8_t> report, double now,
                            kerf_device_state& state) noexcept override;
    [[nodiscard]] bool expire(double now, kerf_device_state& state) noexcept override;

private:
    double translated_ = 0.0, rotated_ = 0.0;  ///< [s] times of the newest reports of each half
};

}  // namespace kerf::spacemouse
