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
    const char* procedure = "pedicle-screw.yaml";
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

    const run::DocumentRequest request{.procedure = folder / mistake.procedure};
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

TEST(SingleMistakes, ListTheLinesOfTheSameName) {
    const text::Diagnostics found = found_in({"  straight:\n", "  strait:\n", "", ""});
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_NE(found.front().message.find(" The same in lines 217 and 275."), std::string::npos) << to_text(found);
}

}  // namespace
}  // namespace kerf
