// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::hid_force {

/// Keeps the code of this module in the process until its end, for a thread that may outlive the driver. Returns
/// whether it could.   [main]
[[nodiscard]] bool pin_module() noexcept;

}  // namespace kerf::hid_force
