// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>
#include <sched.h>

namespace kerf {

/// Gives the calling thread of a driver a real-time priority below that of the haptic thread, if the system allows it.
inline void raise_device_thread() noexcept {
    sched_param parameters{};
    parameters.sched_priority = 48;
    static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters));
}

}  // namespace kerf
