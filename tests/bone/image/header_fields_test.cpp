// SPDX-License-Identifier: Apache-2.0
// Every header field of each format's specification that changes geometry or values: honoured, doubted or refused.
//
// Sources: MetaIO's documentation of MetaImage (itk.org), the definition of NRRD
// (teem.sourceforge.net/nrrd/format.html), nifti1.h (nifti.nimh.nih.gov), DICOM PS3.3 C.7.6.2, C.7.6.3, C.8.2.1 and
// C.11.1. Fields that are not listed change neither: names, comments, ids, colours, ranges for display, times,
// thicknesses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <ios>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bone/image/scan.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

// 4 × 3 × 2 voxels, 0.5 × 1 × 2 mm, the first at LPS (10, 20, 30) mm. Voxel (i, j, k) holds 100 i + 10 j + k.
std::string voxels(bool is_big = false) {
    std::string bytes;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i) {
                const int value = 100 * i + 10 * j + k;
                const char low = static_cast<char>(value & 0xff), high = static_cast<char>(value >> 8);
                bytes += is_big ? high : low;
                bytes += is_big ? low : high;
            }
    return bytes;
}

/// What comes of a file: the places and values of two voxels, or the code of the error.
struct Outcome {
    std::string code;  ///< of the error, or of the first doubt; empty: none
    bool is_read = false;
    Vec3 first{}, last{};  ///< [mm] LPS of voxels (0, 0, 0) and (3, 2, 1)
    float first_value = 0.0f, last_value = 0.0f;
};

Outcome outcome_of(const std::string& path) {
    Outcome outcome;
    text::Diagnostics diagnostics;
    const auto scan = open_scan(path, {}, {}).take(diagnostics);
    const auto image = scan ? scan->read(scan->grid().all(), 0, {}).take(diagnostics) : std::nullopt;
    if (!diagnostics.empty()) outcome.code = diagnostics[0].code;
    outcome.is_read = image.has_value();
    EXPECT_NE(outcome.is_read, text::has_error(diagnostics)) << to_text(diagnostics);
    if (!image) return outcome;
    outcome.first = 1e3 * image->lps({0, 0, 0});
    outcome.last = 1e3 * image->lps({3, 2, 1});
    outcome.first_value = image->values.front();
    outcome.last_value = image->values.back();
    return outcome;
}

enum class Is { honoured, doubted, refused };

/// One field with a value that changes the outcome. Where it is honoured: what becomes of the image.
struct Field {
    const char* name;
    std::string from, to;  ///< in the header; an empty `from` adds a line
    Is is;
    const char* code = "";                                        ///< of the error or doubt
    std::array<double, 3> first{10, 20, 30}, last{11.5, 22, 32};  ///< [mm]
    double last_value = 321.0;
    bool is_big = false;
};

void check(const Field& field, const Outcome& outcome) {
    SCOPED_TRACE(std::string(field.name) + ": " + field.to);
    EXPECT_EQ(outcome.is_read, field.is != Is::refused);
    EXPECT_EQ(outcome.code, field.code);
    if (!outcome.is_read || field.is == Is::refused) return;
    const auto near = [](Vec3 is, const std::array<double, 3>& ought) {
        return length(is - Vec3{ought[0], ought[1], ought[2]}) < 1e-5;
    };
    EXPECT_TRUE(near(outcome.first, field.first))
        << outcome.first.x << " " << outcome.first.y << " " << outcome.first.z;
    EXPECT_TRUE(near(outcome.last, field.last)) << outcome.last.x << " " << outcome.last.y << " " << outcome.last.z;
    EXPECT_FLOAT_EQ(outcome.last_value, static_cast<float>(field.last_value));
}

/// A header with one line changed or added; `end` is the text before which lines are added.
std::string changed(std::string header, const Field& field, const std::string& end) {
    const std::string& before = field.from.empty() ? end : field.from;
    const std::size_t at = header.rfind(before);
    EXPECT_NE(at, std::string::npos) << before;
    return header.replace(at, field.from.size(), field.to + (field.from.empty() ? "\n" : ""));
}

