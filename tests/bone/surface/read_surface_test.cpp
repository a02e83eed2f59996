// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/read_surface.h"

#include <gtest/gtest.h>

#include <cctype>
#include <clocale>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/bone/surface/shapes.h"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using test::big_endian;
using test::little_endian;

/// The one triangle of most of these files.
void expect_corner(const std::optional<SurfaceFile>& file, const SurfaceError& error) {
    ASSERT_TRUE(file) << error.message;
    ASSERT_EQ(file->mesh.triangles.size(), 1u);
    const auto [a, b, c] = file->mesh.corners(file->mesh.triangles[0]);
    EXPECT_TRUE(a == (Vec3{0.0, 0.0, 0.5})) << a.z;
    EXPECT_TRUE(b == (Vec3{1.25, 0.0, 0.0}));
    EXPECT_TRUE(c == (Vec3{0.0, -2.0, 0.0}));
}
template <class Read>
void expect_refused(const Read& read, const std::string& bytes, const char* code) {
    SurfaceError error;
    EXPECT_FALSE(read(bytes, error)) << bytes.substr(0, 200);
    ASSERT_NE(error.code, nullptr);
    EXPECT_STREQ(error.code, code) << error.message;
    EXPECT_FALSE(error.message.empty());
    EXPECT_FALSE(error.advice.empty());
}

// ---- STL
// -------------------------------------------------------------------------------------------------------------

const std::string text_stl = R"(solid a bone, made by hand
  facet normal 0 0 1
    outer loop
      vertex 0 0 +5e-1
      vertex 1.25 0 0
      vertex 0 -2 0
    endloop
  endfacet
endsolid a bone
)";
SurfaceMesh corner_mesh() { return {{{0, 0, 0.5}, {1.25, 0, 0}, {0, -2, 0}}, {{0, 1, 2}}}; }

TEST(ReadStl, ReadsTextAndBinary) {
    SurfaceError error;
    expect_corner(read_stl(text_stl, error), error);
    expect_corner(read_stl(test::binary_stl(corner_mesh()), error), error);
}
TEST(ReadStl, TakesABinaryFileThatBeginsWithSolidForBinary) {
    SurfaceError error;
    expect_corner(read_stl(test::binary_stl(corner_mesh(), "solid from a program that does not know better"), error),
                  error);
}
TEST(ReadStl, ReadsBigLettersAndCarriageReturns) {
    std::string loud;
    for (const char c : text_stl) {
        if (c == '\n') loud += '\r';
        loud += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    SurfaceError error;
    expect_corner(read_stl(loud, error), error);
}
TEST(ReadStl, RefusesWhatIsCutOff) {
    const std::string binary = test::binary_stl(test::cube(1.0));
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{83}, std::size_t{84}, std::size_t{133}, binary.size() - 1})
        expect_refused(read_stl, binary.substr(0, size), "E0644");
    expect_refused(read_stl, text_stl.substr(0, text_stl.size() - 16), "E0644");
}
TEST(ReadStl, RefusesACountOfFourThousandMillionFaces) {
    std::string lies = test::binary_stl(corner_mesh());
    for (std::size_t i = 80; i < 84; ++i) lies[i] = '\xff';
    expect_refused(read_stl, lies, "E0644");
}
TEST(ReadStl, RefusesWhatIsNoNumber) {
    SurfaceMesh mesh = corner_mesh();
    for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, 1e300}) {
        mesh.vertices[1].y = wrong;
        expect_refused(read_stl, test::binary_stl(mesh), "E0645");
    }
    std::string text = text_stl;
    text.replace(text.find("1.25"), 4, "nan ");
    expect_refused(read_stl, text, "E0645");
    text.replace(text.find("nan "), 4, "1,25");
    expect_refused(read_stl, text, "E0643");
}
TEST(ReadStl, RefusesFacesWithoutThreeCorners) {
    std::string text = text_stl;
    text.erase(text.find("      vertex 0 -2 0\n"), 20);
    expect_refused(read_stl, text, "E0643");
    text.insert(text.find("    endloop"), "vertex 0 0 0\nvertex 0 0 0\n");
    expect_refused(read_stl, text, "E0643");
}
TEST(ReadStl, RefusesAFileWithoutFaces) {
    expect_refused(read_stl, "solid nothing\nendsolid nothing\n", "E0647");
    expect_refused(read_stl, test::binary_stl({}), "E0647");
}

