// SPDX-License-Identifier: Apache-2.0
// STL, OBJ and PLY.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/bad_inputs/input.h"
#include "tests/bone/surface/shapes.h"
#include "tests/support/dicom_writer.h"

namespace kerf::test {
namespace {

using Make = std::function<void(const std::string&)>;

/// The bone's surface [mm], its faces looking outwards, and others like it: scaled about the origin, then moved.
bone::SurfaceMesh block(double scale = 1.0, Vec3 move = {}) {
    bone::SurfaceMesh mesh = cube(1.0);
    for (Vec3& v : mesh.vertices) {
        const double at[]{v.x, v.y, v.z};
        double to[3];
        for (int i = 0; i < 3; ++i) to[i] = at[i] < 0 ? Bone::low[i] : Bone::high[i];
        v = scale * Vec3{to[0], to[1], to[2]} + move;
    }
    return mesh;
}
bone::SurfaceMesh with_signs(bone::SurfaceMesh mesh, double x, double y, double z) {
    for (Vec3& v : mesh.vertices) v = {x * v.x, y * v.y, z * v.z};
    return x * y * z < 0 ? turned(mesh) : mesh;
}
bone::SurfaceMesh without_faces(bone::SurfaceMesh mesh, std::size_t count) {
    mesh.triangles.resize(mesh.triangles.size() - count);
    return mesh;
}

std::string text_of(Vec3 v) {
    return DicomWriter::decimal(v.x) + " " + DicomWriter::decimal(v.y) + " " + DicomWriter::decimal(v.z);
}

std::string ascii_stl(const bone::SurfaceMesh& mesh, const std::string& end = "\n") {
    std::string text = "solid bone of somebody" + end;
    for (const bone::Triangle& t : mesh.triangles) {
        text += "facet normal 0 0 0" + end + " outer loop" + end;
        for (const Vec3 p : mesh.corners(t)) text += "  vertex " + text_of(p) + end;
        text += " endloop" + end + "endfacet" + end;
    }
    return text + "endsolid" + end;
}

std::string obj(const bone::SurfaceMesh& mesh, const std::string& end = "\n", const std::string& more = "") {
    std::string text;
    for (const Vec3 v : mesh.vertices) text += "v " + text_of(v) + end;
    for (const bone::Triangle& t : mesh.triangles) {
        text += "f";
        for (const std::uint32_t corner : t) text += " " + std::to_string(corner + 1) + more;
        text += end;
    }
    return text;
}

/// Four corners to a face; numbers from the front or from the back.
std::string obj_of_quads(bool counts_backwards) {
    const bone::SurfaceMesh mesh = block();
    std::string text;
    for (const Vec3 v : mesh.vertices) text += "v " + text_of(v) + "\n";
    const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : corners) {
        text += "f";
        for (const int corner : face) text += " " + std::to_string(counts_backwards ? corner - 8 : corner + 1);
        text += "\n";
    }
    return text;
}

/// PLY in one of its three forms; `count` is what the header promises of faces.
std::string ply(const bone::SurfaceMesh& mesh, const std::string& form, int count = -1, const std::string& end = "\n") {
    std::string text = "ply" + end + "format " + form + " 1.0" + end + "comment of somebody" + end + "element vertex " +
                       std::to_string(mesh.vertices.size()) + end + "property float x" + end + "property float y" +
                       end + "property float z" + end + "property uchar red" + end + "element face " +
                       std::to_string(count < 0 ? static_cast<int>(mesh.triangles.size()) : count) + end +
                       "property list uchar int vertex_indices" + end + "end_header" + end;
    const bool is_big = form == "binary_big_endian", is_text = form == "ascii";
    const auto add = [&](auto number) { text += is_big ? big_endian(number) : little_endian(number); };
    for (const Vec3 v : mesh.vertices) {
        if (is_text) {
            text += text_of(v) + " 255" + end;
            continue;
        }
        for (const double x : {v.x, v.y, v.z}) add(static_cast<float>(x));
        text += '\xff';
    }
    for (const bone::Triangle& t : mesh.triangles) {
        text += is_text ? "3" : "\3";
        for (const std::uint32_t corner : t) {
            if (is_text)
                text += " " + std::to_string(corner);
            else
                add(corner);
        }
        if (is_text) text += end;
    }
    return text;
}

Make file(const std::string& name, const std::string& bytes) {
    return [=](const std::string& folder) { write_file_of(folder + "/" + name, bytes); };
}

/// A strip that is turned once: it has one side.
std::string moebius_strip() {
    std::string text;
    for (int i = 0; i < 12; ++i) {
        const double turn = 2.0 * 3.14159265358979 * i / 12.0, half = 0.5 * turn;
        for (const double side : {-4.0, 4.0}) {
            const double out = 15.0 + side * std::cos(half);
            text += "v " + text_of({out * std::cos(turn), out * std::sin(turn), side * std::sin(half)}) + "\n";
        }
    }
    for (int i = 0; i < 12; ++i) {
        const int a = 2 * i + 1, b = a + 1, c = i == 11 ? 2 : a + 2, d = i == 11 ? 1 : a + 3;
        for (const auto& face : {std::array{a, c, b}, {c, d, b}})
            text +=
                "f " + std::to_string(face[0]) + " " + std::to_string(face[1]) + " " + std::to_string(face[2]) + "\n";
    }
    return text;
}

bone::SurfaceMesh with_spoilt(bone::SurfaceMesh mesh, double value) {
    mesh.vertices[3].y = value;
    return mesh;
}

}  // namespace

