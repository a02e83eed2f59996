// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bone/remesh/cut_path.h"
#include "bone/remesh/tagged_mesh.h"
#include "kerf/remesh.h"

/// Requests to a remeshing strategy and its results, as plain values.
namespace kerf::bone {

struct RemeshRequest {
    TaggedMesh base;
    std::vector<std::uint8_t> locked{};  ///< #vertices, 1: must be in the result bit for bit; empty: none
    std::vector<CutStretch> cuts;        ///< `solid` is an index into `solids`
    std::vector<const ToolSolid*> solids;
    std::uint32_t mode = KERF_REMESH_FINAL;
    std::uint64_t nudge_seed = 0;
    double tolerance = 10e-6;  ///< [m]
};

struct RemeshResult {
    kerf_status status = KERF_FAILED;  ///< KERF_OK, KERF_FAILED or KERF_REMESH_…
    TaggedMesh mesh{};                 ///< with KERF_OK
    Vec3 want_low{}, want_high{};      ///< with KERF_REMESH_NEED_REGION
    std::string message{};             ///< reason of a failure, for people
};

/// Returns the approximate size of a request in an arena [bytes], and a generous bound for its result.   [any]
[[nodiscard]] std::uint64_t request_bytes(const RemeshRequest& request);
[[nodiscard]] std::uint64_t result_bytes(const RemeshRequest& request);

/// Writes a request into an arena. Returns false if the arena is too small.   [any]
/// @param parameters  of the strategy, SI, declared order
[[nodiscard]] bool pack(const RemeshRequest& request, const std::vector<double>& parameters, kerf_arena& arena,
                        kerf_remesh_in& in);

/// Reads a strategy's result without trusting it. An offset outside the arena, a vertex that does not exist, a
/// coordinate that is not finite and an unknown status become KERF_FAILED with a message.   [any]
[[nodiscard]] RemeshResult unpack(kerf_status status, const kerf_remesh_out& out, const kerf_arena& arena);

}  // namespace kerf::bone
