// SPDX-License-Identifier: Apache-2.0
// One mistake in a shipped procedure gives one error: no second one follows from it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "run/documents.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

struct Mistake {
    const char *right, *wrong;  ///< the first `right` is replaced
    const char* code;           ///< of the one error
    const char* write;          ///< that it suggests
    const char* file = "pedicle-screw.yaml";
    const char* procedure = nullptr;  ///< null: `file`, or pedicle-screw.yaml for an anatomy
};

text::Diagnostics found_in(const Mistake& mistake) {
    const test::TemporaryFolder folder;
    std::filesystem::copy(KERF_SOURCE_DIR "/procedures", folder.path(),
                          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
    std::string text = test::contents_of(folder / mistake.file);
    const std::size_t at = text.find(mistake.right);
    if (at == std::string::npos) throw std::runtime_error(std::string("no ") + mistake.right);
    text.replace(at, std::string(mistake.right).size(), mistake.wrong);
    std::ofstream(folder / mistake.file, std::ios::binary) << text;

    const bool is_procedure = std::string(mistake.file).find('/') == std::string::npos;
    const run::DocumentRequest request{.procedure = folder / (mistake.procedure != nullptr ? mistake.procedure
                                                              : is_procedure               ? mistake.file
                                                                                           : "pedicle-screw.yaml")};
    text::Diagnostics found;
    (void)run::check_documents(request, test::plugins()).take(found);
    for (text::Diagnostic& d : run::check_variants(request, found, test::plugins())) found.push_back(std::move(d));
    return found;
}

class SingleMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SingleMistake, GivesOneError) {
    const text::Diagnostics found = found_in(GetParam());
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found.front().code, GetParam().code) << to_text(found);
    EXPECT_EQ(found.front().write, GetParam().write) << to_text(found);
}

INSTANTIATE_TEST_SUITE_P(
    Names, SingleMistake,
    testing::Values(Mistake{"landmarks: [right_pedicle,", "landmarks: [rigth_pedicle,", "E0501", "right_pedicle"},
                    Mistake{"landmarks: [right_pedicle,", "landmarks: [femur_axis,", "E0501", "right_pedicle"},
                    Mistake{"landmarks: [right_pedicle, ", "landmarks: [", "E0308", ""},
                    Mistake{"zones: [canal]", "zones: [cannal]", "E0502", "canal"},
                    Mistake{"  zones: [canal]\n", "", "E0307", ""},
                    Mistake{"clearance: {zone: canal", "clearance: {zone: cord", "E0307", ""},
                    Mistake{"plugin: kerf.drilling", "plugin: acme.laser", "E0301", ""},
                    Mistake{"    plugin: kerf.drilling\n", "", "E0204", ""},
                    Mistake{"force: drill_cutting", "force: drill_cuting", "E0303", "drill_cutting"},
                    Mistake{"- id: opening\n", "- id: openning\n", "E0312", "openning"},
                    Mistake{"  - id: opening\n    title", "  - title", "E0204", ""},
                    Mistake{"- id: pilot-hole", "- id: pilot hole", "E0209", "pilot-hole"},
                    Mistake{"- {torque: {at_most", "- {moment: {at_most", "E0203", ""},
                    Mistake{"  straight:\n", "  strait:\n", "E0315", "strait"}));

INSTANTIATE_TEST_SUITE_P(Keys, SingleMistake,
                         testing::Values(Mistake{"\nsteps:", "\nstages:", "E0203", "steps:"},
                                         Mistake{"\ninstruments:", "\ntools:", "E0203", "instruments:"},
                                         Mistake{"\nneeds:", "\nwants:", "E0203", "needs:"},
                                         Mistake{"\nanatomy:", "\nbone:", "E0203", "anatomy:"},
                                         Mistake{"\nmetadata:", "\nheader:", "E0203", "metadata:"},
                                         Mistake{"\npaths:", "\nmotions:", "E0203", ""},
                                         Mistake{"\nrehearsals:", "\ntrials:", "E0203", ""},
                                         Mistake{"\nzones:", "\nregions:", "E0203", "", "anatomy/vertebra-l3.yaml"}));

INSTANTIATE_TEST_SUITE_P(OfTwoParts, SingleMistake,
                         testing::Values(Mistake{"  pilot:\n", "  pilott:\n", "E0306", "pilott"},
                                         Mistake{"- id: opening\n", "- id: pilot-hole\n", "E0208", "opening"},
                                         Mistake{"instruments.tap.param", "instruments.tpa.param", "E0212",
                                                 "instruments.tap.parameters.outer_diameter:"},
                                         Mistake{"rehearsals.medial-breach: ~\n", "rehearsals.medial-breech: ~\n",
                                                 "E0212", "rehearsals.medial-breach:"},
                                         Mistake{
                                             "instruments.opener.plugin: kerf.burring\n      instruments.opener.tool",
                                             "instruments.openr.plugin: kerf.burring\n      instruments.openr.tool",
                                             "E0212", "instruments.opener.plugin:"}));