std::vector<Input> surface_inputs() {
    const bone::SurfaceMesh bone = block();
    const double nan = std::nan(""), none = HUGE_VAL;
    const std::string lps = "frame: LPS";
    bone::SurfaceMesh with_flaws = bone;
    with_flaws.triangles.push_back(bone.triangles[0]);  // twice
    with_flaws.triangles.push_back({1, 1, 5});          // collapsed
    with_flaws.vertices.push_back({900, 900, 900});     // used by nothing
    bone::SurfaceMesh half_turned = bone;
    for (std::size_t n = 0; n < 12; n += 3) std::swap(half_turned.triangles[n][1], half_turned.triangles[n][2]);
    bone::SurfaceMesh crowded = bone;
    crowded.vertices.push_back({2, -3, 12});
    crowded.triangles.push_back({4, 5, 8});
    std::string lying = binary_stl(bone), wide_header = binary_stl(bone, "solid made by a program that lies");
    lying.replace(80, 4, little_endian(std::uint32_t{4'000'000'000u}));
    std::string fewer = binary_stl(bone);
    fewer.replace(80, 4, little_endian(std::uint32_t{3}));
    bone::SurfaceMesh grains = together(bone, cube(0.5, {14, 0, 0}));
    const std::string huge_list =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
        std::string(36, '\0') + "\xff\xff\xff\xff";
    return {
        {"STL, binary", Way::surface, "a.stl", file("a.stl", binary_stl(bone)), "loaded", "", lps},
        {"STL, text", Way::surface, "a.stl", file("a.stl", ascii_stl(bone)), "loaded", "", lps},
        {"STL, text with CR LF", Way::surface, "a.stl", file("a.stl", ascii_stl(bone, "\r\n")), "loaded", "", lps},
        {"STL, text with CR alone", Way::surface, "a.stl", file("a.stl", ascii_stl(bone, "\r")), "loaded", "", lps},
        {"STL, binary that begins with solid", Way::surface, "a.stl", file("a.stl", wide_header), "loaded", "", lps},
        {"STL, a capital ending", Way::surface, "A.STL", file("A.STL", binary_stl(bone)), "loaded", "", lps},
        {"STL, RAS", Way::surface, "a.stl", file("a.stl", binary_stl(with_signs(bone, -1, -1, 1))), "loaded", "",
         "frame: RAS"},
        {"STL, no frame said", Way::surface, "a.stl", file("a.stl", binary_stl(bone)), "loaded", ""},
        {"STL, centimetres", Way::surface, "a.stl", file("a.stl", binary_stl(block(0.1))), "loaded", "",
         "unit: cm, frame: LPS"},
        {"STL, metres", Way::surface, "a.stl", file("a.stl", binary_stl(block(0.001))), "loaded", "",
         "unit: m, frame: LPS"},
        {"STL, micrometres", Way::surface, "a.stl", file("a.stl", binary_stl(block(1000.0))), "loaded", "",
         "unit: um, frame: LPS"},
        {"STL, millimetres called metres", Way::surface, "a.stl", file("a.stl", binary_stl(block(1.0, {90, 0, 0}))),
         "E0652", "write `unit: mm`", "unit: m, frame: LPS, repair: {holes_up_to: 1 mm}"},
        {"STL, all faces inside out", Way::surface, "a.stl", file("a.stl", binary_stl(turned(bone))), "loaded", "",
         lps},
        {"STL, every third face inside out", Way::surface, "a.stl", file("a.stl", binary_stl(half_turned)), "loaded",
         "", lps},
        {"STL, open", Way::surface, "a.stl", file("a.stl", binary_stl(without_faces(bone, 2))), "E0649", "hole", lps},
        {"STL, one face missing, closed as told", Way::surface, "a.stl",
         file("a.stl", binary_stl(without_faces(bone, 1))), "loaded", "", "frame: LPS, repair: {holes_up_to: 20 mm}"},
        {"STL, faces twice, collapsed, and a vertex too many", Way::surface, "a.stl",
         file("a.stl", binary_stl(with_flaws)), "loaded", "", lps},
        {"STL, a count that lies upwards", Way::surface, "a.stl", file("a.stl", lying), "E0644",
         "promises 4000000000 faces", lps},
        {"STL, a count that lies downwards", Way::surface, "a.stl", file("a.stl", fewer), "E0643",
         "more faces than the 3", lps},
        {"STL, cut short", Way::surface, "a.stl", file("a.stl", binary_stl(bone).substr(0, 500)), "E0644",
         "promises 12 faces", lps},
        {"STL, text cut short", Way::surface, "a.stl", file("a.stl", ascii_stl(bone).substr(0, 700)), "E0643", "line",
         lps},
        {"STL, text cut short between faces", Way::surface, "a.stl",
         file("a.stl", ascii_stl(bone).substr(0, ascii_stl(bone).find("endsolid"))), "E0644", "ends in the middle",
         lps},
        {"STL, a corner that is no number", Way::surface, "a.stl", file("a.stl", binary_stl(with_spoilt(bone, nan))),
         "E0645", "no finite number", lps},
        {"STL, a corner that is infinite", Way::surface, "a.stl", file("a.stl", binary_stl(with_spoilt(bone, none))),
         "E0645", "no finite number", lps},
        {"STL, no faces", Way::surface, "a.stl", file("a.stl", binary_stl(bone::SurfaceMesh{})), "E0647", "no face",
         lps},
        {"STL, text without faces", Way::surface, "a.stl", file("a.stl", "solid\nendsolid\n"), "E0647", "no face", lps},
        {"STL, an empty file", Way::surface, "a.stl", file("a.stl", ""), "E0644", "at least 84", lps},
        {"STL, far away", Way::surface, "a.stl", file("a.stl", binary_stl(block(1.0, {5e5, 0, 0}))), "E0652",
         "lie outside the surface", "frame: LPS, repair: {holes_up_to: 1 mm}"},
        {"STL, a decimal comma", Way::surface, "a.stl", file("a.stl", with_replaced(ascii_stl(bone), "-4.5", "-4,5")),
         "E0643", "no three numbers", lps},
        {"STL, another format under its name", Way::surface, "a.stl", file("a.stl", ply(bone, "ascii")), "E0644",
         "faces", lps},
        {"STL, a grain beside the bone, left out as told", Way::surface, "a.stl", file("a.stl", binary_stl(grains)),
         "loaded", "", "frame: LPS, repair: {pieces_under: 1 mm3}"},
        {"STL, two parts that cut through each other", Way::surface, "a.stl",
         file("a.stl", binary_stl(together(bone, cube(4.0, {7.9, -3.0, -3.0})))), "E0659", " cross near ",
         "frame: LPS, repair: {inner: solid}"},
        {"STL, a ball inside", Way::surface, "a.stl", file("a.stl", binary_stl(together(bone, cube(3.0, {6, -6, -6})))),
         "E0653", "inside another", lps},
        {"OBJ, triangles", Way::surface, "a.obj", file("a.obj", obj(bone)), "loaded", "", lps},
        {"OBJ, quads", Way::surface, "a.obj", file("a.obj", obj_of_quads(false)), "loaded", "", lps},
        {"OBJ, indices from the back", Way::surface, "a.obj", file("a.obj", obj_of_quads(true)), "loaded", "", lps},
        {"OBJ, textures and normals", Way::surface, "a.obj",
         file("a.obj", "mtllib somebody.mtl\no bone\nvt 0 0\nvn 0 0 1\n" + obj(bone, "\n", "/1/1")), "loaded", "", lps},
        {"OBJ, CR LF", Way::surface, "a.obj", file("a.obj", obj(bone, "\r\n")), "loaded", "", lps},
        {"OBJ, a byte order mark", Way::surface, "a.obj", file("a.obj", "\xef\xbb\xbf" + obj(bone)), "loaded", "", lps},
        {"OBJ, an index of 0", Way::surface, "a.obj", file("a.obj", with_replaced(obj(bone), "f 1 3 4", "f 0 3 4")),
         "E0646", "names vertex 0", lps},
        {"OBJ, an index behind the last", Way::surface, "a.obj",
         file("a.obj", with_replaced(obj(bone), "f 1 3 4", "f 9 3 4")), "E0646", "names vertex 9", lps},
        {"OBJ, an index that no number holds", Way::surface, "a.obj",
         file("a.obj", with_replaced(obj(bone), "f 1 3 4", "f 99999999999999999999 3 4")), "E0643", "no whole number",
         lps},
        {"OBJ, a coordinate that is no number", Way::surface, "a.obj",
         file("a.obj", with_replaced(obj(bone), "-4.5", "nan")), "E0645", "no finite number", lps},
        {"OBJ, a coordinate that no number holds", Way::surface, "a.obj",
         file("a.obj", with_replaced(obj(bone), "-4.5", "1e999")), "E0645", "no finite number", lps},
        {"OBJ, a face of two corners", Way::surface, "a.obj", file("a.obj", obj(bone) + "f 1 2\n"), "E0643",
         "fewer than three", lps},
        {"OBJ, faces before vertices", Way::surface, "a.obj", file("a.obj", "f 1 2 3\n" + obj(bone)), "E0646",
         "before it there are 0", lps},
        {"OBJ, points alone", Way::surface, "a.obj", file("a.obj", "v 0 0 0\nv 1 0 0\n"), "E0647", "no face", lps},
        {"OBJ, a fin on an edge", Way::surface, "a.obj", file("a.obj", obj(crowded)), "E0650", "no common inside", lps},
        {"OBJ, a strip with one side", Way::surface, "a.obj", file("a.obj", moebius_strip()), "E0651", "outwards", lps},
        {"OBJ, a line of 20 MB", Way::surface, "a.obj", file("a.obj", "v " + std::string(20u << 20, '1') + " 0 0\n"),
         "E0645", "no finite number", lps},
        {"OBJ, a face of a million corners", Way::surface, "a.obj",
         file("a.obj",
              [] {
                  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
                  for (int n = 0; n < 1'000'000; ++n) text += " 1";
                  return text + "\n";
              }()),
         "E0643", "corners", lps},
        {"PLY, text", Way::surface, "a.ply", file("a.ply", ply(bone, "ascii")), "loaded", "", lps},
        {"PLY, text with CR LF", Way::surface, "a.ply", file("a.ply", ply(bone, "ascii", -1, "\r\n")), "loaded", "",
         lps},
        {"PLY, little endian", Way::surface, "a.ply", file("a.ply", ply(bone, "binary_little_endian")), "loaded", "",
         lps},
        {"PLY, big endian", Way::surface, "a.ply", file("a.ply", ply(bone, "binary_big_endian")), "loaded", "", lps},
        {"PLY, big endian that says little", Way::surface, "a.ply",
         file("a.ply", with_replaced(ply(bone, "binary_big_endian"), "big", "little")), "E0646", "none of the 8", lps},
        {"PLY, more faces promised than there are", Way::surface, "a.ply",
         file("a.ply", ply(bone, "binary_little_endian", 2'000'000'000)), "E0644", "2000000000 rows of `face`", lps},
        {"PLY, text that ends early", Way::surface, "a.ply", file("a.ply", ply(bone, "ascii", 13)), "E0644",
         "13 rows of `face`", lps},
        {"PLY, a list of 4 billion corners", Way::surface, "a.ply", file("a.ply", huge_list), "E0643", "corners", lps},
        {"PLY, no end of the header", Way::surface, "a.ply",
         file("a.ply", with_replaced(ply(bone, "ascii"), "end_header", "comment")), "E0643", "PLY's words", lps},
        {"PLY, cut in its header", Way::surface, "a.ply",
         file("a.ply", ply(bone, "ascii").substr(0, ply(bone, "ascii").find("property uchar"))), "E0644",
         "before `end_header`", lps},
        {"PLY, vertices without z", Way::surface, "a.ply",
         file("a.ply", with_replaced(ply(bone, "ascii"), "property float z", "property float w")), "E0643",
         "no x, y and z", lps},
        {"PLY, points alone", Way::surface, "a.ply", file("a.ply", ply(without_faces(bone, 12), "ascii")), "E0647",
         "no face", lps},
        {"another format of surfaces", Way::surface, "a.off", file("a.off", "OFF"), "E0641",
         "none of .stl, .obj and .ply", "frame: LPS, repair: {holes_up_to: 1 mm}"},
        {"a folder called surface", Way::surface, "a.stl",
         [](const std::string& folder) { std::filesystem::create_directory(folder + "/a.stl"); }, "E0640",
         "this is a folder", lps},
    };
}

}  // namespace kerf::test
