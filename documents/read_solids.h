// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "documents/anatomy.h"
#include "documents/yaml/read_map.h"
#include "text/codes.h"

namespace kerf::documents {

/// Reads `from` and `to`, the ends of a tube, hole or axis. Reports ends that coincide.   [main]
template <class Ends>
void read_ends(MapReader& map, Ends& ends, const std::string& name) {
    constexpr double shortest = 1e-6;  // [m] a shorter length has no direction
    const auto from = map.vector("from");
    const auto to = map.vector("to");
    if (!from || !to) return;
    ends.from = *from;
    ends.to = *to;
    if (length(*to - *from) < shortest)
        map.report().error(text::Code::degenerate, map.span(),
                           name + " has no length: both ends are the same point. Move one of them.");
}

/// Reads `tube:`.   [main]
[[nodiscard]] TubeSolid read_tube(const Node& node, const std::string& name, Report& report);

/// Reads a solid of the kind that the key of `node` names.   [main]
[[nodiscard]] Solid read_solid(const Node& node, const std::string& name, Report& report);

/// Reads a list of solids, as of a tissue.   [main]
[[nodiscard]] std::vector<Solid> read_solids(const Node& node, const std::string& name, Report& report);

/// Returns the id of the mirror image of a part.
[[nodiscard]] inline std::string mirrored_id(const std::string& id) { return id + "_mirrored"; }

/// Reads the solids that a phantom or an implant is made of. `where` is their name in messages.   [main]
[[nodiscard]] std::vector<PhantomPart> read_parts(const Node& node, const std::string& where, Report& report);

}  // namespace kerf::documents
