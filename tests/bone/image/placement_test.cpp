// SPDX-License-Identifier: Apache-2.0
// Size and position of a volume that lies askew, in each unit and each branch of a header that reads them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "bone/image/image_file.h"
#include "kerf/math.hpp"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"
#include "text/plain_numbers.h"

namespace kerf::bone {
namespace {

using namespace literals;

/// The axes of the volume, in the frame of its header, and its steps and first voxel there [mm].
const Quat askew = quat_from_rotation_vector({0.4, -0.9, 0.5});
constexpr std::array<double, 3> spacing{0.5, 1.0, 2.0};
constexpr Vec3 first{10.0, -20.0, 30.0};
constexpr std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

/// A header's unit and how many millimetres it has.
struct Unit {
    std::string name;
    double mm;
};

struct Placement : testing::Test {
    test::TemporaryFolder folder;

    /// Expects the volume, after the signs that take the header's frame to LPS; its third axis times `sense`.
    void expect_placed(const std::string& name, const std::string& header, Vec3 to_lps, double sense = 1.0) {
        std::ofstream(folder / name, std::ios::binary) << header << std::string(4 * 3 * 2 * 2, '\0');
        text::Diagnostics diagnostics;
        const auto image = check_image_file(folder / name).take(diagnostics);
        ASSERT_TRUE(image) << to_text(diagnostics);
        EXPECT_TRUE(image->doubts.empty()) << image->doubts.front();
        const auto& m = image->lps_from_index;
        const auto expect_column = [&](std::size_t column, Vec3 of_header) {
            EXPECT_NEAR(m[column], 1e-3 * to_lps.x * of_header.x, 1e-8 /* float headers */) << column;
            EXPECT_NEAR(m[4 + column], 1e-3 * to_lps.y * of_header.y, 1e-8) << column;
            EXPECT_NEAR(m[8 + column], 1e-3 * to_lps.z * of_header.z, 1e-8) << column;
        };
        for (std::size_t axis = 0; axis < 3; ++axis)
            expect_column(axis, (axis == 2 ? sense : 1.0) * spacing[axis] * rotate(askew, axes[axis]));
        expect_column(3, first);
    }
};

/// A NIfTI-1 header in the unit of this code.
class Nifti {
public:
    Nifti(char code, double mm) : mm_(mm) {
        put<std::int32_t>(0, 348);
        word(40, 3);
        for (const auto& [at, size] : {std::pair{42u, 4}, {44u, 3}, {46u, 2}, {48u, 1}, {50u, 1}, {52u, 1}, {54u, 1}})
            word(at, size);
        word(70, 4);
        word(72, 16);
        put(76, 1.0f);
        for (std::size_t axis = 0; axis < 3; ++axis) length(80 + 4 * axis, spacing[axis]);
        put(108, 352.0f);
        header[123] = code;
        std::memcpy(header.data() + 344, "n+1", 4);
    }
    Nifti& matrix(double sense = 1.0) {
        word(254, 1);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3 step = (axis == 2 ? sense : 1.0) * spacing[axis] * rotate(askew, axes[axis]);
            length(280 + 4 * axis, step.x);
            length(296 + 4 * axis, step.y);
            length(312 + 4 * axis, step.z);
        }
        length(292, first.x);
        length(308, first.y);
        length(324, first.z);
        return *this;
    }
    Nifti& quaternion(float sense = 1.0f) {
        word(252, 1);
        put(76, sense);
        for (const auto& [at, part] : {std::pair{256u, askew.x}, {260u, askew.y}, {264u, askew.z}})
            put(at, static_cast<float>(part));
        length(268, first.x);
        length(272, first.y);
        length(276, first.z);
        return *this;
    }
    std::string header = std::string(352, '\0');

private:
    template <class Number>
    void put(std::size_t at, Number value) {
        std::memcpy(header.data() + at, &value, sizeof value);
    }
    void word(std::size_t at, int value) { put(at, static_cast<std::int16_t>(value)); }
    void length(std::size_t at, double in_mm) { put(at, static_cast<float>(in_mm / mm_)); }

