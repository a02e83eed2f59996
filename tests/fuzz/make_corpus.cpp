// SPDX-License-Identifier: Apache-2.0
// make_corpus FOLDER: writes what the fuzzers start from, the same bytes on every run, and the words of the text
// formats. Each format has its good files, each a little different, and one that is spoilt at a place which readers go
// wrong at. What a fuzzer found is kept beside them as found-….
#include <sqlite3.h>
#include <zlib.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "devices/motion/motion_text.h"
#include "devices/udp/datagram.h"
#include "documents/shapes/shapes.h"
#include "session/content_hash.h"
#include "session/record_checksum.h"
#include "session/recorder.h"
#include "tests/devices/hid_force/pid_firmware.h"
#include "tests/documents/every_key.h"
#include "tests/support/dicom_writer.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

namespace tag = test::tag;

std::filesystem::path root;

void write(const std::string& target, const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories(root / target);
    std::ofstream(root / target / name, std::ios::binary) << bytes;
}

template <class Number>
void put(std::string& out, Number value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// ---- documents
// -------------------------------------------------------------------------------------------------------

void write_documents(const std::string& target, const documents::Shape& shape) {
    for (std::size_t choice = 0; choice < documents::EveryKey::choices; choice += 2)
        write(target, "good-every-key-" + std::to_string(choice) + ".yaml",
              documents::EveryKey{.choice = choice}.document(shape));
    write(target, "good-examples.yaml", documents::EveryKey{.choice = 1, .depth = 0}.document(shape));
    write(target, "bad-alias.yaml", "kind: &a Procedure\nid: *a\n");
    write(target, "bad-nested.yaml", "id: " + std::string(80, '[') + std::string(80, ']') + "\n");
    write(target, "bad-bytes.yaml", "id: \xff\xfe\nid: !!int \"1\"\n--- {\n");
}

/// The keys and words that documents are made of, one a line, as libFuzzer wants them.
void write_words() {
    std::set<std::string> words{"3.2 mm", "1000 rpm", "-1e308 m", "0.25 g/cm3", "~", "null", "- ",
                                ": ",     "{",        "}",        "[",          "]", "&a",   "*a"};
    for (const documents::Shape* shape : {&documents::shapes::procedure, &documents::shapes::anatomy})
        for_every_key(*shape, [&](const documents::Shape&, const documents::KeyShape& key) {
            words.insert(key.name + ": ");
            for (const std::string& word : key.value.words) words.insert(word);
        });
    std::ofstream out(root / "yaml.dict");
    for (const std::string& word : words) out << '"' << word << "\"\n";
}

// ---- surfaces
// --------------------------------------------------------------------------------------------------------

struct Corner {
    float x, y, z;
};
const std::vector<Corner> tetrahedron{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
const std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string text_of(const Corner& c) {
    return test::DicomWriter::decimal(c.x) + " " + test::DicomWriter::decimal(c.y) + " " +
           test::DicomWriter::decimal(c.z);
}

std::string stl_bytes(std::uint32_t promised) {
    std::string bytes = "s" + std::string(80, ' ');
    put(bytes, promised);
    for (const auto& face : faces) {
        bytes.append(12, '\0');  // the normal, which nobody reads
        for (const std::uint32_t corner : face) put(bytes, tetrahedron[corner]);
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string stl_text() {
    std::string text = "ssolid bone\n";
    for (const auto& face : faces) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const std::uint32_t corner : face) text += "vertex " + text_of(tetrahedron[corner]) + "\n";
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid bone\n";
}

std::string obj_text(const char* after_index) {
    std::string text = "o# bone\no bone\nvn 0 0 1\nvt 0 0\n";
    for (const Corner& corner : tetrahedron) text += "v " + text_of(corner) + "\n";
    for (const auto& face : faces) {
        text += "f";
        for (const std::uint32_t corner : face) text += " " + std::to_string(corner + 1) + after_index;
        text += "\n";
    }
    return text;
}

template <class Number>
void put_in_order(std::string& out, Number value, bool is_big) {
    std::string bytes;
    put(bytes, value);
    out.append(is_big ? std::string(bytes.rbegin(), bytes.rend()) : bytes);
}

std::string ply(const std::string& format) {
    std::string bytes =
        "pply\nformat " + format +
        " 1.0\ncomment bone\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
    const bool is_big = format == "binary_big_endian";
    if (format == "ascii") {
        for (const Corner& corner : tetrahedron) bytes += text_of(corner) + " 7\n";
        for (const auto& [a, b, c] : faces)
            bytes += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
        return bytes;
    }
    for (const auto& [x, y, z] : tetrahedron) {
        for (const float number : {x, y, z}) put_in_order(bytes, number, is_big);
        bytes.push_back('\7');
    }
    for (const auto& face : faces) {
        bytes.push_back('\3');
        for (const std::uint32_t corner : face) put_in_order(bytes, corner, is_big);
    }
    return bytes;
}

void write_surfaces() {
    write("surface", "good-stl-bytes", stl_bytes(4));
    write("surface", "good-stl-text", stl_text());
    write("surface", "bad-stl-promises", stl_bytes(0xffffffff));
    write("surface", "good-obj", obj_text(""));
    write("surface", "good-obj-normals", obj_text("/1/1"));
    write("surface", "good-obj-polygon", "ov 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0\nf -5 -4 -3 -2 -1\n");
    write("surface", "bad-obj-index", "ov 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\nf 1 2 -4\nf 1 2 99999999999\n");
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        write("surface", std::string("good-ply-") + format, ply(format));
    write("surface", "bad-ply-count",
          "pply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty double x\nelement face "
          "18446744073709551615\n"
          "property list uint int vertex_indices\nend_header\n");
}

// ---- images
// ----------------------------------------------------------------------------------------------------------

// 4 × 3 × 2 voxels of 16 bits.
std::string voxels() {
    std::string bytes;
    for (int i = 0; i < 24; ++i) put(bytes, static_cast<std::int16_t>(100 * i));
    return bytes;
}

/// zlib's format, or gzip's.
std::string packed(const std::string& bytes, bool as_gzip) {
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, as_gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY) != Z_OK) std::abort();
    std::string in = bytes, out(bytes.size() + 1000, '\0');
    stream.next_in = reinterpret_cast<unsigned char*>(in.data());
    stream.avail_in = static_cast<unsigned>(in.size());
    stream.next_out = reinterpret_cast<unsigned char*>(out.data());
    stream.avail_out = static_cast<unsigned>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(out.size() - stream.avail_out);
    deflateEnd(&stream);
    return out;
}

std::string nifti(bool is_big, bool by_quaternion) {
    std::string header(352, '\0');
    const auto set = [&](std::size_t at, auto value) {
        std::string bytes;
        put_in_order(bytes, value, is_big);
        header.replace(at, bytes.size(), bytes);
    };
    set(0, std::int32_t{348});
    std::size_t at = 40;
    for (const int n : {3, 4, 3, 2, 1, 1, 1, 1}) set(at, static_cast<std::int16_t>(n)), at += 2;
    set(70, std::int16_t{4});
    set(72, std::int16_t{16});
    at = 76;
    for (const float n : {1.0f, 0.5f, 1.0f, 2.0f}) set(at, n), at += 4;
    set(108, 352.0f);
    set(112, 1.0f);
    header[123] = 2;
    if (by_quaternion) {
        set(252, std::int16_t{1});
        set(256, 0.6f);
    } else {
        set(254, std::int16_t{1});
        set(280, -0.5f), set(300, -1.0f), set(320, 2.0f);
        set(292, -10.0f), set(308, -20.0f), set(324, 30.0f);
    }
    header.replace(344, 4, "n+1\0", 4);
    return header + voxels();
}

std::string nrrd(const std::string& encoding, const std::string& more = "") {
    return "rNRRD0004\n# made for tests\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 3 2\n"
           "space directions: (0.5,0,0) (0,1,0) (0,0,2)\nkinds: domain domain domain\nendian: little\nencoding: " +
           encoding + "\nspace origin: (10,20,30)\n" + more + "\n" +
           (encoding == "gzip" ? packed(voxels(), true) : voxels());
}

std::string meta(const std::string& data_file, bool is_packed) {
    return std::string(data_file == "LOCAL" ? "m" : "d") +
           "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = " +
           (is_packed ? "True" : "False") +
           "\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 0.5 1 2\n"
           "DimSize = 4 3 2\nElementType = MET_SHORT\nElementDataFile = " +
           data_file + "\n" + (is_packed ? packed(voxels(), false) : voxels());
}

void write_images() {
    write("image_header", "good-nifti", "n" + nifti(false, false));
    write("image_header", "good-nifti-big", "n" + nifti(true, true));
    write("image_header", "good-nifti-gzip", "z" + packed(nifti(false, true), true));
    write("image_header", "good-nrrd", nrrd("raw"));
    write("image_header", "good-nrrd-gzip", nrrd("gzip"));
    write("image_header", "good-nrrd-segments",
          nrrd("raw",
               "Segment0_Name:=Bone\nSegment0_LabelValue:=7\nSegment0_Layer:=0\nspace units: \"mm\" \"mm\" \"mm\"\n"));
    std::string layered = nrrd("raw", "Segment0_Name:=Bone\nSegment0_Layer:=1\n");
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"dimension: 3", "dimension: 4"},
                                                          {"sizes: 4", "sizes: 2 4"},
                                                          {"directions: (", "directions: none ("},
                                                          {"kinds: ", "kinds: list "},
                                                          {"short", "uchar"}})
        layered.replace(layered.find(from), from.size(), to);
    write("image_header", "good-nrrd-layers", layered);
    write("image_header", "good-meta", meta("LOCAL", false));
    std::string sheared = nrrd("raw");
    sheared.replace(sheared.find("(0,0,2)"), 7, "(0,1,2)");
    write("image_header", "good-nrrd-sheared", sheared);
    write("image_header", "good-meta-packed", meta("LOCAL", true));
    write("image_header", "good-meta-beside", meta("image.mhd", false));  // itself: its first bytes are voxels, too
    std::string lies = nrrd("gzip");
    lies.replace(lies.find("4 3 2"), 5, "4096 4096 30");
    write("image_header", "bad-nrrd-gzip-promises", lies);
    write("image_header", "bad-meta-sizes",
          "mNDims = 3\nDimSize = -1 9223372036854775807 1e9\nElementDataFile = ../../x\n");
    std::ofstream(root / "image.dict")
        << "\"NRRD0004\"\n\"sizes: \"\n\"space directions: \"\n\"none\"\n\"kinds: list domain domain domain\"\n"
           "\"encoding: gzip\"\n\"encoding: raw\"\n\"type: float\"\n\"type: double\"\n\"space: "
           "RAS\"\n\"nan\"\n\"inf\"\n"
           "\"1e308\"\n\"Segment0_Name:=\"\n\"Segment0_LabelValue:=\"\n\"Segment0_Layer:=\"\n\"ElementType = "
           "MET_FLOAT\"\n"
           "\"ElementDataFile = LOCAL\"\n\"CompressedData = True\"\n\"HeaderSize = -1\"\n\"DimSize = \"\n\"n+1\\x00\"\n"
           "\"ElementNumberOfChannels = \"\n\"data file: \"\n\"byte skip: -1\"\n";
}