// ---- OBJ
// -------------------------------------------------------------------------------------------------------------

TEST(ReadObj, ReadsAllFormsOfACorner) {
    for (const char* face :
         {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1", "f -3//-1 2 3/1"}) {
        SurfaceError error;
        expect_corner(
            read_obj("# by hand\no bone\nv 0 0 0.5\nv 1.25 0 0 1.0\nv 0 -2e0 0\nvt 0 0\nvn 0 0 1\ng part\nusemtl "
                     "ivory\ns off\n" +
                         std::string(face) + "\n",
                     error),
            error);
    }
}
TEST(ReadObj, CutsPolygonsIntoTrianglesOfTheSameArea) {
    // A square from which a corner of a quarter is missing: six corners, one of them inwards
    const std::string file = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n";
    for (const char* face : {"f 1 2 3 4 5 6", "f 4 5 6 1 2 3", "f 3 4 5 6 1 2"}) {
        SurfaceError error;
        const auto surface = read_obj(file + face, error);
        ASSERT_TRUE(surface) << error.message;
        ASSERT_EQ(surface->mesh.triangles.size(), 4u);
        EXPECT_DOUBLE_EQ(area_of(surface->mesh), 3.0) << face;
        for (const Triangle& t : surface->mesh.triangles) {
            const auto [a, b, c] = surface->mesh.corners(t);
            EXPECT_GT(cross(b - a, c - a).z, 0.0);
        }
    }
}
TEST(ReadObj, RefusesVerticesThatAreNotThere) {
    for (const char* face : {"f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2 9999999999"})
        expect_refused(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + std::string(face) + "\n", "E0646");
}
TEST(ReadObj, RefusesWhatItCannotUnderstand) {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    expect_refused(read_obj, "v 0 0\n", "E0643");
    expect_refused(read_obj, "v 0 0 zero\n", "E0643");
    expect_refused(read_obj, "v 0 0 inf\n", "E0645");
    expect_refused(read_obj, vertices + "f 1 2\n", "E0643");
    expect_refused(read_obj, vertices + "f 1 2 x\n", "E0643");
    expect_refused(read_obj, vertices + "f 1 2 99999999999999999999\n", "E0643");
    expect_refused(read_obj, vertices, "E0647");
    std::string round = vertices + "f";
    for (int i = 0; i < 300; ++i) round += " 1";
    expect_refused(read_obj, round, "E0643");
}

// ---- PLY
// -------------------------------------------------------------------------------------------------------------

/// With colours, normals and an element nobody knows, as programs write them.
std::string ply_header(const std::string& format, const std::string& count_type = "uchar",
                       const std::string& index_type = "int") {
    return "ply\nformat " + format +
           " 1.0\ncomment by hand\nelement vertex 3\nproperty uchar red\nproperty double x\nproperty "
           "float y\nproperty float z\nelement material 1\nproperty list uint float shine\nproperty short "
           "kind\nelement face "
           "1\nproperty list " +
           count_type + " " + index_type + " vertex_indices\nproperty uchar flags\nend_header\n";
}
const std::string text_rows = "7 0 0 0.5\n7 1.25 0 0\n7 0 -2 0\n2 1.5 2.5 3\n3 0 1 2 9\n";

template <class Bytes>
std::string binary_rows(const Bytes& bytes) {
    std::string rows;
    for (const auto& [x, y, z] :
         std::vector<std::tuple<double, float, float>>{{0, 0.0f, 0.5f}, {1.25, 0.0f, 0.0f}, {0, -2.0f, 0.0f}})
        rows += bytes(std::uint8_t{7}) + bytes(x) + bytes(y) + bytes(z);
    rows += bytes(std::uint32_t{2}) + bytes(1.5f) + bytes(2.5f) + bytes(std::int16_t{3});
    return rows;
}

TEST(ReadPly, ReadsTextAndBothOrdersOfBytes) {
    SurfaceError error;
    expect_corner(read_ply(ply_header("ascii") + text_rows, error), error);
    const auto little = [](auto value) { return little_endian(value); };
    const auto big = [](auto value) { return big_endian(value); };
    const auto face = [](auto bytes) {
        return bytes(std::uint8_t{3}) + bytes(std::int32_t{0}) + bytes(std::int32_t{1}) + bytes(std::int32_t{2}) +
               bytes(std::uint8_t{9});
    };
    expect_corner(read_ply(ply_header("binary_little_endian") + binary_rows(little) + face(little), error), error);
    expect_corner(read_ply(ply_header("binary_big_endian") + binary_rows(big) + face(big), error), error);
}
TEST(ReadPly, ReadsIndicesOfEveryWholeType) {
    const auto little = [](auto value) { return little_endian(value); };
    const auto expect_read = [&](const char* type, auto number) {
        using Number = decltype(number);
        SurfaceError error;
        const std::string face =
            little(Number{3}) + little(Number{0}) + little(Number{1}) + little(Number{2}) + little(std::uint8_t{9});
        expect_corner(read_ply(ply_header("binary_little_endian", type, type) + binary_rows(little) + face, error),
                      error);
    };
    expect_read("char", std::int8_t{});
    expect_read("uint8", std::uint8_t{});
    expect_read("short", std::int16_t{});
    expect_read("uint16", std::uint16_t{});
    expect_read("int32", std::int32_t{});
    expect_read("uint", std::uint32_t{});
}
TEST(ReadPly, CutsQuadsInTwo) {
    SurfaceError error;
    const auto surface =
        read_ply("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
                 error);
    ASSERT_TRUE(surface) << error.message;
    EXPECT_EQ(surface->mesh.triangles.size(), 2u);
    EXPECT_DOUBLE_EQ(area_of(surface->mesh), 1.0);
}
TEST(ReadPly, RefusesCountsThatTheFileCannotHold) {
    for (const char* row : {"element vertex 3", "element material 1", "element face 1"}) {
        std::string lies = ply_header("binary_little_endian") + text_rows;
        const std::size_t at = lies.find(row) + std::string(row).size();
        lies.insert(at, "000000000000000");
        expect_refused(read_ply, lies, "E0644");
    }
    expect_refused(read_ply, "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n", "E0647");
}
TEST(ReadPly, RefusesWhatIsCutOff) {
    const std::string whole = ply_header("ascii") + text_rows;
    for (std::size_t size = 4; size + 4 < whole.size(); ++size) {
        SurfaceError error;
        EXPECT_FALSE(read_ply(whole.substr(0, size), error)) << size;
        EXPECT_NE(error.code, nullptr);
    }
}
TEST(ReadPly, RefusesVerticesThatAreNotThere) {
    for (const char* face : {"3 0 1 3 9", "3 0 -1 2 9", "3 0 1.5 2 9", "3 0 nan 2 9"}) {
        std::string wrong = ply_header("ascii") + text_rows;
        wrong.replace(wrong.find("3 0 1 2 9"), 9, face);
        expect_refused(read_ply, wrong, "E0646");
    }
}
TEST(ReadPly, RefusesWhatItCannotUnderstand) {
    const std::string whole = ply_header("ascii") + text_rows;
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"ply\n", "plx\n"},
                                                                                   {"ascii", "latin"},
                                                                                   {"1.0", "2.0"},
                                                                                   {"list uchar", "list float"},
                                                                                   {"double x", "double a"},
                                                                                   {"vertex_indices", "corners"},
                                                                                   {"float z", "quad z"},
                                                                                   {"3 0 1 2", "2 0 1"},
                                                                                   {"3 0 1 2", "-1"},
                                                                                   {"3 0 1 2", "4000000000 1"}}) {
        std::string wrong = whole;
        wrong.replace(wrong.find(from), from.size(), to);
        SurfaceError error;
        EXPECT_FALSE(read_ply(wrong, error)) << to;
    }
}