struct HeaderFields : testing::Test {
    test::TemporaryFolder folder;

    Outcome read(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return outcome_of(folder / name);
    }
};

TEST_F(HeaderFields, OfMetaImage) {
    const std::string header =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
        "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 0.5 1 2\nDimSize = 4 3 2\n"
        "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
    const std::string spacing = "ElementSpacing = 0.5 1 2", offset = "Offset = 10 20 30";
    const std::vector<Field> fields{
        {"none", "NDims", "NDims", Is::honoured},
        {"ObjectType", "= Image", "= Tube", Is::refused, "E0622"},
        {"NDims", "NDims = 3", "NDims = 2", Is::refused, "E0622"},
        {"DimSize", "DimSize = 4 3 2", "DimSize = 4 3 3", Is::refused, "E0626"},
        {"DimSize", "DimSize = 4 3 2", "DimSize = +4 +3 +2", Is::honoured},
        {"ElementSpacing", spacing, "ElementSpacing = 1 +1 2", Is::honoured, "", {10, 20, 30}, {13, 22, 32}},
        {"ElementSpacing", spacing + "\n", "", Is::refused, "E0622"},
        {"ElementSize", spacing, "ElementSize = 1 1 2", Is::honoured, "", {10, 20, 30}, {13, 22, 32}},
        {"ElementSize", "", "ElementSize = 1 1 2", Is::doubted, "W0673"},
        {"ElementSize", "", "ElementSize = 0.5 1 2", Is::honoured},
        {"DistanceUnits", "", "DistanceUnits = cm", Is::honoured, "", {100, 200, 300}, {115, 220, 320}},
        {"DistanceUnits", "", "DistanceUnits = um", Is::refused, "E0627"},  // voxels of 0.5 micrometres
        {"DistanceUnits", "", "DistanceUnits = ?", Is::honoured},
        {"DistanceUnits", "", "DistanceUnits = inch", Is::refused, "E0627"},
        {"Offset", offset, "Offset = 0 0 1", Is::honoured, "", {0, 0, 1}, {1.5, 2, 3}},
        {"Position", offset, "Position = 0 0 1", Is::honoured, "", {0, 0, 1}, {1.5, 2, 3}},
        {"Origin", offset, "Origin = 0 0 1", Is::honoured, "", {0, 0, 1}, {1.5, 2, 3}},
        {"Origin", "", "Origin = 0 0 1", Is::refused, "E0622"},
        {"Offset", offset + "\n", "", Is::refused, "E0627"},
        {"TransformMatrix",
         "= 1 0 0 0 1 0 0 0 1",
         "= 0 1 0 -1 0 0 0 0 1",
         Is::honoured,
         "",
         {10, 20, 30},
         {8, 21.5, 32}},
        {"TransformMatrix", "= 1 0 0 0 1 0 0 0 1", "= 2 0 0 0 1 0 0 0 1", Is::refused, "E0627"},
        {"TransformMatrix", "TransformMatrix = 1 0 0 0 1 0 0 0 1\n", "", Is::doubted, "W0673"},
        {"Rotation", "TransformMatrix", "Rotation", Is::honoured},
        {"Orientation", "TransformMatrix", "Orientation", Is::honoured},
        {"AnatomicalOrientation", "", "AnatomicalOrientation = RAI", Is::honoured},
        {"AnatomicalOrientation", "", "AnatomicalOrientation = LPI", Is::doubted, "W0673"},
        {"AnatomicalOrientation", "TransformMatrix = 1 0 0 0 1 0 0 0 1", "AnatomicalOrientation = LPI", Is::refused,
         "E0627"},
        {"CenterOfRotation", "", "CenterOfRotation = 1 2 3", Is::honoured},  // nothing is turned
        {"CenterOfRotation", "TransformMatrix = 1 0 0 0 1 0 0 0 1",
         "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nCenterOfRotation = 1 2 3", Is::refused, "E0627"},
        {"ParentID", "", "ParentID = -1", Is::honoured},
        {"ParentID", "", "ParentID = 2", Is::refused, "E0627"},
        {"ElementType", "MET_SHORT", "MET_USHORT", Is::honoured},
        {"ElementType", "MET_SHORT", "MET_LONG", Is::refused, "E0625"},
        {"ElementType", "MET_SHORT", "MET_SHORT_ARRAY", Is::refused, "E0625"},
        {"ElementNumberOfChannels", "", "ElementNumberOfChannels = 2", Is::refused, "E0623"},
        {"ElementToIntensityFunctionSlope",
         "",
         "ElementToIntensityFunctionSlope = 2",
         Is::honoured,
         "",
         {10, 20, 30},
         {11.5, 22, 32},
         642},
        {"ElementToIntensityFunctionOffset",
         "",
         "ElementToIntensityFunctionOffset = -1000",
         Is::honoured,
         "",
         {10, 20, 30},
         {11.5, 22, 32},
         -679},
        {"ElementToIntensityFunctionSlope", "", "ElementToIntensityFunctionSlope = 0", Is::refused, "E0622"},
        {"Modality", "", "Modality = MET_MOD_MR", Is::doubted, "W0673"},
        {"Modality", "", "Modality = MET_MOD_CT", Is::honoured},
        {"BinaryData", "BinaryData = True", "BinaryData = False", Is::refused, "E0625"},
        {"BinaryDataByteOrderMSB",
         "MSB = False",
         "MSB = True",
         Is::honoured,
         "",
         {10, 20, 30},
         {11.5, 22, 32},
         321,
         true},
        {"ElementByteOrderMSB",
         "BinaryDataByteOrderMSB = False",
         "ElementByteOrderMSB = T",
         Is::honoured,
         "",
         {10, 20, 30},
         {11.5, 22, 32},
         321,
         true},
        {"CompressedData", "CompressedData = False", "CompressedData = True", Is::refused, "E0626"},
        {"HeaderSize", "", "HeaderSize = 0", Is::honoured},
        {"HeaderSize", "", "HeaderSize = -1", Is::refused, "E0622"},
        {"ElementDataFile", "= LOCAL", "= LIST", Is::refused, "E0622"},
        {"ElementDataFile", "= LOCAL", "= a%02d.raw 1 2 1", Is::refused, "E0622"},
    };
    for (const Field& field : fields)
        check(field, read("a.mha", changed(header, field, "ElementDataFile") + voxels(field.is_big)));
}