// ---- DICOM
// -----------------------------------------------------------------------------------------------------------

test::DicomWriter slice(double z, int instance, double y = 20.0) {
    return test::ct_slice(3, 2, 0.5, {10, y, z}, instance, {0, 100, 200, 300, 400, 500});
}

std::string folder_of(const std::vector<test::DicomWriter>& files) {
    std::string all;
    for (const test::DicomWriter& file : files) {
        const std::string bytes = file.bytes();
        all.push_back(static_cast<char>(bytes.size() >> 8));
        all.push_back(static_cast<char>(bytes.size() & 0xff));
        all += bytes;
    }
    return all;
}

void write_dicom() {
    write("dicom_elements", "good-explicit", slice(30, 1).bytes());
    test::DicomWriter implicit = slice(30, 1);
    implicit.syntax = "1.2.840.10008.1.2";
    write("dicom_elements", "good-implicit", implicit.bytes());
    test::DicomWriter signed_bits = slice(30, 1);
    signed_bits.word(tag::bits_stored, 12)
        .word(tag::high_bit, 11)
        .word(tag::representation, 1)
        .word(tag::padding, -2000, "SS");
    write("dicom_elements", "good-signed",
          signed_bits.number(tag::gantry_tilt, {12.5}).text(tag::lossy, "CS", "01").bytes());
    write("dicom_elements", "good-fragments", slice(30, 1).fragment("1.2.840.10008.1.2.5", "packed").bytes());

    // A sequence without a length, of items without one, one in the other, before the elements that count
    const std::string item = std::string("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8),
                      item_end = std::string("\xfe\xff\x0d\xe0\0\0\0\0", 8),
                      sequence_end = std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8),
                      open_sequence = std::string("\x08\x00\x40\x11SQ\0\0\xff\xff\xff\xff", 12);
    const std::string inner = open_sequence + item + item_end + sequence_end;
    std::string nested = slice(30, 1).bytes();
    nested.insert(nested.find(std::string("\x20\x00\x0d\x00", 4)),
                  open_sequence + item + inner + item_end + sequence_end);
    write("dicom_elements", "good-nested", nested);
    write("dicom_elements", "bad-no-slice", slice(30, 1).without(tag::pixel_data).bytes());
    write("dicom_elements", "bad-cut", slice(30, 1).bytes().substr(0, 500));
    write("dicom_elements", "bad-numbers",
          slice(30, 1).number(tag::position, {1e308, -1e308, 0}).text(tag::slope, "DS", "1e308").bytes());

    write("dicom_series", "good-straight", folder_of({slice(30, 1), slice(32, 2), slice(34, 3)}));
    write("dicom_series", "good-tilted", folder_of({slice(30, 1), slice(32, 2, 20.6), slice(34, 3, 21.2)}));
    write("dicom_series", "good-uneven", folder_of({slice(30, 1), slice(32, 2), slice(34.3, 3)}));
    write("dicom_series", "good-missing", folder_of({slice(30, 1), slice(32, 2), slice(34, 3), slice(40, 4)}));
    test::DicomWriter other = slice(32, 2);
    other.uid(tag::series, "1.2.3.9").text(tag::series_number, "IS", "7");
    write("dicom_series", "bad-two-series", folder_of({slice(30, 1), other}));
    write("dicom_series", "bad-one-place", folder_of({slice(30, 1), slice(30, 2)}));
    write("dicom_series", "bad-far-apart", folder_of({slice(-9e4, 1), slice(-9e4 + 1e-6, 2), slice(9e4, 3)}));
}

