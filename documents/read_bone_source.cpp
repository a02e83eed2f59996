// SPDX-License-Identifier: Apache-2.0
#include "documents/read_bone_source.h"

#include "documents/read_solids.h"
#include "documents/shapes/shapes.h"

namespace kerf::documents {

CtSource read_ct(const Node& node, Report& report) {
    CtSource ct;
    read_map(node, shapes::ct, "ct", ct, report);
    return ct;
}

MeshSource read_mesh(const Node& node, const std::string& where, Report& report) {
    MeshSource mesh;
    read_map(node, shapes::mesh, where, mesh, report, [&](MapReader& map) {
        if (const std::string frame = map.word("frame"); !frame.empty()) {
            mesh.names_frame = true;
            mesh.is_ras = frame == "RAS";
        }
        if (const Node* canal = map.find("canal"))
            read_map(*canal, shapes::canal, where + ".canal", mesh, report, [&](MapReader& room) {
                if (const Node* tube = room.find("tube"); tube != nullptr && mesh.canal_file.empty())
                    mesh.canal = read_tube(*tube, where + ".canal.tube", report);
            });
    });
    return mesh;
}

}  // namespace kerf::documents
