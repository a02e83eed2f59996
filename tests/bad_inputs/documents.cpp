// SPDX-License-Identifier: Apache-2.0
// Markups of 3D Slicer, YAML documents and recorded sessions.
#include <sqlite3.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "session/recorder.h"
#include "tests/bad_inputs/input.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

using Make = std::function<void(const std::string&)>;

Make file(const std::string& name, const std::string& bytes) {
    return [=](const std::string& folder) { write_file_of(folder + "/" + name, bytes); };
}

std::string fiducial(const std::string& frame, const std::string& place, const std::string& label = "entry",
                     const std::string& more = "") {
    return R"({"markups": [{"type": "Fiducial", )" +
           (frame.empty() ? "" : R"("coordinateSystem": ")" + frame + R"(", )") + more +
           R"("controlPoints": [{"label": ")" + label + R"(", "position": [)" + place +
           R"(], "positionStatus": "defined"}]}]})";
}
std::string fcsv(const std::string& frame, const std::string& row, const std::string& end = "\n") {
    return "# Markups fiducial file version = 4.11" + end +
           (frame.empty() ? "" : "# CoordinateSystem = " + frame + end) +
           "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID" + end + row + end;
}

/// The anatomy of the catalogue's other documents, as text.
const std::string anatomy =
    "apiVersion: kerf/v1\nkind: Anatomy\nmetadata: {id: block, title: A block}\n"
    "phantom: {parts: [{id: block, box: {centre: 2.5 -3 -3 mm, size: 14 12 14 mm}}]}\n"
    "tissues: [{id: bone, density: 1.5 g/cm3}]\nlandmarks:\n  points: {midline: {at: 9 0 0 mm, tolerance: 1 mm}}\n"
    "  axes: {way: {from: 2 -3 9 mm, to: 2 -3 -8 mm, tolerance: 1 mm}}\n"
    "zones: {nerve: [{tube: {from: 14 0 -9 mm, to: 14 0 9 mm, radius: 1 mm}}]}\n";

Make changed(const std::string& from, const std::string& to) {
    return file("anatomy.yaml", with_replaced(anatomy, from, to));
}
const std::string bone_of_phantom = "phantom: {parts: [{id: block, box: {centre: 2.5 -3 -3 mm, size: 14 12 14 mm}}]}";

std::string in_utf16(const std::string& text) {
    std::string wide = "\xff\xfe";
    for (const char c : text) wide += std::string{c, '\0'};
    return wide;
}

std::string with_crlf(const std::string& text) {
    std::string other;
    for (const char c : text) other += c == '\n' ? "\r\n" : std::string(1, c);
    return other;
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int n = 0; n < times; ++n) all += text;
    return all;
}

// ---- sessions
// ---------------------------------------------------------------------------------------------------------

/// A session of 200 ticks; the handle moves by 0.1 mm in each.
void record(const std::string& path, bool is_finished = true) {
    auto recorder = session::Recorder::create(path, {}).recorder;
    if (recorder == nullptr) throw std::runtime_error("no recorder");
    for (std::uint64_t tick = 0; tick < 200; ++tick) {
        session::TickRow row;
        row.tick = tick;
        row.device_from_handle = {{1e-4 * static_cast<double>(tick), 0.0, 0.0}, {1, 0, 0, 0}};
        recorder->push(row);
    }
    if (is_finished && !recorder->finish({}).empty()) throw std::runtime_error("not recorded");
}
Make session(const std::function<void(const std::string& path)>& change) {
    return [=](const std::string& folder) {
        record(folder + "/session.db");
        change(folder + "/session.db");
    };
}
void change(const std::string& path, const std::string& sql) {
    if (const std::string error = run_sql(path, sql); !error.empty()) throw std::runtime_error(sql + ": " + error);
}
Make session_after(const std::string& sql) {
    return session([=](const std::string& path) { change(path, sql); });
}
/// The same with plain rows, as a killed run leaves its last ones.
Make plain_session_after(const std::string& sql) {
    return session([=](const std::string& path) {
        if (const std::string error = make_rows_plain(path); !error.empty()) throw std::runtime_error(error);
        change(path, sql);
    });
}
Make cut_to(double share) {
    return session([=](const std::string& path) {
        std::filesystem::resize_file(
            path, static_cast<std::uintmax_t>(share * static_cast<double>(std::filesystem::file_size(path))));
    });
}

}  // namespace