// ---- markups
// ---------------------------------------------------------------------------------------------------------

void write_markups() {
    const std::string points = R"([{"label": "F-1", "position": [10, 20, 30], "positionStatus": "defined"},
{"label": "tip", "position": [-10.5, 2e1, 0], "positionStatus": "defined"}, {"label": "side", "position": [1, 2, 3]}])";
    const auto json = [](const std::string& type, const std::string& more) {
        return R"(j{"@schema": "x", "markups": [{"type": ")" + type +
               R"(", "coordinateSystem": "RAS", "coordinateUnits": "mm", )" + more + "}]}";
    };
    const std::string two = points.substr(0, points.rfind(", {")) + "]";
    write("markups", "good-points", json("Fiducial", "\"controlPoints\": " + points));
    write("markups", "good-line", json("Line", "\"name\": \"axis\", \"controlPoints\": " + two));
    write("markups", "good-plane",
          json("Plane", "\"name\": \"cut\", \"normal\": [0, 0, 1], \"center\": [1, 2, 3], \"controlPoints\": []"));
    write("markups", "good-plane-of-points", json("Plane", "\"controlPoints\": " + points));
    write("markups", "good-fcsv",
          "c# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = "
          "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc\n"
          "1,10,20,30,0,0,0,1,1,1,0,F-1,\n2,-10.5,2e1,0,0,0,0,1,1,1,0,tip,\n");
    write(
        "markups", "bad-types",
        R"(j{"markups": [{"type": 7, "coordinateSystem": [], "controlPoints": [{"position": ["x", null, 1e999]}]}, 3]})");
    write("markups", "bad-nested", "j{\"markups\": " + std::string(5000, '[') + std::string(5000, ']') + "}");
    std::ofstream(root / "markups.dict") << R"("\"markups\": [")" << '\n'
                                         << R"("\"type\": \"Line\"")" << '\n'
                                         << R"("\"type\": \"Plane\"")" << '\n'
                                         << R"("\"type\": \"Fiducial\"")" << '\n'
                                         << R"("\"controlPoints\": [")" << '\n'
                                         << R"("\"position\": [")" << '\n'
                                         << R"("\"coordinateSystem\": \"LPS\"")" << '\n'
                                         << R"("\"normal\": [")" << '\n'
                                         << R"("\"origin\": [")" << '\n'
                                         << R"("# CoordinateSystem = RAS")" << '\n'
                                         << R"("# columns = label,x,y,z")" << '\n'
                                         << R"("1e999")" << '\n';
}

