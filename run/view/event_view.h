// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "run/view/viewed_run.h"
#include "session/recording.h"

namespace kerf::run {

/// Returns an event as a viewer shows it; nothing for one that only a replay needs.   [any] pure
[[nodiscard]] std::optional<ViewedEvent> viewed_event(const session::EventRow& event);

}  // namespace kerf::run
