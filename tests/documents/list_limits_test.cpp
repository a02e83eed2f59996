// SPDX-License-Identifier: Apache-2.0
// Documents whose lists are too long are refused before they are read further.
#include "documents/list_limits.h"

#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "catalog.h"
#include "documents/read_anatomy.h"
#include "documents/read_procedure.h"

namespace kerf::documents {
namespace {

std::string repeated(int count, const std::string& before, const std::string& after) {
    std::string text;
    for (int i = 0; i < count; ++i) text += before + std::to_string(i) + after + "\n";
    return text;
}

/// Reads a document in at most a second of the processor, however long it is. Returns its only error.
template <class Read>
text::Diagnostic only_error(Read read) {
    const std::clock_t start = std::clock();
    const auto result = read();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(seconds, 2.0);
    EXPECT_FALSE(result);
    text::Diagnostic error;
    int errors = 0;
    for (const text::Diagnostic& d : result.diagnostics())
        if (d.level == text::Diagnostic::Level::error) ++errors, error = d;
    EXPECT_EQ(errors, 1) << to_text(result.diagnostics());
    return error;
}

text::Diagnostic error_of_procedure(const std::string& text) {
    return only_error([&] {
        return read_procedure_text("p.yaml", "apiVersion: kerf/v1\nkind: Procedure\n" + text, drilling_catalog());
    });
}

text::Diagnostic error_of_anatomy(const std::string& text) {
    return only_error([&] { return read_anatomy_text("a.yaml", "apiVersion: kerf/v1\nkind: Anatomy\n" + text); });
}

void expect_too_many(const text::Diagnostic& error, const std::string& what) {
    EXPECT_EQ(error.code, "E0412");
    EXPECT_EQ(error.message.substr(0, what.size()), what);
    EXPECT_GT(error.place.line, 0);
}

TEST(ListLimits, RefuseALongProcedureAtOnce) {
    expect_too_many(error_of_procedure("variants:\n" + repeated(1600, "  v", ": {patch: {steps.s.feed: 1 mm/s}}")),
                    "There are too many variants: got 1600, expected at most 32. Move some");
    expect_too_many(error_of_procedure("steps:\n" + repeated(9000, "  - {id: s", "}")),
                    "There are too many steps: got 9000, expected at most 256. Split");
    expect_too_many(
        error_of_procedure("steps:\n  - id: s\n    goals:\n" + repeated(5000, "      - {depth: {at_least: ", " mm}}")),
        "There are too many goals: got 5000, expected at most 64.");
    expect_too_many(error_of_procedure("instruments:\n" + repeated(9000, "  i", ": {plugin: kerf.drilling}")),
                    "There are too many instruments: got 9000, expected at most 64.");
    expect_too_many(error_of_procedure("rehearsals:\n" + repeated(3000, "  r", ": {}")),
                    "There are too many rehearsals");
    const std::string too_many = "got 12000, expected at most 10000. Write shorter paths.";
    const std::string waypoints = repeated(12000, "      - {depth: ", " mm}");
    expect_too_many(error_of_procedure("rehearsals:\n  - id: r\n    path:\n" + waypoints),
                    "There are too many waypoints in the rehearsals: " + too_many);
    expect_too_many(error_of_procedure("paths:\n  a:\n" + waypoints),
                    "There are too many waypoints in `paths`: " + too_many);
}

TEST(ListLimits, CountTheWaypointsOfAllRehearsals) {
    std::string half = "    path:\n" + repeated(5000, "      - {depth: ", " mm}");
    const auto error =
        error_of_procedure("rehearsals:\n  - id: r\n" + half + "  - id: s\n" + half + "      - {step: s}\n");
    expect_too_many(error, "There are too many waypoints in the rehearsals: got 10001, expected at most 10000.");
    EXPECT_EQ(error.place.line, 2 + 1 + 2 * (2 + 5000) + 1);
}

TEST(ListLimits, RefuseALongAnatomyAtOnce) {
    expect_too_many(error_of_anatomy("phantom:\n  parts:\n" +
                                     repeated(9000, "    p", ": {ellipsoid: {center: 0 0 0 mm, radii: 9 9 9 mm}}")),
                    "There are too many parts: got 9000, expected at most 256.");
    expect_too_many(error_of_anatomy("zones:\n" + repeated(9000, "  z", ": [{tissue: bone}]")),
                    "There are too many zones: got 9000, expected at most 64.");
    expect_too_many(error_of_anatomy("zones:\n  canal:\n" + repeated(9000, "    - {tissue: bone", "}")),
                    "There are too many solids of a zone: got 9000");
    expect_too_many(error_of_anatomy("landmarks:\n  points:\n" + repeated(9000, "    p", ": 0 0 0 mm")),
                    "There are too many points: got 9000");
}

}  // namespace
}  // namespace kerf::documents