// ---- sessions
// --------------------------------------------------------------------------------------------------------

/// A database in pages of 512 bytes, so that a change of one byte meets something that counts. Its schema is the last
/// that had plain rows alone, so that few tables make a session.
std::string database(const std::string& sql) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "session.db";
    sqlite3* open = nullptr;
    sqlite3_open(path.c_str(), &open);
    const std::string all =
        "PRAGMA page_size=512; PRAGMA application_id=" + std::to_string(session::session_application_id) +
        "; PRAGMA user_version=" + std::to_string(session::first_schema_with_blocks - 1) + ";" + sql;
    char* error = nullptr;
    if (sqlite3_exec(open, all.c_str(), nullptr, nullptr, &error) != SQLITE_OK) {
        std::fprintf(stderr, "%s\n", error);
        std::abort();
    }
    sqlite3_close(open);
    return test::contents_of(path);
}

constexpr std::size_t page = 512;  // [bytes]

void set_big(std::string& bytes, std::size_t at, std::size_t value, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(value >> (8 * (count - 1 - i)) & 0xff);
}

/// A page that leads to another one 71 times. Source: sqlite.org/fileformat2.html, 1.6.
std::string leads_to(std::size_t child) {
    constexpr std::size_t cells = 70, head = 12, cell = 5;
    std::string bytes(page, '\0');
    bytes[0] = 5;
    set_big(bytes, 3, cells, 2);
    set_big(bytes, 5, page - cells * cell, 2);
    set_big(bytes, 8, child, 4);
    for (std::size_t n = 0; n < cells; ++n) {
        const std::size_t at = page - (n + 1) * cell;
        set_big(bytes, head + 2 * n, at, 2);
        set_big(bytes, at, child, 4);
        bytes[at + 4] = static_cast<char>(n);
    }
    return bytes;
}