// ---- what headers say of the coordinates

/// The field of each format's specification that changes geometry: honoured or refused.
TEST(HeaderFields, OfSurfaces) {
    const auto stl = [](const std::string& header) { return test::binary_stl(corner_mesh(), header); };
    const auto text = [](const std::string& header) { return "solid " + header + text_stl.substr(5); };
    const auto obj = [](const std::string& line) { return line + "\nv 0 0 0.5\nv 1.25 0 0\nv 0 -2 0\nf 1 2 3\n"; };
    const auto ply = [](const std::string& line) {
        std::string bytes = ply_header("ascii") + text_rows;
        return bytes.replace(bytes.find("comment by hand"), 15, line);
    };
    struct Field {
        decltype(&read_stl) read;
        std::string bytes;
        std::optional<bool> is_ras = {};
        std::optional<double> unit = {};
        const char* code = nullptr;  ///< of the refusal; none: it is honoured
    };
    const std::vector<Field> fields{
        // The frame, as 3D Slicer writes it
        {read_stl, stl("3D Slicer output. SPACE=RAS"), true},
        {read_stl, stl("3D Slicer output. SPACE=LPS"), false},
        {read_stl, stl("made by hand")},
        {read_stl, stl("COLORSPACE=RGB")},
        {read_stl, stl("SPACE=XYZ"), {}, {}, "E0654"},
        {read_stl, stl("SPACE=RAS SPACE=LPS"), {}, {}, "E0654"},
        {read_stl, text("3D Slicer output. SPACE=RAS"), true},
        {read_stl, "\xef\xbb\xbf" + text("space = lps"), false},
        {read_obj, obj("# 3D Slicer output. SPACE=RAS"), true},
        {read_obj, obj("#SPACE=LPS"), false},
        {read_obj, obj("# SPACE=RAS\n# SPACE=LPS"), {}, {}, "E0654"},
        {read_ply, ply("comment 3D Slicer output. SPACE=RAS"), true},
        {read_ply, ply("obj_info SPACE=LPS"), false},
        {read_ply, ply("comment SPACE=?"), {}, {}, "E0654"},
        // The unit
        {read_stl, stl("UNITS=mm"), {}, 1e-3},
        {read_obj, obj("# unit = meters"), {}, 1.0},
        {read_ply, ply("comment UNITS=cm"), {}, 1e-2},
        {read_stl, stl("UNITS=inch"), {}, {}, "E0654"},
        // The order of bytes and the types are read above. What is no polygon is refused.
        {read_ply, ply("element tristrips 1\nproperty list int int vertex_indices"), {}, {}, "E0643"},
        {read_obj, obj("surf 0 1 0 1 1 2 3"), {}, {}, "E0643"},
        {read_obj, obj("v 0 0 0 0.5"), {}, {}, "E0643"},  // the weight of a curved surface
        {read_obj, obj("call other.obj"), {}, {}, "E0643"},
        {read_obj, obj("o part\ng left\ns 1\nmtllib a.mtl\nvt 0 0\nvn 0 0 1")},  // no geometry
    };
    for (const Field& field : fields) {
        SCOPED_TRACE(field.bytes.substr(0, 60));
        if (field.code) {
            expect_refused(field.read, field.bytes, field.code);
            continue;
        }
        SurfaceError error;
        const auto file = field.read(field.bytes, error);
        expect_corner(file, error);
        if (!file) continue;
        EXPECT_EQ(file->is_ras, field.is_ras);
        EXPECT_EQ(file->unit, field.unit);
    }
}

