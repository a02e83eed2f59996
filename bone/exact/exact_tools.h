// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bone/remesh/remesh_child.h"
#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"
#include "documents/anatomy.h"

namespace kerf::bone {

/// A running strategy.
struct ExactStrategy {
    std::string id;  ///< full id: "kerf.burring.displace"
    RemeshChild* child = nullptr;

    [[nodiscard]] bool is_whole() const noexcept { return child->scope() == KERF_REMESH_WHOLE; }
};

/// Solids, strategies and limits of exact cuts. Pre: all objects that it points to outlive it.
struct ExactTools {
    std::vector<const ToolSolid*> solids;  ///< by the records' numbers
    /// For each solid, in order of use; empty: it leaves no exact surface.
    std::vector<std::vector<ExactStrategy>> strategies;
    std::vector<std::string> why_no_more;  ///< for each solid, the reason why one more strategy could not be started;
                                           ///< part of a sentence
    std::vector<std::string> notes{};      ///< for people; included in the results
    /// The anatomy whose `mesh:` is the surface of `meshed`; null: exact cuts begin with the fields' surfaces.
    const documents::Anatomy* anatomy = nullptr;
    const Body* meshed = nullptr;
    double volume_accuracy = 0.0;  ///< [–] of the procedure: allowed relative difference of removed volumes
    double tolerance = 20e-6;      ///< [m] largest distance of a straight stretch from the recorded path
    double window = 2e-3;          ///< [m] longest stretch that is cut into a patch
    std::chrono::milliseconds limit = std::chrono::minutes(5);         ///< for a whole mesh
    std::chrono::milliseconds patch_limit = std::chrono::seconds(20);  ///< for a patch
    std::function<void(double fraction, const std::string& what)> progress{};
    std::function<bool()> is_cancelled{};  ///< called before each request

    void report(double fraction, const std::string& what) const {
        if (progress) progress(fraction, what);
    }
    [[nodiscard]] bool are_cancelled() const { return is_cancelled && is_cancelled(); }
};

}  // namespace kerf::bone