/// The last page of a database, ten pages deeper: with every page leading to the next one only, its rows come 71 times
/// as often from page to page.
std::string endless(std::string database) {
    const std::size_t pages = database.size() / page;
    const std::string leaf = database.substr((pages - 1) * page);
    database.resize((pages - 1) * page);
    for (std::size_t n = 0; n < 10; ++n) database += leads_to(pages + n + 1);
    database += leaf;
    set_big(database, 28, database.size() / page, 4);
    return database;
}

/// A whole session as the recorder writes it, of two ticks and a triangle, in the same small pages.
std::string recorded_session(const std::string& sql, bool is_plain = false) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "session.db";
    session::SessionHeader header;
    header.procedure = "hole";
    header.signals = {{"chip", "uncut chip", "um", 1e-6}};
    header.tissues = {"bone"};
    auto recorder = session::Recorder::create(path, header).recorder;
    for (std::uint64_t tick = 0; tick < 2; ++tick) {
        session::TickRow row;
        row.tick = tick;
        row.thrust = 1.5;
        recorder->push(row);
    }
    recorder->push_event({1, 0.001, "entry", "first bone met"});
    session::RunSummary summary;
    summary.reasons = {"too deep"};
    summary.steps = {{"hole", "A hole", true, 0.0, 0.001, {"depth"}}};
    summary.metrics = {{"hole.depth", 1, "hole", 1, 1, 0.01, "mm", 1e-3, 1e-4, "ok", "depth"}};
    summary.removed_by_tissue = {{"bone", 1e-9}};
    Mesh mesh;
    mesh.vertices = {{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}};
    mesh.triangles = {{0, 1, 2}};
    if (!recorder->finish(summary, session::drawn_surface(mesh)).empty()) std::abort();
    if (is_plain && !test::make_rows_plain(path).empty()) std::abort();
    sqlite3* open = nullptr;
    sqlite3_open(path.c_str(), &open);
    // What only describes the file would be most of it
    const auto carry_out = [&](const std::string& statements) {
        if (sqlite3_exec(open, statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) std::abort();
    };
    carry_out("DELETE FROM columns;" + sql);
    if (const auto sum = session::record_checksum(open))
        carry_out("UPDATE session SET value = '" + session::hex16(*sum) + "' WHERE key = '" +
                  session::record_checksum_key + "'");
    carry_out("PRAGMA page_size=512; VACUUM");
    sqlite3_close(open);
    return test::contents_of(path);
}