TEST(ReadObj, ReadsStatementsOverSeveralLinesAndRemarksBehindThem) {
    const char* const vertices[]{"v 0 0 \\\n 0.5\nv 1.25 0\\\n 0\nv 0 \\\r\n-2 \\\n0 # last\n",
                                 "# ends in a backslash \\\nv 0 0 0.5\nv 1.25 0 0\nv 0 -2 0 0.1 0.2 0.3\n",
                                 "v 0 0 0.5\rv 1.25 0 0\rv 0 -2 0\r"};
    for (const char* text : vertices)
        for (const char* face : {"f 1 2 3 # a face", "f 1 \\\n 2\\\n 3", "f 1 2 3 #4", "fo 1 2 3", "f 1 2 3\\\n"}) {
            SCOPED_TRACE(std::string(text) + face);
            SurfaceError error;
            expect_corner(read_obj(std::string(text) + face, error), error);
        }
}

TEST(ReadStl, ReadsTextBehindAByteOrderMark) {
    SurfaceError error;
    expect_corner(read_stl("\xef\xbb\xbf" + text_stl, error), error);
    expect_corner(read_ply("\xef\xbb\xbf" + ply_header("ascii") + text_rows, error), error);
    std::string wide = "\xff\xfe";
    for (const char c : text_stl) wide += std::string(1, c) + '\0';
    expect_refused(read_stl, wide, "E0643");
}

