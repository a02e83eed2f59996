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

namespace kerf {

/// A strategy that runs.
struct ExactStrategy {
    std::string id;  ///< full: "kerf.burring.displace"
    RemeshChild* child = nullptr;

    [[nodiscard]] bool is_whole() const noexcept { return child->scope() == KERF_REMESH_WHOLE; }
};

/// What exact surfaces are cut with. All that it points to must outlive them.
struct ExactTools {
    std::vector<const ToolSolid*> solids;  ///< by the records' numbers
    /// Of each solid, each to replace those before it; none: it leaves no exact surface.
    std::vector<std::vector<ExactStrategy>> strategies;
    std::vector<std::string> why_no_more;  ///< of each solid: why one more could not be started; part of a sentence
    std::vector<std::string> notes{};      ///< for people; part of the results
    /// The anatomy whose `mesh:` is the surface of `meshed`; null: exact cuts begin with the surfaces of fields.
    const Anatomy* anatomy = nullptr;
    const Body* meshed = nullptr;
    double volume_accuracy = 0.0;  ///< [–] of the procedure: difference of removed volumes that is allowed
    double tolerance = 20e-6;      ///< [m] that a straight stretch may be off the recorded path
    double window = 2e-3;          ///< [m] the longest stretch that is cut into a patch
    std::chrono::milliseconds limit = std::chrono::minutes(5);         ///< for a whole mesh
    std::chrono::milliseconds patch_limit = std::chrono::seconds(20);  ///< for a patch
    std::function<void(double fraction, const std::string& what)> progress{};
    std::function<bool()> is_cancelled{};  ///< called before each request

    void report(double fraction, const std::string& what) const {
        if (progress) progress(fraction, what);
    }
    [[nodiscard]] bool are_cancelled() const { return is_cancelled && is_cancelled(); }
};

}  // namespace kerf