INSTANTIATE_TEST_SUITE_P(
    OfOtherProcedures, SingleMistake,
    testing::Values(
        Mistake{"normal: 0 0 -1,", "normal: 0 0 1,", "E0531", "normal: 0 0 -1", "anatomy/knee.yaml", "amputation.yaml"},
        Mistake{"-46.67 0.81 9.26 mm, normal: 0 0.4695 -0.8829", "-46.67 0.81 9.26 mm, normal: 0 -0.4695 0.8829",
                "E0531", "normal: 0 0.4695 -0.8829", "anatomy/mandible.yaml", "mandibular-angle-reduction.yaml"},
        Mistake{"working_force: 15 N", "force_scale: 200", "E0412", "1/200", "trochanter-fixation.yaml",
                "trochanter-fixation.yaml"},
        Mistake{"steps.cut-3.title: Last", "steps.cut-5.title: Last", "E0212", "", "amputation.yaml",
                "amputation.yaml"},
        Mistake{"level: L4", "level: C5", "E0207", "", "pedicle-awl.yaml", "pedicle-awl.yaml"},
        Mistake{"level: L4", "level: l4", "E0207", "L4", "pedicle-awl.yaml", "pedicle-awl.yaml"},
        Mistake{"- {depth: {at_most: 30 mm}", "- {depth: {at_least: 30 mm}", "E0406", "at_most: 30 mm",
                "pedicle-awl.yaml", "pedicle-awl.yaml"},
        Mistake{"clearance: {zone: canal, at_least: 0 mm}", "clearance: {zone: canal, at_most: 0 mm}", "E0406",
                "at_least: 0 mm", "pedicle-awl.yaml", "pedicle-awl.yaml"}));

INSTANTIATE_TEST_SUITE_P(
    Yaml, SingleMistake,
    testing::Values(Mistake{"      - {narrowest_offset:", "    limits:\n      - {narrowest_offset:", "E0108", ""},
                    Mistake{"  zones: [canal]\n", "  zones: [canal]\n  landmarks: [midline]\n", "E0108", ""},
                    Mistake{"  - id: tap\n", "steps:\n  - id: tap\n", "E0108", ""},
                    Mistake{"plunge: {at_most: 8 mm}", "plunge: {at_most: 8 mm", "E0105", "",
                            "trochanter-fixation.yaml"},
                    Mistake{"{entry: {}}", "{entry: {}", "E0105", ""},
                    Mistake{"{depth: {at_most: 38 mm}", "{depth: {at_most: 38 mm", "E0105", ""},
                    Mistake{"at: 0 -0.01 -13.33 mm", "at: 0, -0.01, -13.33 mm", "E0405", "0 -0.01 -13.33 mm",
                            "anatomy/vertebra-l3.yaml"}));

INSTANTIATE_TEST_SUITE_P(
    Sections, SingleMistake,
    testing::Values(
        Mistake{"at_least: 0 mm}, severity: critical", "at_least: 0 mm}, weight: 3", "E0203", ""},
        Mistake{"      - {depth: {at_least: 30 mm}}\n",
                "      - {depth: {at_least: 30 mm}}\n      - {hole_angle: {at_most: 5 deg}}\n", "E0203", ""},
        Mistake{"      - {depth: {at_least: 30 mm}}\n",
                "      - {depth: {at_least: 30 mm}}\n      - {clearance: {zone: canal, at_least: 1 mm}}\n", "E0203",
                ""},
        Mistake{"      - {depth: {at_least: 30 mm}}\n",
                "      - {depth: {at_least: 30 mm}}\n      - {duration: {at_most: 50 s}}\n", "E0203", ""},
        Mistake{"      - {depth: {at_most: 8 mm}", "      - {entry: {}}\n      - {depth: {at_most: 8 mm}", "E0203", ""},
        Mistake{"      - {depth: {at_least: 4 mm}}\n",
                "      - {depth: {at_least: 4 mm}}\n      - {duration: {at_most: 50 s}, reason: Too slow.}\n", "E0203",
                ""},
        Mistake{"\naccuracy: {spacing: 0.25 mm}\n", "\nspacing: 0.25 mm\n", "E0203", ""},
        Mistake{"    parameters: {diameter: 3.2 mm}\n", "    diameter: 3.2 mm\n", "E0203", ""},
        Mistake{"apiVersion:", "extends: left.yaml\napiVersion:", "E0203", ""}));