TEST(ReadStl, ReadsLinesThatEndWithCarriageReturns) {
    std::string text = text_stl;
    for (char& c : text)
        if (c == '\n') c = '\r';
    SurfaceError error;
    expect_corner(read_stl(text, error), error);
}

// ---- damage
// ----------------------------------------------------------------------------------------------------------

/// Whatever comes out can be used: its faces name vertices that are there and finite.
template <class Read>
void expect_sound_or_refused(const Read& read, const std::string& bytes) {
    SurfaceError error;
    const std::optional<SurfaceFile> file = read(bytes, error);
    if (!file) {
        ASSERT_NE(error.code, nullptr);
        return;
    }
    ASSERT_FALSE(file->mesh.triangles.empty());
    for (const Vec3 v : file->mesh.vertices) ASSERT_TRUE(is_finite(v));
    for (const Triangle& t : file->mesh.triangles)
        for (const std::uint32_t v : t) ASSERT_LT(v, file->mesh.vertices.size());
}

TEST(DamagedFiles, AreRefusedOrReadWithSoundIndices) {
    const auto little = [](auto value) { return little_endian(value); };
    const std::string face = little(std::uint8_t{3}) + little(std::int32_t{0}) + little(std::int32_t{1}) +
                             little(std::int32_t{2}) + little(std::uint8_t{9});
    const std::string obj = "v 0 0 0.5\nv 1.25 0 0\nv 0 -2e0 0\nv 1 1 1\nf 1//2 2 3/1 -1\nf -4 -3 -2\n";
    const std::vector<std::pair<decltype(&read_stl), std::string>> sound{
        {read_stl, text_stl},
        {read_stl, test::binary_stl(test::cube(1.0))},
        {read_obj, obj},
        {read_ply, ply_header("ascii") + text_rows},
        {read_ply, ply_header("binary_little_endian") + binary_rows(little) + face}};
    std::mt19937 random(7);
    for (const auto& [read, whole] : sound)
        for (int trial = 0; trial < 4000; ++trial) {
            std::string bytes = whole;
            for (auto changes = 1 + random() % 4; changes > 0; --changes) {
                const std::size_t at = random() % bytes.size();
                switch (random() % 4) {
                    case 0:
                        bytes[at] = static_cast<char>(random());
                        break;
                    case 1:
                        bytes[at] = "0123456789-.e/ \n"[random() % 16];
                        break;
                    case 2:
                        bytes.erase(at, 1 + random() % 9);
                        break;
                    default:
                        bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 30));
                }
                if (bytes.empty()) bytes = " ";
            }
            expect_sound_or_refused(read, bytes);
        }
}

// ---- files
// -----------------------------------------------------------------------------------------------------------

TEST(ReadSurface, KnowsTheFormatByTheEnding) {
    const test::TemporaryFolder folder;
    text::Diagnostics diagnostics;
    std::ofstream(folder / "BONE.STL", std::ios::binary) << test::binary_stl(corner_mesh());
    EXPECT_TRUE(read_surface(folder / "BONE.STL").take(diagnostics)) << to_text(diagnostics);
    std::ofstream(folder / "bone.step") << "ISO-10303-21;";
    EXPECT_FALSE(read_surface(folder / "bone.step").take(diagnostics));
    EXPECT_EQ(diagnostics.at(0).code, "E0641");
}
TEST(ReadSurface, RefusesWhatIsNoFile) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "bone.ply");
    for (const char* name : {"none.stl", "bone.ply"}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_surface(folder / name).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "E0640");
    }
}
TEST(ReadSurface, ReadsAPointAsAPointWhateverTheLocale) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    const bool is_there = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    SurfaceError error;
    expect_corner(read_stl(text_stl, error), error);
    std::setlocale(LC_ALL, before.c_str());
    if (!is_there) GTEST_SKIP() << "this machine has no locale with a decimal comma";
}

}  // namespace
}  // namespace kerf::bone
