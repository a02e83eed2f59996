// SPDX-License-Identifier: Apache-2.0
#include "run/cheats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "documents/read_procedure.h"
#include "kerf/units.hpp"
#include "tests/support/drill_rig.h"

namespace kerf::run {
namespace {

using namespace literals;
using documents::HandInput;

documents::Procedure shipped(const std::string& name) {
    text::Diagnostics diagnostics;
    auto procedure = documents::read_procedure(KERF_SOURCE_DIR "/procedures/" + name, test::plugins().catalog(), {});
    EXPECT_TRUE(procedure) << text::to_text(procedure.diagnostics());
    return *std::move(procedure);
}

const Cheat& cheat(const std::vector<Cheat>& cheats, const std::string& id) {
    const auto found = std::find_if(cheats.begin(), cheats.end(), [&](const Cheat& one) { return one.id == id; });
    EXPECT_NE(found, cheats.end()) << id;
    return *found;
}

TEST(Cheats, AreMadeOfTheFirstHandThatPasses) {
    const documents::Procedure procedure = shipped("pedicle-screw.yaml");
    const documents::Rehearsal& expert = procedure.rehearsals.front();
    const std::vector<Cheat> cheats = cheats_of(procedure, test::plugins().catalog());

    EXPECT_EQ(cheat(cheats, "idle").rehearsal.path.size(), 1u);
    for (const auto& at : cheat(cheats, "outside").rehearsal.path) EXPECT_LE(at.depth, -5.0_mm);
    for (const auto& at : cheat(cheats, "withdrawn").rehearsal.path) EXPECT_LE(at.depth, 1.0_mm);
    EXPECT_EQ(cheat(cheats, "hasty").rehearsal.feed, 5.0 * expert.feed);
    EXPECT_EQ(cheat(cheats, "hasty").rehearsal.push, 5.0 * expert.push);
    for (const auto& at : cheat(cheats, "hammered").rehearsal.path) EXPECT_EQ(at.turn, 0.0);
    for (std::size_t i = 0; i < expert.path.size(); ++i)
        EXPECT_EQ(cheat(cheats, "beside").rehearsal.path[i].off_plan, 5.0_mm);
    for (std::size_t i = 0; i < expert.path.size(); ++i)
        EXPECT_EQ(cheat(cheats, "other-side").rehearsal.path[i].off_plan, -5.0_mm);
    const auto& twice = cheat(cheats, "begun-beside").rehearsal.path;
    const std::size_t begun = twice.size() - expert.path.size();
    EXPECT_EQ(begun, static_cast<std::size_t>(std::count_if(expert.path.begin(), expert.path.end(),
                                                            [](const auto& at) { return at.step == 0; })));
    for (std::size_t i = 0; i < begun; ++i) {
        EXPECT_EQ(twice[i].off_plan, 5.0_mm);
        EXPECT_DOUBLE_EQ(twice[i].depth, expert.path[i].depth * (expert.path[i].depth > 0.0 ? 0.6 : 1.0));
    }
    EXPECT_EQ(twice[begun].off_plan, 0.0);
    EXPECT_EQ(cheat(cheats, "drive-off").rehearsal.path.front().inputs.front().id, "spindle_speed");
    EXPECT_EQ(cheat(cheats, "drive-off").rehearsal.path.front().inputs.front().value, 0.0);
}

TEST(Cheats, BeginBesideThePlanWhereNothingHoldsTheTool) {
    documents::Procedure procedure = shipped("trochanter-fixation.yaml");
    const auto begun = [&] { return cheat(cheats_of(procedure, test::plugins().catalog()), "begun-beside"); };
    EXPECT_EQ(begun().why_not, "a sleeve or an implant's hole holds every tool that cuts on the plan");

    // A drill without a sleeve, beside an axis of the bone: it begins there, not with the forceps before
    const auto drill = std::find_if(procedure.steps.begin(), procedure.steps.end(),
                                    [](const auto& step) { return step.id == "hole-2"; });
    drill->axis = "shaft";
    const auto step = static_cast<std::size_t>(drill - procedure.steps.begin());
    const Cheat cheat = begun();
    EXPECT_EQ(cheat.why_not, "");
    const auto& path = cheat.rehearsal.path;
    const auto at = std::find_if(path.begin(), path.end(), [](const auto& one) { return one.off_plan != 0.0; });
    ASSERT_NE(at, path.end());
    EXPECT_EQ(at->step, step);
    EXPECT_NE((at - 1)->step, step) << "from its start";
}

TEST(Cheats, BackAnImplantOutBeforeItIsLeft) {
    const documents::Procedure procedure = shipped("pedicle-screw.yaml");
    const documents::Waypoint& in = procedure.rehearsals.front().path.back();
    const std::vector<Cheat> cheats = cheats_of(procedure, test::plugins().catalog());
    const auto& path = cheat(cheats, "backed-out").rehearsal.path;
    ASSERT_EQ(path.size(), procedure.rehearsals.front().path.size() + 1);
    EXPECT_TRUE(path[path.size() - 2].inputs.empty()) << "it is not yet released";
    EXPECT_DOUBLE_EQ(path.back().turn, -0.6 * in.turn);
    EXPECT_DOUBLE_EQ(path.back().depth, 35.0_mm - 0.6 * 37.0_mm) << "it came from 2 mm above";
    EXPECT_EQ(path.back().inputs.back().kind, HandInput::Kind::release);
}

TEST(Cheats, SayWhyTheyDoNotApply) {
    const std::vector<Cheat> cheats = cheats_of(shipped("amputation.yaml"), test::plugins().catalog());
    EXPECT_EQ(cheat(cheats, "backed-out").why_not, "no waypoint turns and releases an implant");
    EXPECT_EQ(cheat(cheats, "beside").why_not, "") << "off the plane of its cuts";
    documents::Procedure without = shipped("pedicle-awl.yaml");
    without.rehearsals.clear();
    EXPECT_TRUE(cheats_of(without, test::plugins().catalog()).empty());
}

}  // namespace
}  // namespace kerf::run