void write_sessions() {
    const std::string poses =
        "device_from_handle_x, device_from_handle_y, device_from_handle_z, device_from_handle_qw, "
        "device_from_handle_qx, device_from_handle_qy, device_from_handle_qz";
    const std::string keys =
        "CREATE TABLE events(tick INTEGER, time REAL, id TEXT, detail TEXT); CREATE TABLE session(key TEXT, value "
        "TEXT); INSERT INTO session VALUES('state','running'),('procedure_text','kind: Procedure'),"
        "('condition.variant','left'),('anatomy_hash','0123456789abcdef'),('hash','0123456789abcdef');";
    const std::string ticks = keys + "CREATE TABLE ticks(tick INTEGER, " + poses + ");";
    const auto rows = [](int count) {
        std::string sql;
        for (int tick = 0; tick < count; ++tick)
            sql += "INSERT INTO ticks VALUES(" + std::to_string(tick) + ",0.001," + std::to_string(tick) +
                   "e-4,-0.002,1,0,0,0);";
        return sql;
    };
    write("session", "good-few", database(ticks + rows(3)));
    write("session", "good-many", database(ticks + rows(100)));
    write("session", "good-long-text",
          database(ticks + rows(2) + "UPDATE session SET value=printf('%.3000c','x') WHERE key='procedure_text'"));
    write("session", "good-sorted",
          database(keys + "CREATE TABLE ticks(tick INTEGER PRIMARY KEY, " + poses + ") WITHOUT ROWID;" + rows(20)));
    write("session", "good-recorded", recorded_session(""));
    write("session", "good-recorded-plain", recorded_session("", true));
    write("session", "bad-column-cut",
          recorded_session("UPDATE blocks SET data=substr(data, 1, 8) WHERE column_name='thrust' OR "
                           "column_name='device_from_handle_x';"));
    write("session", "bad-rows-promised", recorded_session("UPDATE blocks SET rows=4096;"));
    write("session", "bad-column-missing", recorded_session("DELETE FROM blocks WHERE column_name='tick';"));
    write(
        "session", "bad-block-twice",
        recorded_session("INSERT INTO blocks SELECT table_name, 1, rows, column_name, differences, data FROM blocks;"));
    write("session", "good-without-result",
          recorded_session("DELETE FROM session WHERE key LIKE 'result.%' OR key IN ('record_checksum', 'hash', "
                           "'summary'); UPDATE session SET "
                           "value = 'running' WHERE key = 'state'; DELETE FROM surface;"));
    write("session", "bad-endless-pages", endless(database(ticks + rows(2))));
    write("session", "bad-gap", database(ticks + rows(5) + "DELETE FROM ticks WHERE tick=2"));
    write("session", "bad-no-tables", database("CREATE TABLE x(y)"));
    write("session", "bad-endless-view",
          database(
              keys +
              "CREATE VIEW ticks AS WITH RECURSIVE n(tick) AS (SELECT 0 UNION ALL SELECT tick+1 FROM n) SELECT tick, "
              "0.0 AS device_from_handle_x, 0.0 AS device_from_handle_y, 0.0 AS device_from_handle_z, 1.0 AS "
              "device_from_handle_qw, 0.0 AS device_from_handle_qx, 0.0 AS device_from_handle_qy, 0.0 AS "
              "device_from_handle_qz FROM n"));
    // Written as short, since who writes it computes it
    std::string large = database("CREATE TABLE events(tick INTEGER, time REAL, id TEXT, detail TEXT); CREATE TABLE "
                                 "session(key TEXT, value TEXT AS (printf('%.*c', 000000009, 'x')));"
                                 "INSERT INTO session VALUES('procedure_text'); CREATE TABLE ticks(tick INTEGER, " +
                                 poses + ");" + rows(2));
    large.replace(large.find("000000009"), 9, "900000000");
    write("session", "bad-large-value", large);
}

