// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "documents/loft.h"
#include "kerf/math.hpp"
#include "text/source.h"

/// `kind: Anatomy` as checked values: all SI, LPS. Reading it: documents/read_anatomy.h.
namespace kerf::documents {

/// Implicit solids of a phantom. Distances are negative inside.
struct BoxSolid {
    Vec3 centre{};
    Vec3 size{};
};  ///< axis-aligned [m]
struct TubeSolid {
    Vec3 from{}, to{};
    double radius = 0.0;
};  ///< capped cylinder [m]
struct EllipticTubeSolid {
    Vec3 from{}, to{};
    double width = 0.0, height = 0.0;
    Vec3 up{0, 0, 1};
};  ///< full axes [m]
struct SphereSolid {
    Vec3 centre{};
    double radius = 0.0;
};  ///< [m]
/// |2x/width|^e + |2y/height|^e + |2z/length|^e = 1, with y in the direction `up` and z in the direction `along`.
struct SuperellipsoidSolid {
    Vec3 centre{};
    double length = 0.0, width = 0.0, height = 0.0;  ///< [m] full axes
    double exponent = 2.0;                           ///< [–]
    Vec3 along{0, 0, 1}, up{0, 1, 0};
};
using Solid = std::variant<BoxSolid, TubeSolid, EllipticTubeSolid, SphereSolid, SuperellipsoidSolid, LoftSolid>;

struct PhantomPart {
    std::string id;
    Solid solid;
    bool subtract = false;  ///< taken away from the parts listed before it
    std::string source{};   ///< where the figures come from
    double blend = 0.0;     ///< [m] radius of the fillet between it and the parts before it
};

/// Where a tissue differs: within solids, and fading to nothing across `over` outside them.
struct TissueRegion {
    std::vector<Solid> solids{};
    double over = 2e-3;      ///< [m]
    double thickness = 0.0;  ///< [m] of a shell; 0: as elsewhere
    double density = 0.0;    ///< [kg/m³] 0: as elsewhere
};

struct Tissue {
    std::string id;
    double density = 1850.0;  ///< [kg/m³]
    double thickness = 0.0;   ///< [m] a shell under the surface; 0: no shell
    std::string source;
    std::vector<Solid> solids{};  ///< it is in their union; empty: wherever its shell is, or everything that is left
    std::vector<TissueRegion> regions{};  ///< the first one has precedence
};

/// How a landmark is found from the bone, near where it is written. What each shape is: bone/import/fit_landmarks.h.
struct LandmarkFit {
    enum class Shape { sphere, tube, neck, condyles };
    Shape shape = Shape::sphere;
    double radius = 0.0;      ///< [m] about; of a sphere and a tube
    std::string reference{};  ///< of a neck: the point at its head's centre; of condyles: the axis of the shaft
    double within = 15e-3;    ///< [m] how far it may lie from where it is written
    std::optional<double> residual{};  ///< [m] at most; without it the landmark's tolerance
};

struct LandmarkPoint {
    /// What the author knows of the place, and import checks within the tolerance.
    enum class Lies { anywhere, on_bone, in_bone, off_bone };
    std::string id;
    Vec3 at{};               ///< [m]
    double tolerance = 0.0;  ///< [m]
    Lies lies = Lies::anywhere;
    std::optional<LandmarkFit> fit{};  ///< then `at` is a guess until the bone is made
};
struct LandmarkAxis {
    std::string id;
    Vec3 from{}, to{};                 ///< [m]
    double tolerance = 0.0;            ///< [m]
    std::optional<LandmarkFit> fit{};  ///< then `from` and `to` are guesses until the bone is made
};
struct LandmarkPlane {
    std::string id;
    Vec3 at{}, normal{};     ///< [m]; unit
    double tolerance = 0.0;  ///< [m]
};

/// A file of 3D Slicer's markups whose points, lines and planes are landmarks. Path as written, found like a scan.
struct MarkupsFile {
    std::string file;
    double tolerance = 0.0;  ///< [m] of all that is in it
    std::map<std::string, std::string>
        names;  ///< what the file calls one, and which id it gets; others keep their name
};

struct Zone {
    std::string id;
    std::vector<Solid> solids;  ///< their union
    bool is_tissue = false;     ///< of a tissue: it is meant to lie in bone
};

/// A flat break through the bone. What is in front of it is a fragment, which lies elsewhere at first.
struct Fracture {
    Vec3 at{}, normal{};  ///< [m]; unit, into the fragment
    double gap = 0.5e-3;  ///< [m] of bone that is lost
    Vec3 shift{};         ///< [m] of the fragment
    Vec3 about{0, 0, 1};  ///< unit, through `at`
    double turn = 0.0;    ///< [rad] of the fragment, before the shift
};

struct PhantomSource {
    std::vector<PhantomPart> parts;
};

/// Bone density from a voxel's value: at_zero + per_unit × value, never under the floor.
struct DensityLine {
    double at_zero = 0.0;   ///< [kg/m³]
    double per_unit = 0.0;  ///< [kg/m³] per HU or grey level
    double floor = 0.0;     ///< [kg/m³]
    std::string source;
};

/// Bone out of a CT. Files and folders: paths as written, inside the document's folder or, failing that, inside
/// KERF_DATA.
struct CtSource {
    enum class Intensity { hounsfield, grey };
    std::string image;                            ///< a file, or a folder with a DICOM series
    std::string series;                           ///< which one, as import offers it; empty: the only one
    std::string acquisition;                      ///< which one of the series, the same way
    bool may_resample = false;                    ///< across missing slices
    Intensity intensity = Intensity::hounsfield;  ///< what the values are: cone-beam CT and others give grey levels
    std::string labels;                           ///< a label map or segmentation; empty: by threshold alone
    std::vector<int> keep;                        ///< the labels that are this bone,
    std::vector<std::string> keep_named;          ///< or what the segmentation calls them
    std::string
        component_at;  ///< a landmark point: of all pieces the one nearest to it; empty: the largest, or all labels
    double threshold = 0.0;  ///< [HU or grey] the border of bone, between voxels; without labels also what is bone
    double closing = 0.0;    ///< [m] radius: narrower gaps in the mask are closed
    bool fill = false;       ///< cavities without a way out count as bone
    std::optional<DensityLine> density;  ///< of the base tissue, voxel by voxel
    std::string source;
};

/// What a closed piece of a surface inside another is, when its faces say that there is bone on both sides of it.
enum class InnerPieces { unsaid, hollow, solid };

/// Bone out of a closed surface. Files: paths as above.
struct MeshSource {
    std::string file;
    double unit = 1e-3;         ///< [m] one of its coordinates' 1
    bool is_ras = false;        ///< x to the right and y to the front; else LPS
    bool names_frame = false;   ///< said, not supposed
    double holes_up_to = 0.0;   ///< [m] across: such holes are closed
    double pieces_under = 0.0;  ///< [m³] smaller pieces are left out
    InnerPieces inner = InnerPieces::unsaid;
    /// The marrow's room: there is no bone in it, and marrow resists nothing. A second surface in the same unit and
    /// frame, or a tube.
    std::string canal_file;
    std::optional<TubeSolid> canal;
    std::string source;
};

struct Anatomy {
    std::string file;  ///< stderr only
    std::string id, title;
    std::vector<std::string> within{};  ///< keys under which it stands in the document; none: the document is it
    std::string text;                   ///< the document itself
    PhantomSource phantom;              ///< this,
    std::optional<CtSource> ct;         ///< or that,
    std::optional<MeshSource> mesh;     ///< or that
    std::vector<Tissue> tissues;        ///< front to back; the last one is the base
    std::vector<LandmarkPoint> points;
    std::vector<LandmarkAxis> axes;
    std::vector<LandmarkPlane> planes;
    std::vector<MarkupsFile> markups;  ///< not yet among the above: bone/import/markups reads them
    std::vector<Zone> zones;
    std::optional<Fracture> fracture{};
};

}  // namespace kerf::documents