    double mm_;
};

constexpr Vec3 from_ras{-1, -1, 1};

TEST_F(Placement, OfNiftiIsTheSameInEachUnitOfEachForm) {
    for (const auto& [code, mm] : {std::pair<char, double>{0, 1.0}, {2, 1.0}, {1, 1000.0}, {3, 1e-3}}) {
        SCOPED_TRACE(static_cast<int>(code));
        expect_placed("matrix.nii", Nifti(code, mm).matrix().header, from_ras);
        expect_placed("quaternion.nii", Nifti(code, mm).quaternion().header, from_ras);
        expect_placed("both.nii", Nifti(code, mm).matrix().quaternion().header, from_ras);
    }
}

TEST_F(Placement, OfNiftiFollowsTheSenseOfTheThirdAxis) {
    for (const char code : {char{2}, char{1}}) {
        const double mm = code == 1 ? 1000.0 : 1.0;
        expect_placed("matrix.nii", Nifti(code, mm).matrix(-1.0).header, from_ras, -1.0);
        expect_placed("quaternion.nii", Nifti(code, mm).quaternion(-1.0f).header, from_ras, -1.0);
    }
}

/// An NRRD header with its numbers in this many millimetres.
std::string nrrd(const std::string& space, const std::string& units, double mm) {
    const text::PlainNumbers plain;
    char line[400];
    std::string directions;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Vec3 step = spacing[axis] / mm * rotate(askew, axes[axis]);
        std::snprintf(line, sizeof line, " (%.12g,%.12g,%.12g)", step.x, step.y, step.z);
        directions += line;
    }
    std::snprintf(line, sizeof line, "(%.12g,%.12g,%.12g)", first.x / mm, first.y / mm, first.z / mm);
    return "NRRD0004\ntype: short\ndimension: 3\nspace: " + space + "\nsizes: 4 3 2\nspace directions:" + directions +
           "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: " + line + "\n" + units + "\n";
}

const std::vector<Unit> units{{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"um", 1e-3}};

TEST_F(Placement, OfNrrdIsTheSameInEachUnit) {
    expect_placed("none.nrrd", nrrd("left-posterior-superior", "", 1.0), {1, 1, 1});
    for (const auto& [name, mm] : units) {
        SCOPED_TRACE(name);
        const std::string three = '"' + name + "\" \"" + name + "\" \"" + name + "\"\n";
        expect_placed("space.nrrd", nrrd("left-posterior-superior", "space units: " + three, mm), {1, 1, 1});
        expect_placed("both.nrrd", nrrd("left-posterior-superior", "space units: " + three + "units: " + three, mm),
                      {1, 1, 1});
    }
}

TEST_F(Placement, OfNrrdFollowsItsSpace) {
    expect_placed("lps.nrrd", nrrd("LPS", "", 1.0), {1, 1, 1});
    expect_placed("ras.nrrd", nrrd("right-anterior-superior", "", 1.0), {-1, -1, 1});
    expect_placed("las.nrrd", nrrd("LAS", "", 1.0), {1, -1, 1});
}

/// A MetaImage header with its numbers in this unit.
std::string meta_image(const Unit& unit) {
    const text::PlainNumbers plain;
    char text[800];
    const std::array<Vec3, 3> d{rotate(askew, axes[0]), rotate(askew, axes[1]), rotate(askew, axes[2])};
    const double mm = unit.mm;
    std::snprintf(text, sizeof text,
                  "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
                  "TransformMatrix = %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g %.12g\n"
                  "Offset = %.12g %.12g %.12g\nDistanceUnits = %s\nElementSpacing = %.12g %.12g %.12g\n"
                  "DimSize = 4 3 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n",
                  d[0].x, d[0].y, d[0].z, d[1].x, d[1].y, d[1].z, d[2].x, d[2].y, d[2].z, first.x / mm, first.y / mm,
                  first.z / mm, unit.name.c_str(), spacing[0] / mm, spacing[1] / mm, spacing[2] / mm);
    return text;
}

TEST_F(Placement, OfMetaImageIsTheSameInEachUnit) {
    for (const Unit& unit : units) {
        SCOPED_TRACE(unit.name);
        expect_placed("a.mha", meta_image(unit), {1, 1, 1});
    }
}

}  // namespace
}  // namespace kerf::bone