TEST_F(HeaderFields, OfNrrd) {
    const std::string header =
        "NRRD0005\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
        "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nkinds: domain domain domain\nendian: little\nencoding: raw\n"
        "space origin: (10,20,30)\n\n";
    const std::string lps = "left-posterior-superior", directions = "(0.5,0,0) (0,1,0) (0,0,2)";
    const std::vector<Field> fields{
        {"none", "type", "type", Is::honoured},
        {"dimension", "dimension: 3", "dimension: 4", Is::refused, "E0622"},
        {"sizes", "sizes: 4 3 2", "sizes: 4 3 3", Is::refused, "E0626"},
        {"type", "short", "ushort", Is::honoured},
        {"type", "short", "block", Is::refused, "E0625"},
        {"block size", "type: short", "type: block\nblock size: 2", Is::refused, "E0625"},
        {"endian", "little", "big", Is::honoured, "", {10, 20, 30}, {11.5, 22, 32}, 321, true},
        {"endian", "endian: little\n", "", Is::refused, "E0622"},
        {"encoding", "raw", "hex", Is::refused, "E0625"},
        {"encoding", "raw", "ascii", Is::refused, "E0625"},
        {"encoding", "raw", "bzip2", Is::refused, "E0625"},
        {"encoding", "raw", "gzip", Is::refused, "E0626"},
        {"space", lps, "RAS", Is::honoured, "", {-10, -20, 30}, {-11.5, -22, 32}},
        {"space", lps, "left-anterior-superior", Is::honoured, "", {10, -20, 30}, {11.5, -22, 32}},
        {"space", lps, "scanner-xyz", Is::refused, "E0627"},
        {"space", lps, "left-posterior-superior-time", Is::refused, "E0627"},
        {"space dimension", "space: " + lps, "space dimension: 3", Is::refused, "E0622"},
        {"space dimension", "", "space dimension: 4", Is::refused, "E0627"},
        {"space directions", directions, "(+1,0,0) (0,+1e0,0) (0, 0, 2)", Is::honoured, "", {10, 20, 30}, {13, 22, 32}},
        {"space directions", directions, "(0.5,0,0) none (0,0,2)", Is::refused, "E0627"},
        {"space directions", "space directions: " + directions + "\n", "", Is::refused, "E0622"},
        {"space origin", "(10,20,30)", "(0,0,1)", Is::honoured, "", {0, 0, 1}, {1.5, 2, 3}},
        {"space origin", "space origin: (10,20,30)\n", "", Is::refused, "E0622"},
        {"space units", "", "space units: \"mm\" \"mm\" \"mm\"", Is::honoured},
        {"space units", "", "space units: \"cm\" \"cm\" \"cm\"", Is::honoured, "", {100, 200, 300}, {115, 220, 320}},
        {"space units", "", "space units: \"mm\" \"mm\" \"cm\"", Is::refused, "E0627"},
        {"space units", "", "space units: \"in\" \"in\" \"in\"", Is::refused, "E0627"},
        {"units", "", "units: \"mm\" \"mm\" \"mm\"", Is::honoured},
        {"units", "", "units: \"cm\" \"cm\" \"cm\"", Is::refused, "E0627"},
        {"spacings", "", "spacings: 0.5 1 2", Is::honoured},
        {"spacings", "", "spacings: nan nan nan", Is::honoured},
        {"spacings", "", "spacings: 1 1 2", Is::refused, "E0627"},
        {"axis mins", "", "axis mins: 0 0 0", Is::refused, "E0627"},
        {"axismaxs", "", "axismaxs: 5 5 5", Is::refused, "E0627"},
        {"kinds", "domain domain domain", "space space space", Is::honoured},
        {"kinds", "domain domain domain", "domain domain time", Is::refused, "E0623"},
        {"kinds", "domain domain domain", "3-color domain domain", Is::refused, "E0623"},
        {"kinds", "domain domain domain", "domain domain", Is::refused, "E0622"},
        {"old min", "", "old min: -1000", Is::refused, "E0622"},
        {"oldmax", "", "oldmax: 3000", Is::refused, "E0622"},
        {"number", "", "number: 24", Is::honoured},
        {"number", "", "number: 48", Is::refused, "E0622"},
        {"byte skip", "", "byte skip: 0", Is::honoured},
        {"byte skip", "", "byte skip: -1", Is::honoured},
        {"byte skip", "", "byte skip: 2", Is::refused, "E0626"},
        {"line skip", "", "line skip: 1", Is::refused, "E0622"},
        {"data file", "", "data file: LIST", Is::refused, "E0622"},
        {"data file", "", "data file: a%d.raw 1 2 1", Is::refused, "E0622"},
        {"Segmentation_MasterRepresentation", "", "Segmentation_MasterRepresentation:=Fractional labelmap", Is::refused,
         "E0623"},
    };
    for (const Field& field : fields) check(field, read("a.nrrd", changed(header, field, "\n") + voxels(field.is_big)));
}

