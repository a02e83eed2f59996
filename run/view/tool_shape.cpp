// SPDX-License-Identifier: Apache-2.0
#include "run/view/tool_shape.h"

#include <algorithm>

#include "run/view/blade_shape.h"
#include "run/view/facets.h"
#include "run/view/grooves.h"
#include "run/view/thread_shape.h"
#include "run/view/turned_shape.h"

namespace kerf::run {

ViewedMesh tool_shape(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    if (outline.profile.size() < 2) return {};
    if (outline.whole.is_prism()) return mesh_of(blade_facets(tool));
    if (outline.has_thread()) return mesh_of(threaded_facets(tool, outline.profile.size(), 0.0));
    Rows rows = turned_rows(outline, grooves_of(tool));
    if (2 * rows.points.size() > max_tool_triangles) rows = turned_rows(outline, no_grooves(max_columns));
    Facets facets;
    add_rows(facets, rows);
    return mesh_of(facets);
}

ViewedMesh staying_shape(const Tool& tool) {
    const ToolOutline& outline = tool.outline;
    if (!outline.is_implant() || !outline.has_thread()) return {};
    // The socket lies in the last cylinder, which is the head.
    const std::size_t count = outline.stay_count;
    const double head = outline.profile[count - 2].z - outline.profile[count - 1].z;
    return mesh_of(threaded_facets(tool, count, std::min(0.6 * head, outline.profile[count - 1].radius)));
}

}  // namespace kerf::run
