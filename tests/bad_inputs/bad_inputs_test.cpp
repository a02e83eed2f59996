// SPDX-License-Identifier: Apache-2.0
// Every input of the catalogue ends as its row says, in less than 5 s and with less than 1 GB.
//
// KERF_WRITE_TABLE=FILE writes what was expected and what came, row by row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "app/import_source.h"
#include "bone/image/scan.h"
#include "bone/import/landmark_checks.h"
#include "bone/import/make_body.h"
#include "bone/surface/read_surface.h"
#include "documents/read_anatomy.h"
#include "run/documents.h"
#include "session/read_session.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "tests/bad_inputs/guarded.h"
#include "tests/bad_inputs/input.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::test {
namespace {

constexpr double max_ms = 5000.0, max_mb = 1024.0;
constexpr double spacing = 1e-3;  // [m] of the bone that is made

const std::vector<Input>& catalogue() {
    static const std::vector<Input> all = [] {
        std::vector<Input> inputs;
        for (const auto& some :
             {image_inputs(), dicom_inputs(), surface_inputs(), markup_inputs(), document_inputs(), session_inputs()})
            inputs.insert(inputs.end(), some.begin(), some.end());
        return inputs;
    }();
    return all;
}

// ---- what is done with an input
// ---------------------------------------------------------------------------------------

/// "E0665" or "loaded W0671"; then what a person is told.
struct Ending {
    std::string codes, told;
    std::string wrong;  ///< of what was loaded: nothing, or the first thing that is not where it should be
};

/// Errors alone, or else that it was loaded and the warnings; each once, in their order.
Ending ending_of(const text::Diagnostics& found) {
    std::set<std::string> errors, warnings;
    for (const text::Diagnostic& d : found)
        (d.level == text::Diagnostic::Level::error ? errors : warnings).insert(d.code);
    Ending ending{errors.empty() ? "loaded" : "", to_text(found), ""};
    for (const std::string& code : errors.empty() ? warnings : errors)
        ending.codes += (ending.codes.empty() ? "" : " ") + code;
    return ending;
}

std::string at_text(Vec3 mm) {
    std::ostringstream text;
    text << "(" << mm.x << ", " << mm.y << ", " << mm.z << ") mm";
    return text.str();
}

/// Places on both sides of every face of the bone; what is mirrored at any plane gets some of them wrong.
std::string misplaced(const Body& body) {
    const Vec3 in_bone[]{{2, -3, -3},   {8, -3, -3},  {-3, -3, -3}, {2, 1.5, -3},
                         {2, -7.5, -3}, {2, -3, 2.5}, {2, -3, -8.5}};
    const Vec3 outside[]{{11, -3, -3}, {-6, -3, -3}, {2, 4.5, -3}, {2, -10.5, -3}, {2, -3, 5.5}, {2, -3, -11.5}};
    for (const Vec3 mm : in_bone)
        if (!(bone::locate_on_bone(body, 1e-3 * mm).distance < 0.0)) return at_text(mm) + " is not in bone";
    for (const Vec3 mm : outside)
        if (!(bone::locate_on_bone(body, 1e-3 * mm).distance > 0.0)) return at_text(mm) + " is in bone";
    return "";
}

/// Values of the imported file between voxels, where no border is near.
std::string misread(const std::string& file) {
    text::Diagnostics found;
    const auto scan = bone::open_scan(file, {}, {}).take(found);
    const auto image = scan ? scan->read(scan->grid().all(), 0, {}).take(found) : std::nullopt;
    if (!image) return "what import wrote cannot be read: " + to_text(found);
    for (const Vec3 mm :
         {Vec3{2.3, -3.0, -3.0}, {6.0, -5.5, -6.6}, {-8.4, -12.2, -13.0}, {2.0, 8.0, 9.0}, {-9.0, 8.3, -12.5}}) {
        const double is = image->sample_trilinear(1e-3 * mm, -9999.0), ought = Bone::value(mm.x, mm.y, mm.z);
        // Half a HU is what whole numbers lose; a shift of a quarter of a millimetre along x would be 1 HU.
        if (!(std::abs(is - ought) <= 0.51))
            return at_text(mm) + " holds " + std::to_string(is) + ", should " + std::to_string(ought);
    }
    return "";
}

std::string anatomy_of(const std::string& source) {
    return "apiVersion: kerf/v1\nkind: Anatomy\nmetadata: {id: block, title: A block}\n" + source +
           "\ntissues: [{id: bone, density: 1.5 g/cm3}]\nlandmarks:\n"
           "  points: {midline: {at: 9 0 0 mm, tolerance: 1 mm}}\n"
           "  axes: {way: {from: 2 -3 9 mm, to: 2 -3 -8 mm, tolerance: 1 mm}}\n"
           "zones: {nerve: [{tube: {from: 14 0 -9 mm, to: 14 0 9 mm, radius: 1 mm}}]}\n";
}

/// The bone that an anatomy makes of the source, if it does.
text::Diagnostics make_bone(const std::string& folder, const std::string& source, std::string& wrong) {
    write_file_of(folder + "/anatomy.yaml", anatomy_of(source));
    text::Diagnostics found;
    const auto anatomy = documents::read_anatomy(folder + "/anatomy.yaml").take(found);
    const auto body = anatomy ? bone::make_body(*anatomy, spacing).take(found) : std::nullopt;
    if (body && wrong.empty()) wrong = misplaced(*body);
    if (!body && !text::has_error(found)) wrong = "no bone, and no word why";
    return found;
}

std::string option_of(const std::string& options, const std::string& key) {
    const std::size_t at = options.find(key + ": ");
    if (at == std::string::npos) return "";
    const std::size_t from = at + key.size() + 2;
    return options.substr(from, options.find(',', from) - from);
}

/// Both ways in must say the same.
Ending joined(const text::Diagnostics& by_import, const text::Diagnostics& by_anatomy, std::string wrong) {
    const Ending a = ending_of(by_import), b = ending_of(by_anatomy);
    if (a.codes != b.codes) wrong = "import ends with `" + a.codes + "`, an anatomy with `" + b.codes + "`";
    return {a.codes, a.told + b.told, wrong};
}

Ending as_scan(const Input& input, const std::string& folder) {
    const bool may_resample = option_of(input.how, "resample") == "true";
    const std::string out = folder + "/imported.nrrd";
    const app::ImportOutcome imported = app::import_source(
        {folder + "/" + input.source, out, option_of(input.how, "series"), "", may_resample, "mm", ""});
    std::string wrong = imported.error;
    std::string kept;
    if (!text::has_error(imported.diagnostics) && input.how.find("labels") == std::string::npos) wrong += misread(out);
    const std::string source =
        "ct: {image: " + input.source + ", threshold: 0" + (input.how.empty() ? "" : ", " + input.how) + "}";
    const text::Diagnostics made = make_bone(folder, source, wrong);
    return joined(imported.diagnostics, made, wrong);
}

Ending as_surface(const Input& input, const std::string& folder) {
    const std::string unit = option_of(input.how, "unit"), frame = option_of(input.how, "frame");
    const std::string out = folder + "/imported.stl";
    const app::ImportOutcome imported =
        app::import_source({folder + "/" + input.source, input.how.find("repair") == std::string::npos ? out : "", "",
                            "", false, unit.empty() ? "mm" : unit, frame});
    std::string wrong;
    const std::string how = (unit.empty() ? "unit: mm" + std::string(input.how.empty() ? "" : ", ") : "") + input.how;
    const text::Diagnostics made = make_bone(folder, "mesh: {file: " + input.source + ", " + how + "}", wrong);
    if (!text::has_error(made)) wrong += imported.error;  // what both refuse is in order
    if (!text::has_error(imported.diagnostics) && !text::has_error(made) &&
        input.how.find("repair") == std::string::npos) {
        // What was written is the same bone again: millimetres, LPS.
        const text::Diagnostics again = make_bone(folder, "mesh: {file: imported.stl, unit: mm, frame: LPS}", wrong);
        if (text::has_error(again)) wrong = "what import wrote is refused: " + to_text(again);
    }
    if (input.how.find("repair") != std::string::npos) {  // import is not told of repairs
        Ending ending = ending_of(made);
        ending.wrong = wrong;
        return ending;
    }
    return joined(imported.diagnostics, made, wrong);
}

const std::string hole =
    "apiVersion: kerf/v1\nkind: Procedure\nmetadata: {id: hole, title: A hole, version: 0.1.0, status: draft}\n"
    "needs: {landmarks: [way], zones: [nerve], tissues: [bone]}\nanatomy: anatomy.yaml\naccuracy: {spacing: 1 mm}\n"
    "haptics: {device: touch}\ninstruments:\n  drill:\n    plugin: kerf.drilling\n    tool: twist_drill\n    force: "
    "drill_cutting\n"
    "    parameters: {diameter: 4 mm}\n    drives: {spindle_speed: 1000 rpm}\nsteps:\n  - id: drill\n    title: Drill\n"
    "    instrument: drill\n    axis: way\n    goals: [{depth: {at_least: 10 mm}}]\n"
    "rehearsals:\n  - id: expert\n    expect: pass\n    path: [{depth: -5 mm}, {depth: 12 mm}]\n";

const std::string phantom = "phantom: {parts: [{id: block, box: {centre: 2.5 -3 -3 mm, size: 14 12 14 mm}}]}";

Ending as_markups(const Input& input, const std::string& folder) {
    std::string anatomy = with_replaced(anatomy_of(phantom), "landmarks:\n",
                                        "landmarks:\n  markups: [{file: " + input.source + ", tolerance: 1 mm}]\n");
    write_file_of(folder + "/anatomy.yaml", anatomy);
    write_file_of(folder + "/hole.yaml", hole);
    text::Diagnostics found;
    const auto documents = run::check_documents({folder + "/hole.yaml"}, plugins()).take(found);
    Ending ending = ending_of(found);
    if (!documents) return ending;
    const auto& points = documents->anatomy.points;
    const auto entry =
        std::find_if(points.begin(), points.end(), [](const documents::LandmarkPoint& p) { return p.id == "entry"; });
    if (entry == points.end())
        ending.wrong = "there is no `entry`";
    else if (length(entry->at - 1e-3 * Vec3{3, -4, 5}) > 1e-9)
        ending.wrong = "`entry` is at " + at_text(1e3 * entry->at);
    return ending;
}

Ending as_document(const Input& input, const std::string& folder) {
    text::Diagnostics found;
    const bool is_anatomy = input.source == "anatomy.yaml";
    if (is_anatomy)
        write_file_of(folder + "/hole.yaml", hole);
    else
        write_file_of(folder + "/anatomy.yaml", anatomy_of(phantom));
    const auto documents =
        run::check_documents({folder + "/" + (is_anatomy ? "hole.yaml" : input.source)}, plugins()).take(found);
    Ending ending = ending_of(found);
    if (!documents) return ending;
    const auto body = bone::make_body(documents->anatomy, spacing).take(found);
    if (!body) return ending_of(found);
    ending.wrong = misplaced(*body);
    return ending;
}

Ending as_session(const Input& input, const std::string& folder) {
    std::string error;
    const auto inputs = session::read_session(folder + "/" + input.source, error);
    if (!inputs) return {"refused", error, error.empty() ? "no word why" : ""};
    const auto& last = inputs->device_from_handle.back();
    const bool is_whole = inputs->device_from_handle.size() == 200 && std::abs(last.position.x - 0.0199) < 1e-12;
    return {"loaded", "", is_whole ? "" : "the ticks are not those that were recorded"};
}

Ending as_report(const Input& input, const std::string& folder) {
    std::string error;
    const auto run = session::read_run(folder + "/" + input.source, error);
    if (!run) return {"refused", error, error.empty() ? "no word why" : ""};
    const bool is_whole =
        run->drawn.ticks() == 200 && std::abs(run->drawn.last()->device_from_handle.position.x - 0.0199) < 1e-12;
    const std::string page = session::report_html(run->summary, run->drawn, run->procedure);
    if (page.find(session::notice_line) == std::string::npos) return {"loaded", "", "the page has no notice"};
    return {run->missing.empty() ? "loaded" : "loaded as incomplete", run->missing,
            is_whole ? "" : "the ticks are not those that were recorded"};
}

std::string carried_out(const Input& input, const std::string& folder) {
    Ending ending;
    switch (input.way) {
        case Way::scan:
            ending = as_scan(input, folder);
            break;
        case Way::surface:
            ending = as_surface(input, folder);
            break;
        case Way::markups:
            ending = as_markups(input, folder);
            break;
        case Way::document:
            ending = as_document(input, folder);
            break;
        case Way::session:
            ending = as_session(input, folder);
            break;
        case Way::report:
            ending = as_report(input, folder);
            break;
    }
    return ending.codes + '\0' + ending.wrong + '\0' + ending.told;
}

// ---- the table
// --------------------------------------------------------------------------------------------------------

struct Row {
    const Input* input = nullptr;
    std::string got;
    double ms = 0.0, mb = 0.0;
};
std::vector<Row>& rows() {
    static std::vector<Row> all;
    return all;
}

class Table : public testing::Environment {
    void TearDown() override {
        std::string text;
        char line[400];
        const auto add = [&](const char* name, const char* expected, const char* got, const char* ms, const char* mb) {
            std::snprintf(line, sizeof line, "%-62s %-20s %-20s %7s %6s\n", name, expected, got, ms, mb);
            text += line;
        };
        add("input", "must end", "ended", "ms", "MB");
        int loaded = 0;
        for (const Row& row : rows()) {
            add(row.input->name.c_str(), row.input->ends.c_str(), row.got.c_str(),
                std::to_string(static_cast<int>(row.ms)).c_str(), std::to_string(static_cast<int>(row.mb)).c_str());
            loaded += row.input->ends.starts_with("loaded");
        }
        text += std::to_string(rows().size()) + " inputs: " + std::to_string(loaded) + " to be loaded, " +
                std::to_string(static_cast<int>(rows().size()) - loaded) + " to be refused\n";
        std::fputs(text.c_str(), stdout);
        if (const char* file = std::getenv("KERF_WRITE_TABLE")) std::ofstream(file, std::ios::binary) << text;
    }
};
[[maybe_unused]] const auto* const table = testing::AddGlobalTestEnvironment(new Table);

class BadInput : public testing::TestWithParam<std::size_t> {};

TEST_P(BadInput, EndsAsItsRowSays) {
    // Given
    const Input& input = catalogue()[GetParam()];
    const TemporaryFolder folder;
    input.make(folder.path());

    // When
    const Guarded outcome = guarded([&] { return carried_out(input, folder.path()); });

    // Then
    const std::size_t first = outcome.result.find('\0'), second = outcome.result.find('\0', first + 1);
    const bool is_whole = outcome.fault.empty() && second != std::string::npos;
    const std::string codes = is_whole ? outcome.result.substr(0, first) : outcome.fault;
    rows().push_back({&input, codes, outcome.ms, outcome.mb});
    ASSERT_TRUE(is_whole) << input.name << ": " << outcome.fault;
    const std::string told = outcome.result.substr(second + 1);
    EXPECT_EQ(codes, input.ends) << input.name << ": " << told;
    EXPECT_EQ(outcome.result.substr(first + 1, second - first - 1), "") << input.name << ": " << told;
    EXPECT_NE(told.find(input.words), std::string::npos)
        << input.name << ": `" << input.words << "` is not in: " << told;
    EXPECT_LT(outcome.ms, max_ms) << input.name;
    EXPECT_LT(outcome.mb, max_mb) << input.name;
}

std::vector<std::size_t> all_rows() {
    std::vector<std::size_t> numbers(catalogue().size());
    for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = n;
    return numbers;
}
std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
    std::string name = catalogue()[info.param].name;
    for (char& c : name)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'))) c = '_';
    return name;
}
INSTANTIATE_TEST_SUITE_P(Catalogue, BadInput, testing::ValuesIn(all_rows()), name_of);

