// SPDX-License-Identifier: Apache-2.0
#include "tests/golden/odd_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "app/file_limit.h"
#include "bone/image/read_image.h"
#include "bone/import/make_body.h"
#include "documents/read_procedure.h"
#include "run/exact/exact_strategies.h"
#include "run/run_checks.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

void write(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

/// The block's document with `ct` instead of its phantom.
void write_anatomy(const std::string& folder, int code, const std::string& ct,
                   const std::string& midline = "9 0 0 mm") {
    std::string text = contents_of(folder + "/block.yaml");
    const std::size_t from = text.find("phantom:"), to = text.find("tissues:");
    text.replace(from, to - from, "ct: " + ct + "\n");
    text.replace(text.find("9 0 0 mm"), std::string("9 0 0 mm").size(), midline);
    char name[16];
    std::snprintf(name, sizeof name, "/E%04d.yaml", code);
    write(folder + name, text);
}

/// The block as a scanner would see it: 24 × 24 × 32 voxels of 1 mm, 1000 HU within 10 mm of the middle, −1000 around.
struct Scan {
    std::vector<std::pair<std::string, std::string>> header{{"NDims", "3"},
                                                            {"BinaryData", "True"},
                                                            {"TransformMatrix", "1 0 0 0 1 0 0 0 1"},
                                                            {"Offset", "-12 -12 -16"},
                                                            {"DimSize", "24 24 32"},
                                                            {"ElementSpacing", "1 1 1"},
                                                            {"ElementType", "MET_FLOAT"}};
    float odd = -1000.0f;  ///< of the first voxel
    std::size_t missing = 0;

    /// An empty value takes the key away.
    void set(const std::string& key, const std::string& value) {
        const auto found = std::find_if(header.begin(), header.end(), [&](const auto& h) { return h.first == key; });
        if (found == header.end())
            header.emplace_back(key, value);
        else if (value.empty())
            header.erase(found);
        else
            found->second = value;
    }

    void write_to(const std::string& file) const {
        std::ofstream out(file, std::ios::binary);
        out << "ObjectType = Image\n";
        for (const auto& [key, value] : header) out << key << " = " << value << "\n";
        out << "ElementDataFile = LOCAL\n";
        std::string bytes;
        for (int k = -16; k < 16; ++k)
            for (int j = -12; j < 12; ++j)
                for (int i = -12; i < 12; ++i) {
                    const float value = bytes.empty()                                             ? odd
                                        : std::max({std::abs(i), std::abs(j), std::abs(k)}) <= 10 ? 1000.0f
                                                                                                  : -1000.0f;
                    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
                }
        out << bytes.substr(0, bytes.size() - missing);
    }
};

/// Labels of the scan's grid, of its lowest `slices`: 1 in the block, and the value of one voxel above it.
void write_labels(const std::string& file, int slices, char island) {
    std::string header = "NRRD0005\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 24 24 " +
                         std::to_string(slices) +
                         "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nspace origin: (-12,-12,-16)\n\n";
    for (int k = -16; k < slices - 16; ++k)
        for (int j = -12; j < 12; ++j)
            for (int i = -12; i < 12; ++i) {
                const bool is_block = std::max({std::abs(i), std::abs(j), std::abs(k)}) <= 10;
                header += is_block ? '\1' : i == 0 && j == 0 && k == 13 ? island : '\0';
            }
    write(file, header);
}

std::function<void(const std::string&)> labels_with(int code, int slices, char island) {
    return [=](const std::string& folder) {
        Scan().write_to(folder + "/scan.mha");
        write_labels(folder + "/labels.nrrd", slices, island);
        write_anatomy(folder, code, "{image: scan.mha, threshold: 0, labels: {file: labels.nrrd, keep: [1]}}");
    };
}

constexpr const char* plain_ct = "{image: scan.mha, threshold: 0}";

std::function<void(const std::string&)> scan_with(int code, const std::string& key, const std::string& value,
                                                  const std::string& ct = plain_ct) {
    return [=](const std::string& folder) {
        Scan scan;
        scan.set(key, value);
        scan.write_to(folder + "/scan.mha");
        write_anatomy(folder, code, ct);
    };
}

/// The block as slices, one change at a time.
struct Slices {
    std::vector<DicomWriter> files;

    explicit Slices(const std::vector<double>& heights = {-16, -12, -8, -4, 0, 4, 8, 12, 16}, double tilt = 0.0) {
        for (std::size_t n = 0; n < heights.size(); ++n) {
            std::vector<int> values;
            for (int r = 0; r < 12; ++r)
                for (int c = 0; c < 12; ++c) {
                    const double x = -22.0 + 4 * c, y = -22.0 + 4 * r + tilt * heights[n];
                    values.push_back(std::max({std::abs(x), std::abs(y), std::abs(heights[n])}) <= 10 ? 1000 : -1000);
                }
            files.push_back(
                ct_slice(12, 12, 4.0, {-22, -22 + tilt * heights[n], heights[n]}, static_cast<int>(n) + 1, values));
        }
    }
    void write_to(const std::string& folder) const {
        std::filesystem::create_directory(folder);
        for (std::size_t n = 0; n < files.size(); ++n) files[n].write(folder + "/IM" + std::to_string(n));
    }
};

std::function<void(const std::string&)> slices(int code, const std::function<void(Slices&)>& change,
                                               const std::string& more = "") {
    return [=](const std::string& folder) {
        Slices series;
        change(series);
        series.write_to(folder + "/scan");
        write_anatomy(folder, code, "{image: scan, threshold: 0" + more + "}");
    };
}

void add_series_7(Slices& all) {
    for (DicomWriter& file : Slices({-4, 0, 4}).files)
        all.files.push_back(file.uid(tag::series, "1.2.3.9").text(tag::series_number, "IS", "7"));
}

/// A closed surface in Wavefront's format: cubes of some size around places, and whatever is appended.
struct Surface {
    std::string text;
    int vertices = 0;

    Surface& cube(double size, double x, double y, double z, bool is_inwards = false, int faces = 6) {
        return box(size, size, x, y, z, is_inwards, faces);
    }
    /// `size` wide and long, `height` high.
    Surface& box(double size, double height, double x, double y, double z, bool is_inwards = false, int faces = 6) {
        for (int i = 0; i < 8; ++i)
            vertex(x + (i & 1 ? 0.5 : -0.5) * size, y + (i & 2 ? 0.5 : -0.5) * size, z + (i & 4 ? 0.5 : -0.5) * height);
        const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        for (int f = 0; f < faces; ++f) {
            text += "f";
            for (int c = 0; c < 4; ++c) text += " " + std::to_string(vertices - 7 + corners[f][is_inwards ? 3 - c : c]);
            text += "\n";
        }
        return *this;
    }
    void vertex(double x, double y, double z) {
        text += "v " + DicomWriter::decimal(x) + " " + DicomWriter::decimal(y) + " " + DicomWriter::decimal(z) + "\n";
        ++vertices;
    }
};

/// The block's document with a surface in place of its phantom.
std::function<void(const std::string&)> surface(int code, const std::string& text,
                                                const std::string& file = "block.obj",
                                                const std::string& more = "unit: mm, frame: LPS") {
    return [=](const std::string& folder) {
        write(folder + "/" + file, text);
        write_anatomy(folder, code, "");
        char name[16];
        std::snprintf(name, sizeof name, "/E%04d.yaml", code);
        std::string document = contents_of(folder + name);
        document.replace(document.find("ct: "), 4, "mesh: {file: " + file + ", " + more + "}");
        write(folder + name, document);
    };
}

std::string moebius_strip() {
    Surface strip;
    for (int i = 0; i < 12; ++i) {
        const double turn = 2.0 * 3.14159265358979 * i / 12.0, half = 0.5 * turn;
        for (const double side : {-4.0, 4.0}) {
            const double out = 15.0 + side * std::cos(half);
            strip.vertex(std::round(100 * out * std::cos(turn)) / 100, std::round(100 * out * std::sin(turn)) / 100,
                         std::round(100 * side * std::sin(half)) / 100);
        }
    }
    for (int i = 0; i < 12; ++i) {
        const int a = 2 * i + 1, b = a + 1, c = i == 11 ? 2 : a + 2, d = i == 11 ? 1 : a + 3;
        strip.text += "f " + std::to_string(a) + " " + std::to_string(c) + " " + std::to_string(b) + "\n";
        strip.text += "f " + std::to_string(c) + " " + std::to_string(d) + " " + std::to_string(b) + "\n";
    }
    return strip.text;
}

/// A surface that STL's four-byte numbers cannot place well: far from the origin.
std::string far_stl() {
    std::string bytes(80, '\0');
    const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const float x = 1000.0f, s = 10.0f;
    const float v[8][3] = {{x - s, -s, -s}, {x + s, -s, -s}, {x - s, s, -s}, {x + s, s, -s},
                           {x - s, -s, s},  {x + s, -s, s},  {x - s, s, s},  {x + s, s, s}};
    const int faces[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                              {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    put(std::uint32_t{12});
    for (const auto& face : faces) {
        for (int i = 0; i < 3; ++i) put(0.0f);
        for (const int corner : face)
            for (const float coordinate : v[corner]) put(coordinate);
        put(std::uint16_t{0});
    }
    return bytes;
}

/// The block's document with a file of markups beside its own landmarks.
std::function<void(const std::string&)> markups(int code, const std::string& text,
                                                const std::string& file = "entry.mrk.json") {
    return [=](const std::string& folder) {
        write(folder + "/" + file, text);
        std::string document = contents_of(folder + "/block.yaml");
        document.replace(document.find("landmarks:\n"), 11,
                         "landmarks:\n  markups: [{file: " + file + ", tolerance: 1 mm}]\n");
        char name[16];
        std::snprintf(name, sizeof name, "/E%04d.yaml", code);
        write(folder + name, document);
    };
}

documents::Anatomy block_of(double size) {
    documents::Anatomy anatomy;
    anatomy.file = "block.yaml";
    documents::PhantomPart part;
    part.id = "block";
    part.solid = documents::BoxSolid{{}, {size, size, size}};
    anatomy.phantom.parts.push_back(part);
    anatomy.tissues.push_back({.id = "bone", .source = ""});
    return anatomy;
}

}  // namespace

const std::map<int, std::function<void(const std::string&)>>& makers_of_input() {
    static const std::map<int, std::function<void(const std::string&)>> makers{
        {101, [](const std::string&) {}},
        {102, [](const std::string& folder) { write(folder + "/E0102.yaml", std::string((1u << 20) + 1, '#')); }},
        {103, [](const std::string& folder) { write(folder + "/E0103.yaml", "title: Knochenh\xF6hle\n"); }},
        {113, [](const std::string& folder) {
             std::string head(100, '\0');
             head.replace(0, 15, "SQLite format 3").replace(68, 4, "KERF");
             write(folder + "/E0113.yaml", head);
         }},
        {505, [](const std::string& folder) {
             std::string anatomy = contents_of(folder + "/block.yaml"), procedure = contents_of(folder + "/hole.yaml");
             anatomy.replace(anatomy.find("midline"), 7, "middle");
             write(folder + "/without-midline.yaml", anatomy);
             procedure.replace(procedure.find("block.yaml"), 10, "without-midline.yaml");
             procedure.replace(procedure.find("{depth: 12 mm}"), 14, "{depth: 12 mm, medial: 2 mm}");
             write(folder + "/E0505.yaml", procedure);
         }},
        {619, [](const std::string& folder) {
             write_anatomy(folder, 619, "{image: scan.mha, threshold: 0}");
             std::filesystem::create_symlink("/dev/null", folder + "/scan.mha");
         }},
        {621, [](const std::string& folder) {
             write(folder + "/scan.jpg", "no image");
             write_anatomy(folder, 621, "{image: scan.jpg, threshold: 0}");
         }},
        {622, scan_with(622, "DimSize", "")},
        {623, scan_with(623, "ElementNumberOfChannels", "3")},
        {624, scan_with(624, "DimSize", "5000 24 32")},
        {625, scan_with(625, "BinaryData", "False")},
        {626, [](const std::string& folder) {
             Scan scan;
             scan.missing = 1000;
             scan.write_to(folder + "/scan.mha");
             write_anatomy(folder, 626, plain_ct);
         }},
        {627, scan_with(627, "ElementSpacing", "1 1 0")},
        {629, [](const std::string& folder) {
             Scan scan;
             scan.odd = std::numeric_limits<float>::quiet_NaN();
             scan.write_to(folder + "/scan.mha");
             write_anatomy(folder, 629, plain_ct);
         }},
        {630, [](const std::string& folder) {
             Scan().write_to(folder + "/scan.mha");
             Scan labels;
             labels.set("Offset", "400 400 400");
             labels.write_to(folder + "/labels.mha");
             write_anatomy(folder, 630, "{image: scan.mha, threshold: 0, labels: {file: labels.mha, keep: [1000]}}");
         }},
        {631, scan_with(631, "Offset", "400 400 400")},
        {632, scan_with(632, "TransformMatrix", "1 0 0 0.6 0.8 0 0.48 0.64 0.6")},
        {633, scan_with(633, "Offset", "-12 -12 -16", "{image: scan.mha, threshold: 3000}")},
        {634, [](const std::string& folder) {
             Scan().write_to(folder + "/scan.mha");
             write_anatomy(folder, 634, "{image: scan.mha, threshold: 0, keep: {component_at: midline}}", "300 0 0 mm");
         }},
        {635, [](const std::string& folder) {
             Scan().write_to(folder + "/scan.mha");
             Scan().write_to(folder + "/labels.mha");
             write_anatomy(folder, 635, "{image: scan.mha, threshold: 0, labels: {file: labels.mha, keep: [L3]}}");
         }},
        {636, [](const std::string& folder) {
             Scan().write_to(folder + "/scan.mha");
             std::string header = "NRRD0005\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\n"
                                  "sizes: 24 24 32\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n"
                                  "space origin: (-12,-12,-16)\n";
             for (const char* n : {"0", "1"})
                 header += std::string("Segment") + n + "_Name:=bone\nSegment" + n + "_LabelValue:=" + (*n == '0' ? "3" : "4") + "\nSegment" + n + "_Layer:=0\n";
             write(folder + "/labels.seg.nrrd", header + "\n" + std::string(24 * 24 * 32, '\3'));
             write_anatomy(folder, 636, "{image: scan.mha, threshold: 0, labels: {file: labels.seg.nrrd, keep: [bone]}}");
         }},
        {637, [](const std::string& folder) {
             Scan().write_to(folder + "/scan.mha");
             write_anatomy(folder, 637, "{image: scan.mha, threshold: 0, labels: {file: scan.mha, keep: [1000]}}");
         }},
        {640, [](const std::string& folder) {
             surface(640, "")(folder);
             std::filesystem::remove(folder + "/block.obj");
             std::filesystem::create_directory(folder + "/block.obj");
         }},
        {641, surface(641, "OFF", "block.off")},
        {642, [](const std::string& folder) {
             surface(642, "", "block.stl")(folder);
             std::filesystem::resize_file(folder + "/block.stl", 1'100'000'000);  // of nothing: it takes no room
         }},
        {643, surface(643, "v 0 0\n")},
        {644, surface(644, std::string(80, ' ') + std::string("\x0c\0\0\0", 4), "block.stl")},
        {645, surface(645, "v 0 0 1e39\nv 0 0 nan\n")},
        {646, surface(646, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")},
        {647, surface(647, "v 0 0 0\nv 1 0 0\nv 0 1 0\n")},
        {648, surface(648, Surface().cube(200, 0, 0, -99).text, "block.obj", "unit: cm, frame: LPS")},
        {649, surface(649, Surface().cube(20, 0, 0, 0, false, 5).text)},
        {650, surface(650, Surface().cube(20, 0, 0, 0).text + "v 0 0 18\nf 5 6 9\n", "block.obj", "unit: mm, frame: LPS, repair: {holes_up_to: 20 mm}")},
        {651, surface(651, moebius_strip())},
        {652, surface(652, Surface().cube(20, 500, 0, 0).text)},
        {653, surface(653, Surface().cube(20, 0, 0, 0).cube(5, 5, 5, 5).text)},
        {654, surface(654, "# SPACE=RAS\n" + Surface().cube(20, 0, 0, 0).text)},
        {655, surface(655, Surface().cube(20, 0, 0, 0).box(12, 1, 0, 0, 12).text)},
        {658, surface(658, Surface().cube(20, 0, 0, 0).box(0.6, 0.4, 0, 0, 12).text)},
        {707, [](const std::string& folder) {
             surface(707, Surface().cube(100, 0, 0, 0).text)(folder);
             std::filesystem::rename(folder + "/E0707.yaml", folder + "/large.yaml");
             std::string procedure = contents_of(folder + "/W0706.yaml");
             procedure.replace(procedure.find("block.yaml"), 10, "large.yaml");
             procedure.replace(procedure.find("spacing: 1 mm"), 13, "spacing: 0.5 mm");
             procedure.replace(procedure.find("blade_thickness: 0.8 mm"), 23, "tooth_count: 40");
             write(folder + "/E0707.yaml", procedure);
         }},
        {710, [](const std::string& folder) {
             surface(710, Surface().cube(100, 0, 0, -40).text)(folder);
             std::filesystem::rename(folder + "/E0710.yaml", folder + "/large.yaml");
             std::string procedure = contents_of(folder + "/hole.yaml");
             procedure.replace(procedure.find("block.yaml"), 10, "large.yaml");
             procedure.replace(procedure.find("{depth: 12 mm}"), 14, "{depth: 44 mm}");
             write(folder + "/W0710.yaml", procedure);
         }},
        {656, surface(656, Surface().cube(20, 0, 0, 0).cube(20, 7, 6, 5, true).text)},
        {659, surface(659, Surface().cube(20, 0, 0, 0).cube(20, 7, 6, 5).text)},
        {657, surface(657, far_stl(), "block.stl", "unit: m, frame: LPS")},
        {686, surface(686, Surface().cube(20, 1'000'000, 0, 0).text)},
        {660, [](const std::string& folder) {
             std::filesystem::create_directory(folder + "/scan");
             write_anatomy(folder, 660, "{image: scan, threshold: 0}");
         }},
        {661, slices(661, add_series_7)},
        {662, slices(662, add_series_7, ", series: 5")},
        {663, slices(663, [](Slices& all) { all.files[3].number(tag::pixel_spacing, {4.5, 4.0}); })},
        {664, slices(664, [](Slices& all) { all.files.push_back(all.files[1].text(tag::instance, "IS", "17")); })},
        {665, slices(665, [](Slices& all) { all.files.erase(all.files.begin() + 4); })},
        {666, slices(666, [](Slices& all) { all.files[3].number(tag::position, {20, -22, -4}); })},
        {667, slices(667, [](Slices& all) { all.files[3].without(tag::pixel_spacing); })},
        {668, [](const std::string& folder) {
             Slices all;
             all.write_to(folder + "/scan");
             std::string bytes = all.files[1].bytes();
             bytes.insert(bytes.find(std::string("\x28\x00\x02\x00US", 6)), std::string("\x27\x00\x10\x00OB\x00\x00\x00\x00\x00\xc0", 12));
             write(folder + "/scan/IM1", bytes);  // a private element that promises 3 GB
             write_anatomy(folder, 668, "{image: scan, threshold: 0}");
         }},
        {669, slices(669, [](Slices& all) { all.files.resize(1); })},
        {670, [](const std::string& folder) {
             std::filesystem::create_directory(folder + "/scan");
             for (int i = 0; i <= 20'000; ++i) std::ofstream(folder + "/scan/" + std::to_string(i));
             write_anatomy(folder, 670, "{image: scan, threshold: 0}");
         }},
        {671, [](const std::string& folder) {
             Slices({-16, -12, -8, -4, 0, 4, 8, 12, 16}, 0.3).write_to(folder + "/scan");
             write_anatomy(folder, 671, "{image: scan, threshold: 0}");
         }},
        {672, [](const std::string& folder) {
             Slices({-16, -12, -8, -4, 0, 4.4, 8, 12.2, 16}).write_to(folder + "/scan");
             write_anatomy(folder, 672, "{image: scan, threshold: 0}");
         }},
        {673, slices(673, [](Slices& all) { for (DicomWriter& file : all.files) file.text(tag::modality, "CS", "MR"); })},
        {674, slices(674, [](Slices& all) { for (DicomWriter& file : all.files) file.fragment("1.2.840.10008.1.2.4.70", "rubbish"); })},
        {675, [](const std::string& folder) {
             Slices all;
             for (DicomWriter& file : all.files) file.number(tag::intercept, {0});
             all.write_to(folder + "/scan");
             write_anatomy(folder, 675, "{image: scan, threshold: 1024}");
         }},
        {678, labels_with(678, 18, '\0')},
        {679, labels_with(679, 32, '\1')},
        {676, slices(676, [](Slices& all) {
             for (std::size_t n = 0; n < all.files.size(); ++n) all.files[n].text(tag::acquisition, "IS", n % 2 == 0 ? "1" : "2");
         })},
        {677, slices(677, [](Slices& all) { for (DicomWriter& file : all.files) file.text(tag::acquisition, "IS", "1"); }, ", acquisition: 2")},
        {680, markups(680, "{}")},
        {681, markups(681, R"({"markups": [{"type": "Fiducial", "controlPoints": [{"label": "entry", "position": [0, 0, 10]}]}]})")},
        {682, markups(682, R"({"markups": [{"type": "Angle", "coordinateSystem": "LPS", "controlPoints": []}]})")},
        {683, markups(683, R"({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": [{"label": "midline", "position": [0, 0, 10]}]}]})")},
    };
    return makers;
}

const std::map<int, std::function<text::Diagnostics()>>& direct_causes() {
    static const std::map<int, std::function<text::Diagnostics()>> causes{
        {601,
         [] {
             text::Diagnostics found;
             documents::Anatomy anatomy = block_of(0.02);
             anatomy.phantom.parts[0].subtract = true;
             (void)bone::make_body(anatomy, 1e-3).take(found);
             return found;
         }},
        {602,
         [] {
             text::Diagnostics found;
             (void)bone::make_body(block_of(2.0), 0.05e-3).take(found);
             return found;
         }},
        {628,
         [] {
             text::Diagnostics found;
             const TemporaryFolder folder;
             const std::filesystem::path before = std::filesystem::current_path();
             std::filesystem::current_path(folder.path());
             Scan scan;
             scan.write_to("scan.mha");
             const auto header = bone::check_image_file("scan.mha").take(found);
             scan.missing = 1000;
             scan.write_to("scan.mha");
             if (header) (void)bone::read_image("scan.mha", *header, {{0, 0, 0}, header->size}, 0).take(found);
             std::filesystem::current_path(before);
             return found;
         }},
        {720, [] { return app::refusal_of_file_limit(3, 6); }},
        {718,
         [] {
             text::Diagnostics found;
             const std::filesystem::path before = std::filesystem::current_path();
             std::filesystem::current_path(KERF_SOURCE_DIR "/tests/golden");
             ComponentCatalog without;  // the plugin with the strategies
             std::copy_if(plugins().catalog().begin(), plugins().catalog().end(), std::back_inserter(without),
                          [](const ComponentInfo& c) { return c.plugin != "kerf.remesh_cgal"; });
             run::ExactStrategies strategies({"libexec/kerf/kerf-remesh", &without});
             if (const auto procedure = documents::read_procedure("E0718.yaml", without).take(found)) {
                 const std::string why = strategies.start(*procedure);
                 run::report_strategy(*procedure, strategies.instrument_without(), why, found);
             }
             std::filesystem::current_path(before);
             return found;
         }},
    };
    return causes;
}

}  // namespace kerf::test
