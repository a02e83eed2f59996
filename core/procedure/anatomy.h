// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/procedure/source.h"
#include "kerf/math.hpp"

/// `kind: Anatomy` as checked values: all SI, LPS. Reading it: core/procedure/read_anatomy.h.
namespace kerf {

/// Implicit solids of a phantom. Distances are negative inside.
struct BoxSolid { Vec3 centre{}; Vec3 size{}; };                 ///< axis-aligned [m]
struct TubeSolid { Vec3 from{}, to{}; double radius = 0.0; };     ///< capped cylinder [m]
struct EllipticTubeSolid { Vec3 from{}, to{}; double width = 0.0, height = 0.0; Vec3 up{0, 0, 1}; };  ///< full axes [m]
using Solid = std::variant<BoxSolid, TubeSolid, EllipticTubeSolid>;

struct PhantomPart {
    std::string id;
    Solid solid;
    bool subtract = false;  ///< taken away from the parts listed before it
    std::string source;     ///< where the figures come from
};

struct Tissue {
    std::string id;
    double density = 1850.0;  ///< [kg/m³]
    double thickness = 0.0;   ///< [m] a shell under the surface; 0: everything that is left
    std::string source;
};

struct LandmarkPoint { std::string id; Vec3 at{}; double tolerance = 0.0; };
struct LandmarkAxis { std::string id; Vec3 from{}, to{}; double tolerance = 0.0; };

struct Zone {
    std::string id;
    std::vector<Solid> solids;  ///< their union
};

struct PhantomSource { std::vector<PhantomPart> parts; };

struct Anatomy {
    std::string file;   ///< stderr only
    std::string id, title;
    std::string text;   ///< the document itself
    PhantomSource phantom;
    std::vector<Tissue> tissues;  ///< front to back; the last one is the base
    std::vector<LandmarkPoint> points;
    std::vector<LandmarkAxis> axes;
    std::vector<Zone> zones;
};

}  // namespace kerf