// ---- datagrams ------------------------------------------------------------------------------------------------------

void write_datagrams() {
    udp::Hello hello;
    hello.name = "rig";
    hello.facts.abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE;
    hello.facts.button_count = 2;
    hello.facts.peak_force = 8.0;
    hello.facts.continuous_force = 2.0;
    hello.facts.largest_stiffness = 800.0;
    hello.facts.mass = 0.1;
    hello.facts.resolution = 1e-5;
    udp::ForceCommand force;
    force.answered = 3;
    force.command.device_from_tool.rotation.w = 1.0;
    const std::pair<const char*, udp::Content> contents[] = {
        {"hello", hello},
        {"welcome", udp::Welcome{1000, 20}},
        {"pose", udp::PoseReport{.device_from_handle = {{0.1, 0.2, 0.3}, {1, 0, 0, 0}}, .buttons = 1}},
        {"force", force},
        {"goodbye", udp::Goodbye{}}};
    const udp::Key key{1, 2, 3};
    for (const auto& [name, content] : contents)
        for (const bool has_key : {false, true}) {
            udp::Bytes bytes{};
            const std::size_t size = udp::encode({.header = {.session = 7, .sequence = 8}, .content = content},
                                                 has_key ? &key : nullptr, bytes);
            const std::string text = (has_key ? "k" : "p") + std::string(bytes.begin(), bytes.begin() + size);
            write("datagram", std::string("good-") + name + (has_key ? "-with-key" : ""), text);
            if (!has_key) write("datagram", std::string("short-") + name, text.substr(0, text.size() - 1));
        }
}

// ---- reports of HID devices -----------------------------------------------------------------------------------------