/// A NIfTI-1 header; x and y are those of RAS.
struct Nifti {
    std::string header = std::string(352, '\0');

    template <class Number>
    Nifti& with(std::size_t at, Number value) {
        std::memcpy(header.data() + at, &value, sizeof value);
        return *this;
    }
    Nifti& word(std::size_t at, int value) { return with(at, static_cast<std::int16_t>(value)); }
    Nifti& qform() {  // turned by half a turn about z
        return word(252, 1).with(264, 1.0f).with(268, -10.0f).with(272, -20.0f).with(276, 30.0f);
    }
    Nifti() {
        with<std::int32_t>(0, 348).word(40, 3).word(42, 4).word(44, 3).word(46, 2);
        for (const std::size_t at : {48u, 50u, 52u, 54u}) word(at, 1);
        word(70, 4).word(72, 16).with(76, 1.0f).with(80, 0.5f).with(84, 1.0f).with(88, 2.0f);
        with(108, 352.0f).with(112, 1.0f).with<char>(123, 2).word(254, 1);
        with(280, -0.5f).with(292, -10.0f).with(300, -1.0f).with(308, -20.0f).with(320, 2.0f).with(324, 30.0f);
        std::memcpy(header.data() + 344, "n+1", 4);
    }
};

TEST_F(HeaderFields, OfNifti) {
    struct Change {
        Field field;
        std::function<void(Nifti&)> make;
    };
    const auto named = [](const char* name, Is is, const char* code = "", std::array<double, 3> first = {10, 20, 30},
                          std::array<double, 3> last = {11.5, 22, 32},
                          double value = 321) { return Field{name, "", "", is, code, first, last, value}; };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Change> changes{
        {named("none", Is::honoured), [](Nifti&) {}},
        {named("sizeof_hdr 540", Is::refused, "E0622"), [](Nifti& n) { n.with<std::int32_t>(0, 540); }},
        {named("dim", Is::refused, "E0626"), [](Nifti& n) { n.word(46, 3); }},
        {named("dim of 4", Is::refused, "E0623"), [](Nifti& n) { n.word(40, 4).word(48, 2); }},
        {named("datatype", Is::honoured), [](Nifti& n) { n.word(70, 512); }},
        {named("datatype complex", Is::refused, "E0625"), [](Nifti& n) { n.word(70, 32); }},
        {named("bitpix", Is::refused, "E0622"), [](Nifti& n) { n.word(72, 32); }},
        {named("pixdim, other than sform", Is::refused, "E0627"), [](Nifti& n) { n.with(80, 0.6f); }},
        {named("pixdim, rounded", Is::doubted, "W0673"), [](Nifti& n) { n.with(80, 0.502f); }},
        {named("sform columns of 1 mm", Is::refused, "E0627"),
         [](Nifti& n) { n.with(280, -1.0f).with(300, -1.0f).with(320, 1.0f); }},
        {named("vox_offset", Is::refused, "E0626"), [](Nifti& n) { n.with(108, 368.0f); }},
        {named("scl_slope", Is::honoured, "", {10, 20, 30}, {11.5, 22, 32}, 642), [](Nifti& n) { n.with(112, 2.0f); }},
        {named("scl_inter", Is::honoured, "", {10, 20, 30}, {11.5, 22, 32}, 221),
         [](Nifti& n) { n.with(116, -100.0f); }},
        {named("scl_slope 0", Is::honoured), [](Nifti& n) { n.with(112, 0.0f); }},
        {named("scl_inter without slope", Is::doubted, "W0673"), [](Nifti& n) { n.with(112, 0.0f).with(116, 1.0f); }},
        {named("scl_slope NaN", Is::refused, "E0622"), [&](Nifti& n) { n.with(112, nan); }},
        {named("xyzt_units metres", Is::refused, "E0627"), [](Nifti& n) { n.with<char>(123, 1); }},
        {named("xyzt_units micrometres", Is::refused, "E0627"), [](Nifti& n) { n.with<char>(123, 3); }},
        {named("xyzt_units 5", Is::refused, "E0627"), [](Nifti& n) { n.with<char>(123, 5); }},
        {named("srow", Is::honoured, "", {0, 20, 30}, {1.5, 22, 32}), [](Nifti& n) { n.with(292, 0.0f); }},
        {named("sform_code 4", Is::doubted, "W0673"), [](Nifti& n) { n.word(254, 4); }},
        {named("no code", Is::refused, "E0627"), [](Nifti& n) { n.word(254, 0); }},
        {named("qform", Is::honoured), [](Nifti& n) { n.qform().word(254, 0); }},
        {named("qform like sform", Is::honoured), [](Nifti& n) { n.qform(); }},
        {named("qform elsewhere", Is::doubted, "W0673"), [](Nifti& n) { n.qform().with(268, 5.0f); }},
        {named("pixdim[0]", Is::honoured, "", {10, 20, 30}, {11.5, 22, 28}),
         [](Nifti& n) { n.qform().word(254, 0).with(76, -1.0f); }},
        {named("quatern", Is::refused, "E0627"), [](Nifti& n) { n.qform().with(256, 1.0f); }},
        {named("magic of a pair", Is::refused, "E0622"), [](Nifti& n) { n.with<char>(345, 'i').with<char>(346, '1'); }},
    };
    for (const auto& [field, make] : changes) {
        Nifti nifti;
        make(nifti);
        check(field, read("a.nii", nifti.header + voxels()));
    }
    Nifti metres;  // of a size that has a meaning in them
    metres.with<char>(123, 1).with(80, 0.0005f).with(84, 0.001f).with(88, 0.002f);
    metres.with(280, -0.0005f)
        .with(292, -0.01f)
        .with(300, -0.001f)
        .with(308, -0.02f)
        .with(320, 0.002f)
        .with(324, 0.03f);
    check(named("xyzt_units metres, 0.0005", Is::honoured), read("m.nii", metres.header + voxels()));
}