INSTANTIATE_TEST_SUITE_P(
    Values, SingleMistake,
    testing::Values(
        Mistake{"plugin: kerf.burring", "plugin: kerf.drilling", "E0302", "kerf.burring", "pedicle-burr.yaml"},
        Mistake{"plugin: kerf.implant", "plugin: kerf.drilling", "E0302", "kerf.implant"},
        Mistake{"time_limit: 360 s", "time_limit: 2:30", "E0401", "150 s"},
        Mistake{"time_limit: 360 s", "time_limit: 0:10:00", "E0401", "600 s"},
        Mistake{"    goals:\n      - {entry: {}}\n      - {depth: {at_least: 4 mm}}\n", "    goals: []\n", "E0206", ""},
        Mistake{"    title: {en: Cut the thread, de: Das Gewinde schneiden}\n", "    title:\n", "E0206", ""},
        Mistake{"in: sagittal, side: posterior", "in: posterior_left, side: posterior", "E0319", "",
                "mandibular-angle-reduction.yaml"}));

/// The one error that a mistake gives.
std::string message_of(const Mistake& mistake) {
    const text::Diagnostics found = found_in(mistake);
    EXPECT_EQ(found.size(), 1u) << to_text(found);
    return found.empty() ? std::string() : found.front().message;
}

TEST(SingleMistakes, NameTheSectionThatAKeyBelongsTo) {
    EXPECT_EQ(
        message_of({"at_least: 0 mm}, severity: critical", "at_least: 0 mm}, weight: 3", "", ""}),
        "The key `weight` is unknown: expected `severity`, `guard` or `reason`. `weight` belongs under `scoring:`. "
        "Move it there.");
    EXPECT_EQ(message_of({"      - {depth: {at_least: 30 mm}}\n", "      - {hole_angle: {at_most: 5 deg}}\n", "", ""}),
              "The key `hole_angle` is unknown here. `hole_angle` belongs under `limits:`. Move it there.");
    EXPECT_EQ(message_of({"\naccuracy: {spacing: 0.25 mm}\n", "\nspacing: 0.25 mm\n", "", ""}),
              "The key `spacing` is unknown here. `spacing` belongs under `accuracy:`. Move it there.");
}

TEST(SingleMistakes, ShowHowToFillARequiredList) {
    EXPECT_EQ(
        message_of({"    goals:\n      - {entry: {}}\n      - {depth: {at_least: 4 mm}}\n", "    goals: []\n", "", ""}),
        "opening.goals is an empty list. Add an item, as in `goals: [{entry: {}}, {depth: {at_least: 30 mm}}]`.");
}

TEST(SingleMistakes, PointAtTheBracketThatIsNotClosed) {
    const text::Diagnostics found =
        found_in({"plunge: {at_most: 8 mm}", "plunge: {at_most: 8 mm", "", "", "trochanter-fixation.yaml"});
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found.front().place.line, 123);
    EXPECT_NE(found.front().message.find("This `{` is never closed."), std::string::npos) << to_text(found);
}

TEST(SingleMistakes, ReadTheValuesOfAliases) {
    const text::Diagnostics found = found_in({"  pilot:\n", "  pilot: &drill\n", "", ""});
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    const text::Diagnostics both = found_in(
        {"  pilot:\n    plugin: kerf.drilling\n    tool: twist_drill\n    force: drill_cutting\n    parameters: "
         "{diameter: 3.2 mm}\n    drives: {spindle_speed: 1000 rpm}\n  opener:\n    plugin: kerf.drilling\n    "
         "tool: twist_drill\n    force: drill_cutting\n",
         "  pilot: &drill\n    plugin: kerf.drilling\n    tool: twist_drill\n    force: drill_cutting\n    "
         "parameters: {diameter: 3.2 mm}\n    drives: {spindle_speed: 1000 rpm}\n  opener:\n    <<: *drill\n",
         "", ""});
    ASSERT_EQ(both.size(), 2u) << to_text(both);
    EXPECT_EQ(both[0].code, "E0109");
    EXPECT_EQ(both[1].code, "E0109");
}

TEST(SingleMistakes, ReadNothingElseOfADocumentThatExtendsAnother) {
    const text::Diagnostics found = found_in({"\nneeds:\n  landmarks: [right_pedicle, midline]\n",
                                              "\nextends: pedicle-awl.yaml\nother:\n  a: [b]\n", "", ""});
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_NE(found.front().message.find("as a variant under `variants:` of `pedicle-awl.yaml`, or as a file for "
                                         "`--patch`."),
              std::string::npos)
        << to_text(found);
}

TEST(SingleMistakes, ListTheLinesOfTheSameName) {
    const text::Diagnostics found = found_in({"  straight:\n", "  strait:\n", "", ""});
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_NE(found.front().message.find(" The same in lines 217 and 275."), std::string::npos) << to_text(found);
}

}  // namespace
}  // namespace kerf