void write_reports() {
    using namespace std::string_literals;
    const std::pair<const char*, std::string> of_cap[] = {
        {"good-translation", "\x01\x0d\x00\x00\x00\x25\x01"s},
        {"good-rotation", "\x02\x00\x00\xe2\xff\x00\x00"s},
        {"good-both", "\x01\x00\x00\x00\x00\x07\x00\x00\x00\x00\x80\xff\x7f"s},
        {"good-buttons", "\x03\x03\x00"s},
        {"good-battery", "\x17\x64"s},
        {"bad-id", "\x09\x00\x00\x00\x00\x00\x00"s},
        {"bad-short", "\x01\x0d\x00\x00\x00\x25"s},
        {"bad-long", "\x02\x00\x00\xe2\xff\x00\x00\x00"s}};
    for (const auto& [name, bytes] : of_cap) write("spacemouse_report", name, bytes);
    const std::pair<const char*, std::string> of_service[] = {
        {"good-arm",
         R"({"session_id":7,"inverse3":[{"device_id":"049D","config":{"type":"inverse3"},"state":{"cursor_position":{"x":0.1,)"
         R"("y":-0.12,"z":0.15},"current_cursor_force":{"x":0,"y":0,"z":0}},"status":{"calibrated":true}}],)"
         R"("wireless_verse_grip":[{"device_id":"6","state":{"orientation":{"w":1,"x":0,"y":0,"z":0},)"
         R"("buttons":{"a":true,"b":false,"c":false}}}]})"},
        {"good-none", R"({"session_id":1,"inverse3":[]})"},
        {"bad-event", R"({"name":"device-busy","category":"device","level":"warning","data":{"device_id":"049D"}})"},
        {"bad-half", R"({"session_id":7,"inverse3":[{"device_id":"04)"},
        {"bad-number", R"({"inverse3":[{"device_id":"a","state":{"cursor_position":{"x":1e999,"y":0,"z":0}}}]})"}};
    for (const auto& [name, bytes] : of_service) write("service_message", name, bytes);
    const std::pair<const char*, std::string> of_pedal[] = {{"good-released", "\x00\x00"s},
                                                            {"good-all", "\x07\x00"s},
                                                            {"bad-bit", "\x08\x00"s},
                                                            {"bad-long", "\x01\x00\x00"s}};
    for (const auto& [name, bytes] : of_pedal) write("pedal_report", name, bytes);
}

void write_descriptors() {
    const auto text_of = [](const std::vector<std::uint8_t>& bytes) { return std::string(bytes.begin(), bytes.end()); };
    const std::string board = text_of(test::open_ffboard().descriptor);
    write("pid_descriptor", "good-open-ffboard", board);
    write("pid_descriptor", "good-two-axes", text_of(test::two_axes().descriptor));
    write("pid_descriptor", "good-sparse-knob", text_of(test::sparse_knob().descriptor));
    write("pid_descriptor", "bad-cut", board.substr(0, board.size() / 2));
    write("pid_descriptor", "bad-end", board.substr(0, board.size() - 1));
}

// ---- motions --------------------------------------------------------------------------------------------------------

void write_motions() {
    const std::vector<motion::MotionRow> rows{{0.0, {{0.01, -0.02, 0.03}, {1, 0, 0, 0}}, 0},
                                              {0.001, {{0.011, -0.02, 0.03}, {0.8, 0.6, 0, 0}}, 1},
                                              {0.0025, {{0.012, -0.02, 0.03}, {0, 0, 0, -1}}, 3}};
    write("motion", "good-rows", motion::text_of(rows, "A notice."));
    write("motion", "good-spaces", "# a comment\r\n\r\n 0 , 0 , 0 , 1e-3 , 1 , 0 , 0 , 0 , 4294967295\r\n");
    write("motion", "good-not-quite-unit", "0,0,0,0,0.7074,0.7074,0,0,0");
    write("motion", "bad-columns", "0,0,0,0,1,0,0,0\n");
    write("motion", "bad-number", "0,0,nan,0,1,0,0,0,0\n");
    write("motion", "bad-order", "1,0,0,0,1,0,0,0,0\n0.5,0,0,0,1,0,0,0,0\n");
    write("motion", "bad-length", "0,0,0,0,0.5,0.5,0,0,0\n");
}

}  // namespace
}  // namespace kerf

int main(int count, char** words) {
    if (count != 2) {
        std::fprintf(stderr, "usage: %s FOLDER\n", words[0]);
        return 2;
    }
    kerf::root = words[1];
    kerf::write_documents("yaml_procedure", kerf::documents::shapes::procedure);
    kerf::write_documents("yaml_anatomy", kerf::documents::shapes::anatomy);
    std::filesystem::create_directories(kerf::root);
    kerf::write_words();
    kerf::write_surfaces();
    kerf::write_images();
    kerf::write_dicom();
    kerf::write_markups();
    kerf::write_sessions();
    kerf::write_datagrams();
    kerf::write_reports();
    kerf::write_descriptors();
    kerf::write_motions();
    return 0;
}