std::vector<Input> markup_inputs() {
    const std::string point = "3, -4, 5", row = "1,3,-4,5,0,0,0,1,1,1,0,entry,,";
    return {
        {"markups, LPS", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("LPS", point)), "loaded", ""},
        {"markups, RAS", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("RAS", "-3, 4, 5")), "loaded", ""},
        {"markups, no frame", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("", point)), "E0681",
         "coordinateSystem"},
        {"markups, a frame that is none", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("IJK", point)),
         "E0681", "LPS or RAS"},
        {"markups, metres", Way::markups, "a.mrk.json",
         file("a.mrk.json", fiducial("LPS", point, "entry", R"("coordinateUnits": "m", )")), "E0681", "must be mm"},
        {"markups, a name with blanks", Way::markups, "a.mrk.json",
         file("a.mrk.json", fiducial("LPS", point, "entry of the drill")), "E0683", "no id"},
        {"markups, a name that is there already", Way::markups, "a.mrk.json",
         file("a.mrk.json", fiducial("LPS", point, "midline")), "E0683", "two landmarks"},
        {"markups, a point without a place", Way::markups, "a.mrk.json",
         file("a.mrk.json", with_replaced(fiducial("LPS", point), "defined", "undefined")), "E0682", "no place"},
        {"markups, two numbers for a place", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("LPS", "3, -4")),
         "E0680", "not a list of three numbers"},
        {"markups, a number that no number holds", Way::markups, "a.mrk.json",
         file("a.mrk.json", fiducial("LPS", "3, -4, 1e999")), "E0680", "no file of 3D Slicer's markups"},
        {"markups, 3 m away", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("LPS", "3000, -4, 5")), "E0682",
         "2 m away"},
        {"markups, an angle", Way::markups, "a.mrk.json",
         file("a.mrk.json", with_replaced(fiducial("LPS", point), "Fiducial", "Angle")), "E0682", "type `Angle`"},
        {"markups, cut short", Way::markups, "a.mrk.json", file("a.mrk.json", fiducial("LPS", point).substr(0, 80)),
         "E0680", "no file of 3D Slicer's markups"},
        {"markups, a list 100000 deep", Way::markups, "a.mrk.json",
         file("a.mrk.json", R"({"markups": )" + std::string(100'000, '[') + std::string(100'000, ']') + "}"), "E0680",
         "no object"},
        {"markups, bytes that are no text", Way::markups, "a.mrk.json", file("a.mrk.json", "{\xff\xfe\x80"), "E0680",
         "no file of 3D Slicer's markups"},
        {"markups, a byte order mark", Way::markups, "a.mrk.json",
         file("a.mrk.json", "\xef\xbb\xbf" + fiducial("LPS", point)), "loaded", ""},
        {"markups, the older form, LPS", Way::markups, "a.fcsv", file("a.fcsv", fcsv("LPS", row)), "loaded", ""},
        {"markups, the older form, RAS", Way::markups, "a.fcsv",
         file("a.fcsv", fcsv("RAS", "1,-3,4,5,0,0,0,1,1,1,0,entry,,")), "loaded", ""},
        {"markups, the older form, RAS as a number", Way::markups, "a.fcsv",
         file("a.fcsv", fcsv("0", "1,-3,4,5,0,0,0,1,1,1,0,entry,,")), "loaded", ""},
        {"markups, the older form with CR LF", Way::markups, "a.fcsv", file("a.fcsv", fcsv("LPS", row, "\r\n")),
         "loaded", ""},
        {"markups, the older form, no frame", Way::markups, "a.fcsv", file("a.fcsv", fcsv("", row)), "E0681",
         "coordinate system"},
        {"markups, the older form, semicolons and commas", Way::markups, "a.fcsv",
         file("a.fcsv", fcsv("LPS", "1;3,0;-4,0;5,0;0;0;0;1;1;1;0;entry;;")), "E0680", "must be a number"},
        {"markups, the older form, a short line", Way::markups, "a.fcsv", file("a.fcsv", fcsv("LPS", "1,3,-4")),
         "E0680", "no column"},
        {"markups, the older form, a place that is no number", Way::markups, "a.fcsv",
         file("a.fcsv", fcsv("LPS", "1,nan,-4,5,0,0,0,1,1,1,0,entry,,")), "E0682", "2 m away"},
        {"markups under another ending", Way::markups, "a.txt", file("a.txt", fiducial("LPS", point)), "E0680",
         "names no markups"},
    };
}

