// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/remesh.h"

/// The protocol of `kerf` and `kerf-remesh`: one packet each over a socket pair; meshes lie in shared memory.
namespace kerf::bone::remesh_channel {

/// The initial file descriptors of the child.
inline constexpr int socket_fd = 3, request_fd = 4, result_fd = 5;

/// The child's first packet.
struct Hello {
    std::uint32_t scope = 0;  ///< KERF_REMESH_PATCH or KERF_REMESH_WHOLE; 0: it cannot work
    char fault[500] = {};     ///< the reason in that case; ends with NUL
    std::uint32_t parameter_count = 0;
    double defaults[256] = {};  ///< of the strategy's parameters
    char plugin_id[100] = {}, plugin_version[100] = {}, kernel[200] = {};
};

struct RequestPacket {
    std::uint64_t number = 0;
    std::uint64_t request_capacity = 0, result_capacity = 0;  ///< [bytes] of the shared memory
    std::uint64_t request_used = 0;
    kerf_remesh_in in{};
};

struct ResultPacket {
    std::uint64_t number = 0;
    std::int32_t status = KERF_FAILED;
    kerf_remesh_out out{};
};

}  // namespace kerf::bone::remesh_channel