TEST_F(HeaderFields, OfDicom) {
    namespace tag = test::tag;
    using Slice = test::DicomWriter;
    struct Change {
        Field field;
        std::function<void(Slice&)> make;  ///< in each slice
    };
    const auto named = [](const char* name, Is is, const char* code = "", std::array<double, 3> last = {11.5, 22, 32},
                          double value = 321) {
        return Field{name, "", "", is, code, {10, 20, 30}, last, value};
    };
    const std::vector<Change> changes{
        {named("none", Is::honoured), [](Slice&) {}},
        {named("Samples per Pixel", Is::refused, "E0667"), [](Slice& s) { s.word(tag::samples, 3); }},
        {named("Photometric Interpretation", Is::refused, "E0667"),
         [](Slice& s) { s.text(tag::photometric, "CS", "MONOCHROME1"); }},
        {named("Number of Frames", Is::refused, "E0667"), [](Slice& s) { s.text(tag::frames, "IS", "2"); }},
        {named("Rows, fewer", Is::refused, "E0667"), [](Slice& s) { s.word(tag::rows, 2); }},
        {named("Columns, more", Is::refused, "E0667"), [](Slice& s) { s.word(tag::columns, 5); }},
        {named("Pixel Spacing", Is::honoured, "", {13, 22, 32}),
         [](Slice& s) {
             s.number(tag::pixel_spacing, {1, 1});
         }},
        {named("Pixel Aspect Ratio", Is::honoured), [](Slice& s) { s.text(0x00280034, "IS", "2\\1"); }},
        {named("Pixel Aspect Ratio, other", Is::refused, "E0667"), [](Slice& s) { s.text(0x00280034, "IS", "1\\1"); }},
        {named("Bits Allocated", Is::refused, "E0667"), [](Slice& s) { s.word(tag::bits_allocated, 12); }},
        {named("Bits Stored", Is::honoured, "", {11.5, 22, 32}, 321 - 1024),
         [](Slice& s) { s.word(tag::bits_stored, 10).word(tag::high_bit, 9); }},
        {named("High Bit", Is::honoured, "", {11.5, 22, 32}, 1345 / 4 - 1024),
         [](Slice& s) { s.word(tag::bits_stored, 14).word(tag::high_bit, 15); }},
        {named("Pixel Representation", Is::honoured), [](Slice& s) { s.word(tag::representation, 1); }},
        {named("Pixel Padding Value", Is::honoured, "", {11.5, 22, 32}, 0),
         [](Slice& s) { s.word(tag::padding, 1345); }},
        {named("Pixel Padding Range Limit", Is::honoured, "", {11.5, 22, 32}, 0),
         [](Slice& s) { s.word(tag::padding, 1340).word(tag::padding_limit, 1400); }},
        {named("Pixel Padding Range Limit, downwards", Is::honoured, "", {11.5, 22, 32}, 0),
         [](Slice& s) { s.word(tag::padding, 1400).word(tag::padding_limit, 1340); }},
        {named("Pixel Padding Range Limit alone", Is::refused, "E0667"),
         [](Slice& s) { s.word(tag::padding_limit, 1340); }},
        {named("Rescale Slope", Is::honoured, "", {11.5, 22, 32}, 2 * 1345 - 1024),
         [](Slice& s) { s.number(tag::slope, {2}); }},
        {named("Rescale Intercept", Is::honoured, "", {11.5, 22, 32}, 1345),
         [](Slice& s) { s.number(tag::intercept, {0}); }},
        {named("Rescale Type", Is::honoured), [](Slice& s) { s.text(0x00281054, "LO", "HU"); }},
        {named("Rescale Type, other", Is::doubted, "W0673"), [](Slice& s) { s.text(0x00281054, "LO", "OD"); }},
        {named("Modality LUT Sequence", Is::refused, "E0667"), [](Slice& s) { s.raw(0x00283000, "SQ", ""); }},
        {named("Modality", Is::doubted, "W0673"), [](Slice& s) { s.text(tag::modality, "CS", "PT"); }},
        {named("Lossy Image Compression", Is::doubted, "W0673"), [](Slice& s) { s.text(tag::lossy, "CS", "01"); }},
        {named("Image Position", Is::refused, "E0667"), [](Slice& s) { s.without(tag::position); }},
        // The normal points to the feet then: the upper slice is the first one.
        {{"Image Orientation", "", "", Is::honoured, "", {10, 20, 32}, {12, 21.5, 30}, 320},
         [](Slice& s) {
             s.number(tag::orientation, {0, 1, 0, 1, 0, 0});
         }},
        {named("Image Orientation, none", Is::refused, "E0667"), [](Slice& s) { s.without(tag::orientation); }},
        {named("Gantry/Detector Tilt", Is::doubted, "W0673"), [](Slice& s) { s.number(tag::gantry_tilt, {10}); }},
        {named("Spacing Between Slices", Is::honoured), [](Slice& s) { s.number(0x00180088, {2}); }},
        {named("Spacing Between Slices, other", Is::doubted, "W0673"), [](Slice& s) { s.number(0x00180088, {1}); }},
        {named("Transfer Syntax", Is::honoured), [](Slice& s) { s.syntax = "1.2.840.10008.1.2"; }},
        {named("Transfer Syntax, deflated", Is::refused, "E0667"),
         [](Slice& s) { s.syntax = "1.2.840.10008.1.2.1.99"; }},
    };
    for (const auto& [field, make] : changes) {
        const test::TemporaryFolder series;
        for (int k = 0; k < 2; ++k) {
            std::vector<int> values;
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 4; ++i) values.push_back(100 * i + 10 * j + k);
            Slice slice = test::ct_slice(4, 3, 1.0, {10, 20, 30 + 2.0 * k}, k + 1, values);
            slice.number(tag::pixel_spacing, {1, 0.5});
            make(slice);
            slice.write(series / ("IM" + std::to_string(k)));
        }
        check(field, outcome_of(series.path()));
    }
}

}  // namespace
}  // namespace kerf::bone