TEST(Catalogue, HasAHundredInputsWithNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const Input& input : catalogue()) names.insert(input.name);
    EXPECT_EQ(names.size(), catalogue().size());
    EXPECT_GE(names.size(), 100u);
}

TEST(Catalogue, SaysOfAllThatIsRefusedWhatAPersonIsTold) {
    for (const Input& input : catalogue()) EXPECT_TRUE(input.ends == "loaded" || !input.words.empty()) << input.name;
}

// The guard itself: what it is there to catch, it catches.
TEST(Guarded, TellsOfACrashAThrowAndMemory) {
    EXPECT_EQ(guarded([]() -> std::string { std::abort(); }).fault, "signal 6");
    EXPECT_EQ(guarded([]() -> std::string { throw std::runtime_error("no"); }).fault, "threw: no");
    const Guarded greedy = guarded([] {
        const std::vector<char> much(300u << 20, 'x');
        return std::string(1, much[much.size() / 2]);
    });
    EXPECT_EQ(greedy.result, "x");
    EXPECT_GT(greedy.mb, 290.0);
    EXPECT_LT(guarded([] { return std::string("y"); }).mb, 20.0);
}

}  // namespace

void write_file_of(const std::string& file, const std::string& bytes) {
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), ignored);
    std::ofstream(file, std::ios::binary) << bytes;
}

std::string with_replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("there is no `" + from + "` to replace");
    return text.replace(at, from.size(), to);
}

}  // namespace kerf::test