std::vector<Input> document_inputs() {
    const std::string deep = "apiVersion: kerf/v1\nkind: Procedure\nmetadata: ";
    return {
        {"document, sound", Way::document, "anatomy.yaml", file("anatomy.yaml", anatomy), "loaded", ""},
        {"document, CR LF", Way::document, "anatomy.yaml", file("anatomy.yaml", with_crlf(anatomy)), "loaded", ""},
        {"document, a byte order mark", Way::document, "anatomy.yaml", file("anatomy.yaml", "\xef\xbb\xbf" + anatomy),
         "loaded", ""},
        {"document, missing", Way::document, "gone.yaml", [](const std::string&) {}, "E0101", "gone.yaml"},
        {"document, a folder", Way::document, "p.yaml",
         [](const std::string& folder) { std::filesystem::create_directory(folder + "/p.yaml"); }, "E0101", "p.yaml"},
        {"document, empty", Way::document, "p.yaml", file("p.yaml", ""), "E0104", "p.yaml"},
        {"document, huge", Way::document, "p.yaml", file("p.yaml", std::string(30u << 20, '#')), "E0102", "1 MB"},
        {"document, lists 10000 deep", Way::document, "p.yaml",
         file("p.yaml", deep + std::string(10'000, '[') + std::string(10'000, ']') + "\n"), "E0107", "64"},
        {"document, lists 500000 deep that do not end", Way::document, "p.yaml",
         file("p.yaml", deep + std::string(500'000, '[')), "E0107", "64"},
        {"document, maps 10000 deep by indenting", Way::document, "p.yaml",
         file("p.yaml",
              [] {
                  std::string text;
                  for (int n = 0; n < 1300; ++n) text += std::string(static_cast<std::size_t>(n), ' ') + "a:\n";
                  return text;
              }()),
         "E0107", "64"},
        {"document, a line of 900 kB", Way::document, "p.yaml",
         file("p.yaml", "apiVersion: " + std::string(900'000, 'x') + "\nkind: Procedure\n"), "E0201", "kerf/v1"},
        {"document, 100000 keys", Way::document, "p.yaml",
         file("p.yaml",
              [] {
                  std::string text = "apiVersion: kerf/v1\nkind: Procedure\n";
                  for (int n = 0; n < 60'000; ++n) text += "k" + std::to_string(n) + ": 1\n";
                  return text;
              }()),
         "E0112 E0203 E0204", "more"},
        {"document, a library", Way::document, "p.yaml",
         file("p.yaml", std::string("\x7f"
                                    "ELF\x02\x01\x01\0\0\0\xff\xfe",
                                    12)),
         "E0113", "got a shared library"},
        {"document, bytes", Way::document, "p.yaml", file("p.yaml", std::string("\x01\x02\0\0\xff\xfe", 6)), "E0103",
         "UTF-8"},
        {"document, UTF-16", Way::document, "anatomy.yaml", file("anatomy.yaml", in_utf16(anatomy)), "E0103", "UTF-8"},
        {"document, aliases that grow a billion times", Way::document, "p.yaml",
         file("p.yaml", "a: &a [x, x]\nb: &b [*a, *a, *a]\nc: &c [*b, *b, *b]\nd: [*c, *c, *c]\n"), "E0109 E0203 E0204",
         "*a"},
        {"document, a path that is followed half a million times", Way::document, "p.yaml",
         file("p.yaml", "apiVersion: kerf/v1\nkind: Procedure\npaths: {a: [" + repeated("{depth: 1 mm}, ", 700) +
                            "{depth: 2 mm}]}\nrehearsals: [{id: r, expect: pass, path: [" +
                            repeated("{follow: a}, ", 700) + "{depth: 2 mm}]}]\n"),
         "E0204 E0412", "follow too many waypoints"},
        {"document, paths that follow each other", Way::document, "p.yaml",
         file("p.yaml", "apiVersion: kerf/v1\nkind: Procedure\npaths: {a: [{follow: b}], b: [{follow: a}]}\n"
                        "rehearsals: [{id: r, expect: pass, path: [{follow: a}, {follow: b}]}]\n"),
         "E0203 E0204", "follows another"},
        {"document, a tag", Way::document, "anatomy.yaml", changed("title: A block", "title: !!python/object x"),
         "E0110", "tag"},
        {"document, a tab", Way::document, "anatomy.yaml", changed("  points:", "\tpoints:"), "E0105", "tab"},
        {"document, a bracket that is not closed", Way::document, "anatomy.yaml",
         changed("{id: block, title: A block}", "{id: block, title: A block"), "E0105", "never closed"},
        {"document, a key twice", Way::document, "anatomy.yaml",
         changed("kind: Anatomy\n", "kind: Anatomy\nkind: Anatomy\n"), "E0108", "twice"},
        {"document, a decimal comma", Way::document, "anatomy.yaml", changed("1.5 g/cm3", "1,5 g/cm3"), "E0401",
         "Write `1.5 g/cm3`"},
        {"document, no unit", Way::document, "anatomy.yaml", changed("tolerance: 1 mm", "tolerance: 1"), "E0402",
         "unit"},
        {"document, a number that is none", Way::document, "anatomy.yaml",
         changed("tolerance: 1 mm", "tolerance: .nan mm"), "E0401", "tolerance"},
        {"document, a number that no number holds", Way::document, "anatomy.yaml", changed("1.5 g/cm3", "1e999 g/cm3"),
         "E0401", "density"},
        {"document, a scan that is missing", Way::document, "anatomy.yaml",
         changed(bone_of_phantom, "ct: {image: gone.nii.gz, threshold: 0}"), "E0620", "does not exist"},
        {"document, a scan elsewhere on the machine", Way::document, "anatomy.yaml",
         changed(bone_of_phantom, "ct: {image: /etc/passwd, threshold: 0}"), "E0210", "/etc/passwd"},
        {"document, a scan above the folder", Way::document, "anatomy.yaml",
         changed(bone_of_phantom, "ct: {image: ../../scan.nii, threshold: 0}"), "E0210", "../../scan.nii"},
        {"document, a scan that is a picture", Way::document, "anatomy.yaml",
         [](const std::string& folder) {
             changed(bone_of_phantom, "ct: {image: a.jpg, threshold: 0}")(folder);
             write_file_of(folder + "/a.jpg", "\xff\xd8\xff");
         },
         "E0621", "got a picture"},
        {"document, a head in a block", Way::document, "anatomy.yaml",
         changed("midline: {at: 9 0 0 mm, ", "midline: {at: 9 0 0 mm, fit: {sphere: {radius: 6 mm}}, "), "E0615",
         "expected at least 40 %"},
        {"document, a head far away", Way::document, "anatomy.yaml",
         changed("midline: {at: 9 0 0 mm, ", "midline: {at: 1900 0 0 mm, fit: {sphere: {radius: 6 mm}}, "), "E0615",
         "got none of the directions"},
        {"document, a shaft that is square", Way::document, "anatomy.yaml",
         changed("to: 2 -3 -8 mm, ", "to: 2 -3 -8 mm, fit: {tube: {radius: 6 mm}}, "), "E0615",
         "expected at least 50 %"},
        {"document, a fit of two shapes", Way::document, "anatomy.yaml",
         changed("to: 2 -3 -8 mm, ", "to: 2 -3 -8 mm, fit: {tube: {radius: 6 mm}, neck: {head: midline}}, "), "E0211",
         "both `tube` and `neck`"},
        {"document, a fit of no shape", Way::document, "anatomy.yaml",
         changed("to: 2 -3 -8 mm, ", "to: 2 -3 -8 mm, fit: {residual: {at_most: 1 mm}}, "), "E0211",
         "none of `tube`, `neck` or `condyles`"},
        {"document, a neck whose head is not fitted", Way::document, "anatomy.yaml",
         changed("to: 2 -3 -8 mm, ", "to: 2 -3 -8 mm, fit: {neck: {head: midline}}, "), "E0618", "got `midline`"},
        {"document, condyles that are their own shaft", Way::document, "anatomy.yaml",
         changed("to: 2 -3 -8 mm, ", "to: 2 -3 -8 mm, fit: {condyles: {shaft: way}}, "), "E0618",
         "fitted to condyles itself"},
        {"document, a fitted radius of 3 m", Way::document, "anatomy.yaml",
         changed("midline: {at: 9 0 0 mm, ", "midline: {at: 9 0 0 mm, fit: {sphere: {radius: 3 m}}, "), "E0412",
         "0.1 m"},
        {"document, a second one behind it", Way::document, "anatomy.yaml",
         file("anatomy.yaml", anatomy + "---\n" + anatomy), "E0106", "second"},
        {"document, another version", Way::document, "anatomy.yaml", changed("kerf/v1", "kerf/v9"), "E0201", "kerf/v1"},
    };
}

std::vector<Input> session_inputs() {
    return {
        {"session, sound", Way::session, "session.db", session([](const std::string&) {}), "loaded", ""},
        {"session, in a folder that nobody may write to", Way::session, "locked/session.db",
         [](const std::string& folder) {
             std::filesystem::create_directory(folder + "/locked");
             record(folder + "/locked/session.db");
             namespace fs = std::filesystem;
             fs::permissions(folder + "/locked/session.db", fs::perms::owner_read);
         },
         "loaded", ""},
        {"session, cut to half", Way::session, "session.db", cut_to(0.5), "refused", "session.db"},
        {"session, cut to a hundred bytes", Way::session, "session.db",
         session([](const std::string& path) { std::filesystem::resize_file(path, 100); }), "refused",
         "not a Kerf session"},
        {"session, empty", Way::session, "session.db", file("session.db", ""), "refused", "not a Kerf session"},
        {"session, missing", Way::session, "session.db", [](const std::string&) {}, "refused", "cannot be opened"},
        {"session, a folder", Way::session, "session.db",
         [](const std::string& folder) { std::filesystem::create_directory(folder + "/session.db"); }, "refused",
         "session.db"},
        {"session, text", Way::session, "session.db", file("session.db", repeated("no database at all\n", 500)),
         "refused", "not a Kerf session"},
        {"session, another program's database", Way::session, "session.db",
         [](const std::string& folder) {
             sqlite3* database = nullptr;
             sqlite3_open((folder + "/session.db").c_str(), &database);
             sqlite3_exec(database, "CREATE TABLE places(url TEXT); INSERT INTO places VALUES('x')", nullptr, nullptr,
                          nullptr);
             sqlite3_close(database);
         },
         "refused", "not a Kerf session"},
        {"session, noise in its middle half", Way::session, "session.db", session([](const std::string& path) {
             std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
             const auto quarter = std::filesystem::file_size(path) / 4 / 4096 * 4096;
             out.seekp(static_cast<std::streamoff>(quarter));
             out << std::string(2 * quarter, '\xa5');
         }),
         "refused", "session.db"},
        {"session, another schema", Way::session, "session.db", session_after("PRAGMA user_version=9"), "refused",
         "schema 9, need 2"},
        {"session, a tick missing", Way::session, "session.db", plain_session_after("DELETE FROM ticks WHERE tick=77"),
         "refused", "tick 77 is missing"},
        {"session, no ticks", Way::session, "session.db", session_after("DELETE FROM ticks; DELETE FROM blocks"),
         "refused", "no ticks"},
        {"session, no table of ticks", Way::session, "session.db", session_after("DROP TABLE ticks"), "refused",
         "no ticks"},
        {"session, text in place of a number", Way::session, "session.db",
         plain_session_after("UPDATE ticks SET device_from_handle_x='a' WHERE tick=9"), "refused",
         "tick 9 holds no pose"},
        {"session, a pose at infinity", Way::session, "session.db",
         plain_session_after("UPDATE ticks SET device_from_handle_x=9e999 WHERE tick=9"), "refused",
         "tick 9 holds no pose"},
        {"session, plain rows", Way::session, "session.db", plain_session_after(""), "loaded", ""},
        {"session, a schema before the first", Way::session, "session.db", session_after("PRAGMA user_version=0"),
         "refused", "schema 0, need 2"},
        {"session, of a newer Kerf", Way::session, "session.db", session_after("PRAGMA user_version=6"), "refused",
         "schema 6, need 2"},
        {"session, an older schema's number on blocks", Way::session, "session.db",
         session_after("PRAGMA user_version=3"), "refused", "no ticks"},
        {"session, no table of blocks", Way::session, "session.db", session_after("DROP TABLE blocks"), "refused",
         "no ticks"},
        {"session, a column cut short", Way::session, "session.db",
         session_after("UPDATE blocks SET data=substr(data, 1, 20) WHERE column_name='device_from_handle_x'"),
         "refused", "damaged column `device_from_handle_x`"},
        {"session, a column that is not there", Way::session, "session.db",
         session_after("DELETE FROM blocks WHERE column_name='device_from_handle_x'"), "refused",
         "lacks its column `device_from_handle_x`"},
        {"session, a column of another", Way::session, "session.db",
         session_after("UPDATE blocks SET data=(SELECT data FROM blocks WHERE column_name='device_from_handle_x'), "
                       "differences=(SELECT differences FROM blocks WHERE column_name='device_from_handle_x') WHERE "
                       "column_name='device_from_handle_qw'"),
         "refused", "tick 0 holds no pose"},
        {"session, more rows than the column has", Way::session, "session.db",
         session_after("UPDATE blocks SET rows=201"), "refused", "damaged column `tick`"},
        {"session, more rows than memory has", Way::session, "session.db",
         session_after("UPDATE blocks SET rows=9223372036854775807"), "refused", "9223372036854775807 rows"},
        {"session, a column of 100 MB", Way::session, "session.db",
         session_after("UPDATE blocks SET data=zeroblob(100000000) WHERE column_name='device_from_handle_x'"),
         "refused", "damaged column `device_from_handle_x`"},
        {"session, blocks that are a view without end", Way::session, "session.db",
         session_after(
             "ALTER TABLE blocks RENAME TO b; CREATE VIEW blocks AS WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL "
             "SELECT i+1 FROM n) SELECT 'ticks' AS table_name, i AS block, rows, column_name, differences, data "
             "FROM n, b"),
         "refused", "computes its table `blocks`"},
        {"session, ticks that are a view without end", Way::session, "session.db",
         session_after("ALTER TABLE ticks RENAME TO t; CREATE VIEW ticks AS WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL "
                       "SELECT i+1 FROM n) "
                       "SELECT i AS tick, 0.0 AS device_from_handle_x, 0.0 AS device_from_handle_y, 0.0 AS "
                       "device_from_handle_z, 1.0 AS "
                       "device_from_handle_qw, 0.0 AS device_from_handle_qx, 0.0 AS device_from_handle_qy, 0.0 AS "
                       "device_from_handle_qz FROM n"),
         "refused", "session.db"},
        {"report, sound", Way::report, "session.db", session([](const std::string&) {}), "loaded", ""},
        {"report, of a run cut short", Way::report, "session.db",
         [](const std::string& folder) { record(folder + "/session.db", false); }, "loaded as incomplete", "cut short"},
        {"report, session cut to half", Way::report, "session.db", cut_to(0.5), "refused", "session.db"},
        {"report, session empty", Way::report, "session.db", file("session.db", ""), "refused", "not a Kerf session"},
        {"report, session missing", Way::report, "session.db", [](const std::string&) {}, "refused",
         "cannot be opened"},
        {"report, of an older schema", Way::report, "session.db", session_after("PRAGMA user_version=1"), "refused",
         "schema 1, need 2"},
        {"report, of a newer Kerf", Way::report, "session.db", session_after("PRAGMA user_version=6"), "refused",
         "schema 6, need 2"},
        {"report, plain rows", Way::report, "session.db", plain_session_after(""), "loaded", ""},
        {"report, a column cut short", Way::report, "session.db",
         session_after("UPDATE blocks SET data=substr(data, 1, 8) WHERE column_name='thrust'"), "refused",
         "damaged column `thrust`"},
        {"report, more rows than memory has", Way::report, "session.db",
         session_after("UPDATE blocks SET rows=9223372036854775807"), "refused", "9223372036854775807 rows"},
        {"report, a column that no page shows, changed", Way::report, "session.db",
         session_after("UPDATE blocks SET data=x'00' WHERE column_name='iterations'"), "refused",
         "not those that the run wrote"},
        {"report, no table of events", Way::report, "session.db", session_after("DROP TABLE events"), "refused",
         "`events` cannot be read"},
        {"report, text in place of a number", Way::report, "session.db",
         plain_session_after("UPDATE ticks SET torque='a' WHERE tick=9"), "refused", "`ticks`"},
        {"report, a number in place of every text", Way::report, "session.db",
         session_after("UPDATE session SET value=7 WHERE key LIKE 'run.%'; UPDATE session SET value='x' WHERE key LIKE "
                       "'result.%'"),
         "refused", "not those that the run wrote"},
        {"report, numbers at infinity", Way::report, "session.db",
         plain_session_after("UPDATE ticks SET thrust=9e999, depth=-9e999, time=1e300, tissue=9223372036854775807"),
         "refused", "not those that the run wrote"},
        {"report, numbers of the greatest size", Way::report, "session.db",
         plain_session_after("UPDATE ticks SET thrust=1e308 * (1 - 2 * (tick % 2)), depth=thrust, time=thrust"),
         "refused", "not those that the run wrote"},
        {"report, a surface without vertices", Way::report, "session.db",
         session_after("INSERT INTO surface VALUES(1e-6, 1, 1, 1, x'', x'', x'', x'000000000000', 0, 0, 0)"), "refused",
         "triangles without vertices"},
        {"report, a surface of the wrong length", Way::report, "session.db",
         session_after(
             "INSERT INTO surface VALUES(1e-6, 1, 1, 1, x'0000000000000000', x'00000000', x'00', x'0000', 0, 0, 0)"),
         "refused", "triangles without vertices"},
        {"report, a zone without vertices", Way::report, "session.db",
         session_after("INSERT INTO zones VALUES(9, 'x', 1e-6, 1, 1, 1, x'', x'', x'000000000000', 0, 0, 0)"),
         "refused", "triangles without vertices"},
        {"report, a closest approach at infinity", Way::report, "session.db",
         session_after("INSERT INTO approaches VALUES('x', 'y', 9e999, 9e999, 9e999, -9e999, 0)"), "refused",
         "an approach without a point"},
        {"report, two hundred texts for one", Way::report, "session.db",
         session_after("WITH RECURSIVE n(i) AS (SELECT 0 UNION ALL SELECT i+1 FROM n WHERE i<200) INSERT INTO events "
                       "SELECT i, 0.0, 'x', printf('%.90000c', 'x') FROM n"),
         "refused", "not those that the run wrote"},
        {"report, events that are a view without end", Way::report, "session.db",
         session_after("DROP TABLE events; CREATE VIEW events AS WITH RECURSIVE n(tick) AS (SELECT 0 UNION ALL SELECT "
                       "tick+1 FROM n) "
                       "SELECT tick, 0.0 AS time, 'x' AS id, 'x' AS detail FROM n"),
         "refused", "computes its table `events`"},
    };
}

}  // namespace kerf::test
