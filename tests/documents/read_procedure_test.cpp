// SPDX-License-Identifier: Apache-2.0
#include "documents/read_procedure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "documents/check_needs.h"
#include "kerf/units.hpp"
#include "tests/documents/catalog.h"
#include "tests/documents/marked_text.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

using namespace literals;

// A procedure without fault. Each test changes one thing.
const std::string faultless = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft, authors: [A. Author]}
needs: {landmarks: [pedicle, midline], zones: [canal], tissues: [cortical]}
anatomy: anatomy/bone.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch, force_scale: 1/50}
time_limit: 60 s
instruments:
  pilot:
    plugin: kerf.drilling
    tool: twist_drill
    force: drill_cutting
    parameters: {diameter: 4 mm, wear: 0.5}
    drives: {spindle_speed: 1000 rpm}
steps:
  - id: drill
    title: Drill
    instrument: pilot
    axis: pedicle
    goals: [ {entry: {}}, {depth: {at_least: 30 mm}} ]
    limits:
      - {clearance: {zone: canal, at_least: 0 mm}, reason: The canal.}
      - {depth: {at_most: 38 mm}, reason: Too deep.}
rehearsals:
  - id: expert
    expect: pass
    hand: {feed: 2 mm/s, approach: 10 mm/s, push: 50 N, reaction: 100 ms}
    path: [ {depth: -5 mm}, {depth: 32 mm} ]
  - id: breach
    expect: {fail: canal}
    path: [ {depth: -5 mm, medial: 5 mm}, {depth: 32 mm, medial: 5 mm, medial_angle: -10 deg} ]
)";

std::optional<Procedure> read(const std::string& text, text::Diagnostics& diagnostics) {
    return read_procedure_text("folder/hole.yaml", text, drilling_catalog()).take(diagnostics);
}

void expect_refused(text::Code code, std::string_view from, std::string_view to) {
    SCOPED_TRACE(std::string(to));
    const MarkedText marked(replaced(faultless, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadProcedure, GivesWordsInTheFirstLanguageAndTranslations) {
    text::Diagnostics diagnostics;
    std::string text = replaced(faultless, "title: A hole", "title: {de: Ein Loch, en: A hole, de-AT: A Loch}");
    text =
        replaced(text, "title: Drill\n", "title: {de: Bohren, en: Drill}\n    hint: {de: Gerade, en: Straight on}\n");
    text = replaced(text, "reason: Too deep.", "reason: {de: Zu tief., en: Too deep.}");
    const std::optional<Procedure> procedure = read(text, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_EQ(procedure->title, "Ein Loch");
    EXPECT_EQ(procedure->steps[0].title, "Bohren");
    EXPECT_EQ(procedure->steps[0].hint, "Gerade");
    EXPECT_EQ(procedure->steps[0].limits[1].reason, "Zu tief.");
    const Translations& translations = procedure->translations;
    EXPECT_EQ(translations.languages(), (std::vector<std::string>{"de-AT", "en"}));
    EXPECT_EQ(translations.of("Ein Loch", "en"), "A hole");
    EXPECT_EQ(translations.of("Ein Loch", "en-GB"), "A hole");
    EXPECT_EQ(translations.of("Ein Loch", "de-AT"), "A Loch");
    EXPECT_EQ(translations.of("Ein Loch", "de"), "Ein Loch");
    EXPECT_EQ(translations.of("Ein Loch", "fr"), "Ein Loch");
    EXPECT_EQ(translations.within("Schritt: Zu tief. 40 mm", "en"), "Schritt: Too deep. 40 mm");
}

TEST(ReadProcedure, RefusesWordsWithoutALanguage) {
    expect_refused(text::Code::malformed_word, "title: A hole", "title: {«english»: A hole}");
    expect_refused(text::Code::malformed_word, "title: A hole", "title: {«de_AT»: Ein Loch}");
    expect_refused(text::Code::empty_value, "title: A hole", "title: «{»}");
    expect_refused(text::Code::wrong_shape, "title: A hole", "title: {en: «[»A hole]}");
}

TEST(ReadProcedure, GivesAssistanceAndTheDisplayOfZones) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> plain = read(faultless, diagnostics);
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->assist, Assist::full);
    EXPECT_TRUE(plain->zones.empty());
    const std::optional<Procedure> other =
        read(faultless + "assist: on-request\nzones: {canal: {show: near, within: 3 mm}}\n", diagnostics);
    ASSERT_TRUE(other) << to_text(diagnostics);
    EXPECT_EQ(other->assist, Assist::on_request);
    ASSERT_EQ(other->zones.size(), 1u);
    EXPECT_EQ(other->zones[0].zone, "canal");
    EXPECT_EQ(other->zones[0].show, ZoneDisplay::Show::near);
    EXPECT_EQ(other->zones[0].within, 3.0_mm);

    expect_refused(text::Code::unknown_word, "time_limit: 60 s", "time_limit: 60 s\nassist: «some»");
    expect_refused(text::Code::undeclared_zone, "time_limit: 60 s",
                   "time_limit: 60 s\nzones: {«cannal»: {show: near}}");
    expect_refused(text::Code::unknown_word, "time_limit: 60 s", "time_limit: 60 s\nzones: {canal: {show: «often»}}");
}

TEST(ReadProcedure, GivesSiValuesInDeclaredOrder) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> procedure = read(faultless, diagnostics);

    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    EXPECT_EQ(procedure->spacing, 0.5_mm);
    EXPECT_EQ(procedure->force_scale, 1.0 / 50.0);
    EXPECT_FALSE(procedure->is_direct);
    EXPECT_EQ(procedure->time_limit, 60.0_s);
    ASSERT_EQ(procedure->instruments.size(), 1u);
    EXPECT_EQ(procedure->instruments[0].tool_parameters, (std::vector<double>{4.0_mm, 118.0_deg /* the default */}));
    EXPECT_EQ(procedure->instruments[0].force_parameters, (std::vector<double>{0.5}));
    EXPECT_EQ(procedure->instruments[0].drives, (std::vector<double>{1000.0_rpm}));
}

TEST(ReadProcedure, FindsAStrategyByTheLastWordsOfItsId) {
    ComponentCatalog catalog = drilling_catalog();
    ComponentInfo groove;
    groove.kind = KERF_KIND_REMESHER;
    groove.plugin = "example.chisel";
    groove.id = "groove";
    catalog.push_back(groove);
    const auto read_with = [&](const std::string& remeshing, text::Diagnostics& diagnostics) {
        const std::string text = replaced(
            faultless, "    tool: twist_drill\n",
            "    tool: twist_drill\n    remeshing: " + remeshing + "\n    remeshing_parameters: {depth: 1 mm}\n");
        return read_procedure_text("folder/hole.yaml", text, catalog).take(diagnostics);
    };
    for (const char* word : {"groove", "chisel.groove", "example.chisel.groove"}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_with(word, diagnostics)) << "it has no parameter `depth`";
        ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
        EXPECT_NE(to_text(diagnostics).find("example.chisel.groove has none"), std::string::npos);
    }
    {  // what is not installed is replaced at run time
        text::Diagnostics diagnostics;
        const auto procedure = read_with("example.lathe.ring", diagnostics);
        ASSERT_TRUE(procedure) << to_text(diagnostics);
        EXPECT_EQ(procedure->instruments[0].remeshing, "example.lathe.ring");
    }
    for (const char* word : {"example.chisel.grove", "example.chizel.groove", "example.chisel.ring", "ring"}) {
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read_with(word, diagnostics)) << word;
        ASSERT_EQ(diagnostics.size(), 1u) << "its parameters are no second error: " << to_text(diagnostics);
        EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::unknown_strategy)) << word;
    }
    groove.plugin = "example.gouge";
    catalog.push_back(groove);
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_with("groove", diagnostics));
    EXPECT_NE(to_text(diagnostics).find("2 owners: expected one of `example.chisel.groove` or `example.gouge.groove`"),
              std::string::npos)
        << to_text(diagnostics);
}

TEST(ReadProcedure, GivesGoalsLimitsAndRehearsals) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> procedure = read(faultless, diagnostics);

    ASSERT_TRUE(procedure) << to_text(diagnostics);
    const Step& step = procedure->steps.at(0);
    EXPECT_EQ(step.goals.at(0).quantity, "entry");
    EXPECT_EQ(step.goals.at(1).bound.at_least, 30.0_mm);
    EXPECT_EQ(step.limits.at(0).zone, "canal");
    EXPECT_EQ(step.limits.at(0).place.line, 23);
    EXPECT_EQ(step.limits.at(1).bound.at_most, 38.0_mm);
    EXPECT_FALSE(step.limits.at(1).bound.at_least);
    EXPECT_EQ(procedure->rehearsals.at(0).feed, 2.0_mm_per_s);
    EXPECT_EQ(procedure->rehearsals.at(1).expect, "fail");
    EXPECT_EQ(procedure->rehearsals.at(1).expect_limit, "canal");
    EXPECT_EQ(procedure->rehearsals.at(1).path.at(1).medial, 5.0_mm);
    EXPECT_EQ(procedure->rehearsals.at(1).path.at(1).medial_angle, -10.0_deg);
}

TEST(ReadProcedure, DamageOfTheToolIsALimitOfTheStepUnlessItIsAllowed) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> strict = read(faultless, diagnostics);
    ASSERT_TRUE(strict) << to_text(diagnostics);
    const Limit& damage = strict->steps.at(0).limits.at(2);
    EXPECT_EQ(damage.quantity, "damage");
    EXPECT_EQ(damage.name(), "drilling.bit_overbent");
    EXPECT_EQ(damage.reason, "The bit was bent.");
    EXPECT_EQ(strict->steps.at(0).limits.size(), 3u) << "a stalled spindle is no damage";

    const std::optional<Procedure> lenient =
        read(replaced(faultless, "    axis: pedicle\n", "    axis: pedicle\n    allow: [drilling.bit_overbent]\n"),
             diagnostics);
    ASSERT_TRUE(lenient) << to_text(diagnostics);
    EXPECT_EQ(lenient->steps.at(0).limits.size(), 2u);
    expect_refused(text::Code::unknown_event, "    axis: pedicle\n",
                   "    axis: pedicle\n    allow: [«drilling.stalled»]\n");
}

TEST(ReadProcedure, ARehearsalMayExpectDamageAndOtherLimitsBeside) {
    text::Diagnostics diagnostics;
    const auto procedure =
        read(replaced(faultless, "{fail: canal}", "{fail: drilling.bit_overbent, others: true}"), diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_EQ(procedure->rehearsals.at(1).expect_limit, "drilling.bit_overbent");
    EXPECT_TRUE(procedure->rehearsals.at(1).expects_others);
    EXPECT_FALSE(procedure->rehearsals.at(0).expects_others);
}

TEST(ReadProcedure, ReadsATurnWithItsTorqueEndAndGrips) {
    const auto turn = [](const std::string& keys) {
        text::Diagnostics diagnostics;
        const auto procedure = read(
            replaced(faultless, "{depth: 32 mm} ]", "{depth: 32 mm, turn: {by: -2 turns" + keys + "}} ]"), diagnostics);
        EXPECT_TRUE(procedure) << to_text(diagnostics);
        return procedure ? procedure->rehearsals.at(0).path.at(1) : Waypoint{};
    };
    const Waypoint plain = turn("");
    EXPECT_EQ(plain.turn, -2.0_turns);
    EXPECT_EQ(plain.turning, default_turning);
    EXPECT_FALSE(plain.turn_torque || plain.until_torque);
    EXPECT_EQ(plain.until_event, "");
    EXPECT_EQ(plain.regrip, 0.0);
    const Waypoint full = turn(", speed: 15 rpm, torque: 3 N*m, until: {torque: 200 N*cm}, regrip: 0.5 turns");
    EXPECT_EQ(full.turn_torque, 3.0);
    EXPECT_EQ(full.until_torque, 2.0);
    EXPECT_DOUBLE_EQ(full.regrip, 180.0_deg);
    EXPECT_EQ(turn(", until: {event: drilling.stalled}").until_event, "drilling.stalled");
}

TEST(ReadProcedure, RefusesATurnThatNoHandMakesAndWaitsForNoUnknownEvent) {
    const auto refused = [](text::Code code, const std::string& turn) {
        expect_refused(code, "{depth: 32 mm} ]", "{depth: 32 mm, turn: {by: 2 turns, " + turn + "}} ]");
    };
    refused(text::Code::out_of_range, "torque: «21 N*m»");
    refused(text::Code::wrong_dimension, "torque: «3 N»");
    refused(text::Code::out_of_range, "until: {torque: «0 N*m»}");
    refused(text::Code::out_of_range, "regrip: «10 deg»");
    refused(text::Code::wrong_dimension, "regrip: «180 mm»");
    refused(text::Code::unknown_event, "until: {event: «implant.head_contact»}");
    text::Diagnostics diagnostics;
    read(replaced(faultless, "{depth: 32 mm} ]",
                  "{depth: 32 mm, turn: {by: 2 turns, until: {event: drilling.staled}}} ]"),
         diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_NE(to_text(diagnostics)
                  .find("The event `drilling.staled` is unknown: expected `drilling.bit_overbent` or "
                        "`drilling.stalled` of `pilot`. Write `drilling.stalled`."),
              std::string::npos)
        << to_text(diagnostics);
    for (const char* until : {"{}", "{torque: 2 N*m, event: drilling.stalled}", "2 N*m"}) {
        text::Diagnostics found;
        EXPECT_FALSE(read(replaced(faultless, "{depth: 32 mm} ]",
                                   std::string("{depth: 32 mm, turn: {by: 2 turns, until: ") + until + "}} ]"),
                          found))
            << until;
    }
}

TEST(HandInput, IsReadAsItIsWritten) {
    for (const char* text : {"regrip:1", "regrip:0", "undo", "insert:plate", "place:plate", "jaws 1", "image:0 0",
                             "image:1.5707963267948966 -0.1"}) {
        const auto input = hand_input(text);
        ASSERT_TRUE(input) << text;
        EXPECT_EQ(text_of(*input), text);
    }
    EXPECT_EQ(hand_input("regrip:1")->kind, HandInput::Kind::regrip);
    EXPECT_EQ(hand_input("regrip:1")->value, 1.0);
    EXPECT_EQ(hand_input("image:1.5 -0.25")->value, 1.5);
    EXPECT_EQ(hand_input("image:1.5 -0.25")->tilt, -0.25);
    for (const char* text :
         {"image:", "image:1", "image:1 ", "image: 1", "image:nan 0", "image:0 1e999", "image:0 0 0"})
        EXPECT_FALSE(hand_input(text)) << text;
    EXPECT_FALSE(hand_input("regrip:2"));
    EXPECT_FALSE(hand_input("regrip"));
}

// ---- plates

/// `faultless` with a plate, whose text may be changed, and a second step through its hole.
std::string with_plate(std::string_view from = "", std::string_view to = "", const std::string& axis = "plate.lag") {
    std::string plate = R"(implants:
  plate:
    parts:
      - {id: body, box: {centre: 0 0 -2.5 mm, size: 80 20 5 mm}}
      - {id: bore, tube: {from: 20 0 -6 mm, to: 20 0 1 mm, radius: 4 mm}, subtract: true}
    holes:
      lag: {from: 20 0 -10 mm, to: 20 0 60 mm, diameter: 8 mm}
    place: {axis: pedicle, up: 0 1 1}
)";
    if (!from.empty()) plate = replaced(plate, from, to);
    const std::string text = replaced(faultless, "steps:\n", plate + "steps:\n");
    return replaced(replaced(text, "axis: pedicle\n    goals", "axis: " + axis + "\n    goals"), "{depth: 32 mm} ]",
                    "{depth: 32 mm, place: plate} ]");
}

TEST(ReadProcedure, GivesThePartsHolesAndPlaceOfAnImplant) {
    text::Diagnostics diagnostics;
    const auto procedure = read(with_plate(), diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    const Implant& plate = procedure->implants.at(0);
    ASSERT_EQ(plate.solids.parts.size(), 2u);
    EXPECT_TRUE(plate.solids.parts[1].subtract);
    EXPECT_EQ(std::get<BoxSolid>(plate.solids.parts[0].solid).size.x, 80.0_mm);
    ASSERT_EQ(plate.holes.size(), 1u);
    EXPECT_EQ(plate.holes[0].id, "lag");
    EXPECT_EQ(plate.holes[0].diameter, 8.0_mm);
    EXPECT_EQ(plate.holes[0].to.z, 60.0_mm);
    ASSERT_TRUE(plate.place);
    EXPECT_EQ(plate.place->axis, "pedicle");
    EXPECT_NEAR(plate.place->up.y, std::sqrt(0.5), 1e-12);
    EXPECT_EQ(procedure->steps.at(0).axis, "plate.lag");
    EXPECT_EQ(procedure->rehearsals.at(0).path.at(1).inputs.at(0).kind, HandInput::Kind::place);
}

TEST(ReadProcedure, RefusesWhatIsWrongWithAPlate) {
    const auto refused = [](text::Code code, const std::string& text) {
        SCOPED_TRACE(text);
        const MarkedText marked(text);
        text::Diagnostics diagnostics;
        EXPECT_FALSE(read(marked.text, diagnostics));
        expect_only(code, marked, diagnostics);
    };
    refused(text::Code::unknown_plate_hole, with_plate("", "", "«plate.leg»"));
    refused(text::Code::undeclared_landmark, with_plate("", "", "«bolt.lag»"));
    refused(text::Code::undeclared_landmark, with_plate("axis: pedicle", "axis: «pedicel»"));
    refused(text::Code::out_of_range, with_plate("diameter: 8 mm", "diameter: «80 mm»"));
    refused(text::Code::degenerate, with_plate("lag: {from: 20 0 -10 mm,", "«lag»: {from: 20 0 60 mm,"));
    refused(text::Code::missing_key, replaced(with_plate("    place: {axis: pedicle, up: 0 1 1}\n", "", "pedicle"),
                                              "place: plate", "place: «plate»"));
    refused(text::Code::unknown_implant, replaced(with_plate(), "place: plate", "place: «plaque»"));
}

TEST(ReadProcedure, ListsTheHolesThatAnImplantHas) {
    text::Diagnostics diagnostics;
    read(with_plate("", "", "plate.leg"), diagnostics);
    EXPECT_NE(to_text(diagnostics)
                  .find("The axis `plate.leg` is unknown: `plate` has no hole for this screw, expected `plate.lag`."),
              std::string::npos)
        << to_text(diagnostics);
}

TEST(ReadProcedure, LimitsOfAHoleHaveTheirBoundsAndABreachItsDiameter) {
    text::Diagnostics diagnostics;
    const auto procedure = read(replaced(faultless, "      - {depth: {at_most: 38 mm}, reason: Too deep.}\n",
                                         "      - {hole_angle: {at_most: 5 deg}, reason: Askew.}\n"
                                         "      - {breach: {diameter: 6.5 mm, at_most: 2 mm}, reason: Breach.}\n"
                                         "      - {time_in_air: {at_most: 2 s}, reason: Beside.}\n"),
                                diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    const std::vector<Limit>& limits = procedure->steps.at(0).limits;
    EXPECT_EQ(limits.at(1).bound.at_most, 5.0_deg);
    EXPECT_TRUE(limits.at(1).is_of_hole());
    EXPECT_EQ(limits.at(2).diameter, 6.5_mm);
    EXPECT_EQ(limits.at(2).bound.at_most, 2.0_mm);
    EXPECT_FALSE(limits.at(3).is_of_hole()) << "it breaks while the step lasts";
    EXPECT_EQ(limits.at(3).bound.at_most, 2.0_s);
}

TEST(ReadProcedure, GivesTheFeedTheWorkingForceAndTheSleeve) {
    text::Diagnostics diagnostics;
    const auto plain = read(faultless, diagnostics);
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->steps.at(0).feed, 1.0_mm_per_s) << "the default";
    EXPECT_FALSE(plain->working_force);
    EXPECT_FALSE(plain->instruments.at(0).guide);
    std::string text = replaced(faultless, "force_scale: 1/50", "working_force: 20 N");
    text = replaced(text, "    axis: pedicle\n", "    axis: pedicle\n    feed: 0.5 mm/s\n");
    text = replaced(text, "    force: drill_cutting\n",
                    "    force: drill_cutting\n    guide: {bore: 4.2 mm, gap: 3 mm}\n");
    const auto procedure = read(text, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_EQ(procedure->steps.at(0).feed, 0.5_mm_per_s);
    EXPECT_EQ(procedure->working_force, 20.0_N);
    ASSERT_TRUE(procedure->instruments.at(0).guide);
    EXPECT_EQ(procedure->instruments.at(0).guide->bore, 4.2_mm);
    EXPECT_EQ(procedure->instruments.at(0).guide->length, 30.0_mm) << "the default";
    EXPECT_EQ(procedure->instruments.at(0).guide->gap, 3.0_mm);
}

TEST(ReadProcedure, ResolvesTheAnatomyAgainstItsOwnFolder) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure);
    EXPECT_EQ(procedure->anatomy_file, "folder/anatomy/bone.yaml");
}

TEST(ReadProcedure, KeepsItsTextWordForWord) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure);
    EXPECT_EQ(procedure->text, faultless);
}

TEST(ReadProcedure, ReadsWhatAPlanMustKeep) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> as_is = read(faultless, diagnostics);
    ASSERT_TRUE(as_is);
    EXPECT_EQ(as_is->accuracy.force, 0.07);
    EXPECT_EQ(as_is->budget.tick, 300e-6);
    std::string text = faultless;
    text.replace(text.find("accuracy: {spacing: 0.5 mm}"), 27,
                 "accuracy: {force: 3 %, volume: 0.5 %}\nbudget: {tick: 80 us}");
    const std::optional<Procedure> asking = read(text, diagnostics);
    ASSERT_TRUE(asking) << to_text(diagnostics);
    EXPECT_NEAR(asking->accuracy.force, 0.03, 1e-12);
    EXPECT_NEAR(asking->accuracy.volume, 0.005, 1e-12);
    EXPECT_NEAR(asking->budget.tick, 80e-6, 1e-15);
}
TEST(ReadProcedure, RefusesAShareOfForceWithoutItsUnit) {
    expect_refused(text::Code::missing_unit, "accuracy: {spacing: 0.5 mm}", "accuracy: {force: «7»}");
}

TEST(ReadProcedure, RefusesAnotherVersion) { expect_refused(text::Code::wrong_api_version, "kerf/v1", "«kerf/v2»"); }
TEST(ReadProcedure, RefusesAnotherKind) {
    expect_refused(text::Code::wrong_kind, "kind: Procedure", "kind: «Anatomy»");
}
TEST(ReadProcedure, RefusesAnUnknownKeyAtTheTop) {
    expect_refused(text::Code::unknown_key, "time_limit:", "«time_limits»:");
}
TEST(ReadProcedure, RefusesAnUnknownKeyDeepInside) { expect_refused(text::Code::unknown_key, "feed: 2", "«fed»: 2"); }
TEST(ReadProcedure, RefusesAMissingKey) {
    expect_refused(text::Code::missing_key, "metadata: {id: hole, ", "«metadata»: {");
}
TEST(ReadProcedure, RefusesAMissingReason) {
    expect_refused(text::Code::missing_key, "{depth: {at_most: 38 mm}, reason: Too deep.}",
                   "«{»depth: {at_most: 38 mm}}");
}
TEST(ReadProcedure, RefusesAMapWhereAListIsNeeded) {
    expect_refused(text::Code::wrong_shape, "[A. Author]", "«{»a: b}");
}
TEST(ReadProcedure, RefusesAListWhereAMapIsNeeded) {
    expect_refused(text::Code::wrong_shape, "accuracy: {spacing: 0.5 mm}", "accuracy: «[»0.5 mm]");
}
TEST(ReadProcedure, RefusesAnEmptyValue) {
    expect_refused(text::Code::empty_value, "time_limit: 60 s", "«time_limit»:");
}
TEST(ReadProcedure, RefusesAnEmptyList) { expect_refused(text::Code::empty_value, "[A. Author]", "«[»]"); }
TEST(ReadProcedure, RefusesAnUnknownStatus) {
    expect_refused(text::Code::unknown_word, "status: draft", "status: «darft»");
}
TEST(ReadProcedure, RefusesAnUnknownExpectation) {
    expect_refused(text::Code::unknown_word, "expect: pass", "expect: «passes»");
}
TEST(ReadProcedure, RefusesAnUnknownCoupling) {
    expect_refused(text::Code::unknown_word, "{device: touch, ", "{device: touch, coupling: «dierct», ");
}
TEST(ReadProcedure, RefusesTwoRehearsalsOfOneName) {
    expect_refused(text::Code::duplicate_id, "id: breach", "id: «expert»");
}
TEST(ReadProcedure, RefusesANeedNamedTwice) {
    expect_refused(text::Code::duplicate_id, "[cortical]", "[cortical, «cortical»]");
}
TEST(ReadProcedure, RefusesAnIdOfTwoWords) { expect_refused(text::Code::malformed_word, "id: hole", "id: «a hole»"); }
TEST(ReadProcedure, RefusesAVersionOfTwoNumbers) {
    expect_refused(text::Code::malformed_word, "version: 0.1.0", "version: «0.1»");
}

TEST(ReadProcedure, RefusesAnAnatomyOutsideItsFolder) {
    for (const char* path :
         {"«../bone.yaml»", "«/etc/bone.yaml»", "«a/../../bone.yaml»", "«a\\bone.yaml»", "«C:bone.yaml»"})
        expect_refused(text::Code::path_outside, "anatomy/bone.yaml", path);
}

TEST(ReadProcedure, RefusesAGoalWithTwoQuantities) {
    expect_refused(text::Code::one_of, "{entry: {}}", "{entry: {}, «depth»: {at_least: 1 mm}}");
}
TEST(ReadProcedure, RefusesALimitWithoutQuantity) {
    expect_refused(text::Code::one_of, "{depth: {at_most: 38 mm}, reason", "«{»reason");
}

TEST(ReadProcedure, RefusesAnUnknownPlugin) {
    expect_refused(text::Code::unknown_plugin, "kerf.drilling", "«kerf.driling»");
}
TEST(ReadProcedure, RefusesAnUnknownTool) {
    expect_refused(text::Code::unknown_tool, "twist_drill", "«twisted_drill»");
}
TEST(ReadProcedure, RefusesAnUnknownForce) {
    expect_refused(text::Code::unknown_force, "force: drill_cutting", "force: «drill_cuting»");
}
TEST(ReadProcedure, RefusesAToolAsAForce) {
    expect_refused(text::Code::unknown_force, "force: drill_cutting", "force: «twist_drill»");
}
TEST(ReadProcedure, RefusesAnUnknownParameter) {
    expect_refused(text::Code::unknown_parameter, "diameter:", "«diametre»:");
}
TEST(ReadProcedure, RefusesAnUnknownDrive) {
    expect_refused(text::Code::unknown_drive, "spindle_speed", "«spindle_sped»");
}
TEST(ReadProcedure, RefusesAnAxisThatIsNotDeclared) {
    expect_refused(text::Code::undeclared_landmark, "axis: pedicle", "axis: «pedicel»");
}
TEST(ReadProcedure, RefusesARehearsalOfALimitThatNoStepHas) {
    expect_refused(text::Code::unknown_limit, "{fail: canal}", "{fail: «nerve»}");
}

TEST(ReadProcedure, ReadsTheStepInWhichALimitBreaks) {
    text::Diagnostics diagnostics;
    const auto named = read(replaced(faultless, "{fail: canal}", "{fail: canal, step: drill}"), diagnostics);
    ASSERT_TRUE(named) << to_text(diagnostics);
    EXPECT_EQ(named->rehearsals.at(1).expect_step, "drill");
    const auto incomplete = read(replaced(faultless, "{fail: canal}", "incomplete"), diagnostics);
    ASSERT_TRUE(incomplete) << to_text(diagnostics);
    EXPECT_EQ(incomplete->rehearsals.at(1).expect, "incomplete");
    expect_refused(text::Code::unknown_step, "{fail: canal}", "{fail: canal, step: «dril»}");
}

// ---- goals and limits on what each tick shows

/// The step's limits in `faultless`, with one more.
std::string with_limit(const std::string& limit) {
    return replaced(
        faultless, "      - {depth: {at_most: 38 mm}, reason: Too deep.}\n",
        "      - {depth: {at_most: 38 mm}, reason: Too deep.}\n      - {" + limit + ", reason: Because.}\n");
}
void expect_limit_refused(text::Code code, const std::string& limit) {
    SCOPED_TRACE(limit);
    const MarkedText marked(with_limit(limit));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadProcedure, GivesLimitsOnLoadsInSi) {
    struct Case {
        const char *limit, *quantity;
        double at_most;
    };
    for (const auto& [limit, quantity, at_most] : {Case{"torque: {at_most: 3 N m}", "torque", 3.0},
                                                   {"torque: {at_most: 3000 N*mm}", "torque", 3.0},
                                                   {"lateral_force: {at_most: 20 N}", "lateral_force", 20.0},
                                                   {"speed: {at_most: 5 mm/s}", "speed", 5.0_mm_per_s},
                                                   {"removed_volume: {at_most: 500 mm3}", "removed_volume", 5e-7},
                                                   {"duration: {at_most: 1 min}", "duration", 60.0_s}}) {
        text::Diagnostics diagnostics;
        const auto procedure = read(with_limit(limit), diagnostics);
        ASSERT_TRUE(procedure) << to_text(diagnostics);
        const Limit& read_limit = procedure->steps.at(0).limits.at(2);
        EXPECT_EQ(read_limit.quantity, quantity);
        EXPECT_EQ(read_limit.name(), quantity);
        EXPECT_NEAR(read_limit.bound.at_most.value(), at_most, 1e-12 * at_most /* rounding of the unit */);
    }
}

TEST(ReadProcedure, RefusesLimitsOnLoadsInAnotherUnit) {
    expect_limit_refused(text::Code::wrong_dimension, "torque: {at_most: «3 N»}");
    expect_limit_refused(text::Code::wrong_dimension, "lateral_force: {at_most: «3 N m»}");
    expect_limit_refused(text::Code::wrong_dimension, "speed: {at_most: «5 mm»}");
    expect_limit_refused(text::Code::wrong_dimension, "removed_volume: {at_most: «500 mm»}");
    expect_limit_refused(text::Code::missing_unit, "duration: {at_most: «60»}");
    expect_limit_refused(text::Code::out_of_range, "duration: {at_most: «5000 s»}");
}

TEST(ReadProcedure, RefusesAtLeastWhereALimitKnowsOnlyAtMost) {
    for (const char* limit :
         {"torque: {at_most: 3 N m, «at_least»: 1 N m}", "lateral_force: {at_most: 3 N, «at_least»: 1 N}",
          "speed: {at_most: 5 mm/s, «at_least»: 1 mm/s}", "removed_volume: {at_most: 5 mm3, «at_least»: 1 mm3}",
          "duration: {at_most: 60 s, «at_least»: 1 s}"})
        expect_limit_refused(text::Code::unknown_key, limit);
    for (const char* limit :
         {"«torque»: {}", "«lateral_force»: {}", "«speed»: {}", "«removed_volume»: {}", "«duration»: {}"})
        expect_limit_refused(text::Code::missing_key, limit);
}

TEST(ReadProcedure, ReadsAGoalOnRemovedBone) {
    text::Diagnostics diagnostics;
    const auto procedure = read(
        replaced(faultless, "{entry: {}},", "{removed_volume: {at_least: 100 mm3, at_most: 200 mm3}},"), diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_NEAR(procedure->steps.at(0).goals.at(0).bound.at_least.value(), 1e-7, 1e-19 /* rounding */);
    EXPECT_TRUE(procedure->steps.at(0).cuts());
    expect_refused(text::Code::missing_key, "{entry: {}},", "{«removed_volume»: {at_most: 200 mm3}},");
    expect_refused(text::Code::empty_bound, "{entry: {}},",
                   "{«removed_volume»: {at_least: 300 mm3, at_most: 200 mm3}},");
}

TEST(ReadProcedure, RefusesAGoalThatHoldsBeforeItBegins) {
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}", "{depth: {at_most: «25 mm»}}");
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}", "{depth: {at_least: «-3 mm»}}");
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}", "{depth: {at_least: «0 mm»}}");
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}",
                   "{signal: {id: drive_power, at_least: «0 W»}}");
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}",
                   "{signal: {id: drive_power, at_most: «25 W»}}");
}

TEST(ReadProcedure, ReadsWhatTheScoreCounts) {
    text::Diagnostics diagnostics;
    const auto procedure = read(replaced(faultless, "rehearsals:\n",
                                         "scoring:\n"
                                         "  - {metric: drill.entry-offset, full: 0.5 mm, none: 3 mm, weight: 2}\n"
                                         "  - {metric: drill.depth, target: 32 mm, full: 1 mm, none: 4 mm}\n"
                                         "rehearsals:\n"),
                                diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    ASSERT_EQ(procedure->scoring.size(), 2u);
    const ScoredMetric &offset = procedure->scoring[0], &depth = procedure->scoring[1];
    EXPECT_EQ(offset.step, "drill");
    EXPECT_EQ(offset.unit, "mm");
    EXPECT_EQ(offset.full, 0.5_mm);
    EXPECT_EQ(offset.none, 3.0_mm);
    EXPECT_EQ(offset.weight, 2.0);
    EXPECT_FALSE(offset.target);
    EXPECT_EQ(depth.target, 32.0_mm);
    EXPECT_EQ(depth.weight, 1.0);
    EXPECT_EQ(procedure->steps[0].limits[0].severity, Severity::serious);
}

TEST(ReadProcedure, ScoresABreachByItsDiameterAndTheMinimumOfASignal) {
    const auto scored = [](const std::string& metric) {
        text::Diagnostics diagnostics;
        std::string text = replaced(faultless, "    limits:\n",
                                    "    limits:\n"
                                    "      - {breach: {diameter: 5 mm, at_most: 2 mm}, reason: Out.}\n"
                                    "      - {breach: {diameter: 6.5 mm, at_most: 2 mm}, reason: Out.}\n"
                                    "      - {signal: {id: spindle_speed, at_least: 600 rpm}, reason: Slow.}\n");
        text = replaced(text, "rehearsals:\n", "scoring: [{metric: " + metric + "}]\nrehearsals:\n");
        const bool is_read = read(text, diagnostics).has_value();
        return is_read ? std::string("read") : to_text(diagnostics);
    };
    EXPECT_EQ(scored("drill.breach-5mm, full: 0 mm, none: 2 mm"), "read");
    EXPECT_EQ(scored("drill.breach-6.5mm, full: 0 mm, none: 2 mm"), "read");
    EXPECT_NE(scored("drill.breach, full: 0 mm, none: 2 mm"), "read") << "of which diameter?";
    EXPECT_EQ(scored("drill.signal.spindle_speed.least, full: 900 rpm, none: 600 rpm"), "read");
    EXPECT_NE(scored("drill.signal.spindle_speed, full: 900 rpm, none: 600 rpm"), "read") << "no bound reads it";
}

TEST(ReadProcedure, RefusesAScoreThatNobodyCanEarn) {
    const auto refused = [](text::Code code, const std::string& scoring) {
        expect_refused(code, "rehearsals:\n", "scoring: " + scoring + "\nrehearsals:\n");
    };
    refused(text::Code::unknown_metric, "[{metric: «drill.offest», full: 1 mm, none: 2 mm}]");
    refused(text::Code::unknown_metric, "[{metric: «drill.thrust», full: 1 N, none: 2 N}]");  // without a limit on it
    refused(text::Code::contradiction, "[{metric: drill.offset, full: 2 mm, none: «2 mm»}]");
    refused(text::Code::contradiction, "[{metric: drill.depth, target: 30 mm, full: 2 mm, none: «1 mm»}]");
    refused(text::Code::wrong_dimension, "[{metric: drill.offset, full: «2 deg», none: 2 mm}]");
    refused(text::Code::missing_key, "[«{»metric: drill.offset, full: 2 mm}]");
    refused(text::Code::duplicate_id,
            "[{metric: drill.offset, full: 1 mm, none: 2 mm}, {metric: «drill.offset», full: 1 mm, none: 3 mm}]");
    refused(text::Code::out_of_range, "[{metric: drill.offset, full: 1 mm, none: 2 mm, weight: «-1»}]");
}

TEST(ReadProcedure, RefusesWeightsThatAddUpToNothing) {
    expect_refused(text::Code::contradiction, "rehearsals:\n",
                   "«scoring»: [{metric: drill.offset, full: 1 mm, none: 2 mm, weight: 0}]\nrehearsals:\n");
}

TEST(ReadProcedure, FindsTheSignalOfTheStepsLaw) {
    text::Diagnostics diagnostics;
    const auto procedure = read(replaced(with_limit("signal: {id: drive_power, at_most: 30 W}"), "{entry: {}},",
                                         "{signal: {id: spindle_speed, at_least: 600 rpm}}, {signal: {id: engagement, "
                                         "at_least: 0.1, at_most: 0.5}},"),
                                diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    const Step& step = procedure->steps.at(0);
    EXPECT_EQ(step.goals.at(0).name(), "spindle_speed");
    EXPECT_EQ(step.goals.at(0).signal.index, 0u);
    EXPECT_EQ(step.goals.at(0).bound.at_least, 10.0) << "revolutions a second";
    EXPECT_EQ(step.goals.at(1).signal.index, 2u);
    EXPECT_EQ(step.goals.at(1).bound.at_most, 0.5);
    const Limit& limit = step.limits.at(2);
    EXPECT_EQ(limit.name(), "drive_power");
    EXPECT_EQ(limit.signal.index, 1u);
    EXPECT_EQ(limit.signal.unit, "W");
    EXPECT_EQ(limit.bound.at_most, 30.0);
}

TEST(ReadProcedure, RefusesWhatASignalIsNot) {
    expect_limit_refused(text::Code::unknown_signal, "signal: {id: «drive_pwoer», at_most: 30 W}");
    expect_limit_refused(text::Code::wrong_dimension, "signal: {id: drive_power, at_most: «30 N»}");
    expect_limit_refused(text::Code::missing_unit, "signal: {id: drive_power, at_most: «30»}");
    expect_limit_refused(text::Code::wrong_dimension, "signal: {id: engagement, at_most: «1 mm»}");
    expect_limit_refused(text::Code::empty_bound, "«signal»: {id: drive_power}");
    expect_limit_refused(text::Code::empty_bound, "«signal»: {id: drive_power, at_least: 2 W, at_most: 1 W}");
    expect_limit_refused(text::Code::missing_key, "«signal»: {at_most: 30 W}");
    expect_limit_refused(text::Code::malformed_word, "signal: {id: «drive power», at_most: 30 W}");
}

TEST(ReadProcedure, ListsTheSignalsThatThereAre) {
    text::Diagnostics diagnostics;
    read(with_limit("signal: {id: warmth, at_most: 30 W}"), diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].message,
              "The signal `warmth` is unknown: expected `spindle_speed`, `drive_power` or `engagement` of "
              "drill_cutting. Write one of these.");
    diagnostics.clear();
    read(with_limit("signal: {id: drive_pwoer, at_most: 30 W}"), diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].write, "drive_power");
}

TEST(ReadProcedure, OfAnUnknownLawNoSignalIsRefused) {
    const MarkedText marked(
        replaced(with_limit("signal: {id: warmth, at_most: 30 W}"), "force: drill_cutting", "force: «drill_cuting»"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_force, marked, diagnostics);
}

TEST(ReadProcedure, ARehearsalNamesASignalByItsId) {
    text::Diagnostics diagnostics;
    const std::string text = with_limit("signal: {id: drive_power, at_most: 30 W}");
    const auto procedure = read(replaced(text, "{fail: canal}", "{fail: drive_power, step: drill}"), diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_EQ(procedure->rehearsals.at(1).expect_limit, "drive_power");
    EXPECT_FALSE(read(replaced(text, "{fail: canal}", "{fail: signal}"), diagnostics));
    EXPECT_EQ(diagnostics.at(0).code, "E0309");
    // A signal that is refused already is no unknown limit besides
    const MarkedText marked(
        replaced(with_limit("signal: {id: «drive_pwoer», at_most: 30 W}"), "{fail: canal}", "{fail: drive_pwoer}"));
    diagnostics.clear();
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_signal, marked, diagnostics);
}

TEST(ReadProcedure, AGoalOnASignalMustNotBreakALimitOnIt) {
    const std::string limited = with_limit("signal: {id: drive_power, at_most: 30 W}");
    const MarkedText marked(replaced(limited, "{entry: {}},", "{signal: {id: drive_power, at_least: «31 W»}},"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::contradiction, marked, diagnostics);
    diagnostics.clear();
    EXPECT_TRUE(read(replaced(limited, "{entry: {}},", "{signal: {id: engagement, at_least: 31}},"), diagnostics))
        << "another signal: " << to_text(diagnostics);
}

TEST(ReadProcedure, ReportsALimitOnAnUnknownQuantityOnce) {
    expect_refused(text::Code::unknown_key, "{depth: {at_most: 38 mm}, reason: Too deep.}",
                   "{«warmth»: {at_most: 38 mm}, reason: Too deep.}");
    // The rehearsal that expects it says nothing new
    const MarkedText marked(replaced(replaced(faultless, "{depth: {at_most: 38 mm}, reason: Too deep.}",
                                              "{«warmth»: {at_most: 38 mm}, reason: Too deep.}"),
                                     "{fail: canal}", "{fail: warmth}"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_key, marked, diagnostics);
}

TEST(ReadProcedure, NeverListsARefusedLimit) {
    text::Diagnostics diagnostics;
    read(replaced(replaced(faultless, "zone: canal", "zone: aorta"), "{fail: canal}", "{fail: nerve}"), diagnostics);
    ASSERT_EQ(diagnostics.size(), 2u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0307");
    EXPECT_EQ(diagnostics[1].code, "E0309");
    EXPECT_EQ(diagnostics[1].message.find("aorta"), std::string::npos) << diagnostics[1].message;
    EXPECT_EQ(diagnostics[1].message.find("``"), std::string::npos) << diagnostics[1].message;
    diagnostics.clear();
    read(replaced(replaced(faultless, "zone: canal", "zone: aorta"), "{fail: canal}", "{fail: aorta}"), diagnostics);
    EXPECT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
}

TEST(ReadProcedure, ReportsAMisspeltKeyOnce) {
    for (const auto& [from, to] : {std::pair{"instruments:", "«instrumens»:"},
                                   {"needs:", "«need»:"},
                                   {"steps:", "«step»:"},
                                   {"    title: Drill", "    «titel»: Drill"},
                                   {"    path: [ {depth: -5 mm}, ", "    «pats»: [ {depth: -5 mm}, "},
                                   {"{zone: canal", "{«zoen»: canal"},
                                   {"{entry: {}}", "{«entyr»: {}}"}})
        expect_refused(text::Code::unknown_key, from, to);
}

TEST(ReadProcedure, MissingNeedsAreOneError) {
    text::Diagnostics diagnostics;
    read(replaced(faultless, "needs: {landmarks: [pedicle, midline], zones: [canal], tissues: [cortical]}\n", ""),
         diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0204");
}

TEST(ReadProcedure, NamesALookAlikeInAName) {
    text::Diagnostics diagnostics;
    read(replaced(faultless, "id: hole", "id: pilot\u2011hole"), diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_NE(diagnostics[0].message.find("U+2011 (no-break hyphen)"), std::string::npos) << diagnostics[0].message;
    EXPECT_EQ(diagnostics[0].write, "pilot-hole");
}

TEST(ReadProcedure, RefusesAZoneThatIsNotDeclared) {
    const MarkedText marked(replaced(replaced(faultless, "[canal]", "[canals]"), "zone: canal", "zone: «canal»"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::undeclared_zone, marked, diagnostics);
    EXPECT_EQ(diagnostics[0].write, "canals");
}

TEST(ReadProcedure, RefusesAnUnknownInstrumentOnce) {
    const MarkedText marked(replaced(faultless, "instrument: pilot", "instrument: «pilto»"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_instrument, marked, diagnostics);
    EXPECT_EQ(diagnostics[0].write, "pilot");
}

TEST(ReadProcedure, AnUnusedInstrumentIsOnlyAWarning) {
    text::Diagnostics diagnostics;
    const auto procedure = read(replaced(faultless, "steps:", R"(  spare:
    plugin: kerf.drilling
    tool: twist_drill
    force: drill_cutting
steps:)"),
                                diagnostics);
    EXPECT_TRUE(procedure) << to_text(diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "W0310");
    EXPECT_EQ(diagnostics[0].place.line, 16);
}

TEST(ReadProcedure, RefusesWordsForNumbers) { expect_refused(text::Code::not_a_number, "push: 50 N", "push: «hard»"); }
TEST(ReadProcedure, RefusesALengthWithoutUnit) {
    expect_refused(text::Code::missing_unit, "diameter: 4 mm", "diameter: «4»");
}
TEST(ReadProcedure, RefusesAnUnknownUnit) {
    expect_refused(text::Code::unknown_unit, "diameter: 4 mm", "diameter: «4 inch»");
}
TEST(ReadProcedure, RefusesAForceForASpeed) {
    expect_refused(text::Code::wrong_dimension, "feed: 2 mm/s", "feed: «2 N»");
}
TEST(ReadProcedure, RefusesABoundWithoutEnd) {
    expect_limit_refused(text::Code::empty_bound, "«depth»: {}");
    expect_refused(text::Code::missing_key, "{depth: {at_least: 30 mm}}", "{«depth»: {}}");
}
TEST(ReadProcedure, RefusesABoundThatNothingFulfils) {
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}",
                   "{«depth»: {at_least: 30 mm, at_most: 20 mm}}");
}

TEST(ReadProcedure, RefusesAGoalToBeOutsideWhichADeepestDepthNeverIs) {
    expect_refused(text::Code::empty_bound, "{depth: {at_least: 30 mm}}", "{depth: {at_most: «-5 mm»}}");
}

TEST(ReadProcedure, RefusesAGoalThatALimitOfItsStepForbids) {
    expect_refused(text::Code::contradiction, "{depth: {at_least: 30 mm}}", "{depth: {at_least: «38.1 mm»}}");
    expect_refused(text::Code::contradiction, "{depth: {at_least: 30 mm}} ]\n    limits:\n",
                   "{depth: {at_least: 1 mm, at_most: «5 mm»}} ]\n    limits:\n      - {depth: {at_least: 6 mm}, "
                   "reason: Too shallow.}\n");
    text::Diagnostics diagnostics;
    EXPECT_TRUE(read(replaced(faultless, "{depth: {at_least: 30 mm}}", "{depth: {at_least: 38 mm}}"), diagnostics))
        << "it can be reached and kept";
}

TEST(ReadProcedure, RefusesAGoalThatIsLessDeepThanAnEarlierOne) {
    expect_refused(text::Code::contradiction, "{depth: {at_least: 30 mm}} ]",
                   "{depth: {at_least: 30 mm}}, {depth: {at_least: 1 mm, at_most: «29 mm»}} ]");
    text::Diagnostics diagnostics;
    EXPECT_TRUE(read(replaced(faultless, "{depth: {at_least: 30 mm}} ]",
                              "{depth: {at_least: 1 mm, at_most: 29 mm}}, {depth: {at_least: 30 mm}} ]"),
                     diagnostics))
        << "first little, then more";
    EXPECT_TRUE(read(replaced(faultless, "{depth: {at_least: 30 mm}} ]",
                              "{depth: {at_least: 30 mm}}, {depth: {at_least: 1 mm, at_most: 30 mm}} ]"),
                     diagnostics))
        << "it can be as deep";
}

TEST(ReadProcedure, RefusesLimitsThatNothingKeepsTogether) {
    expect_refused(text::Code::contradiction, "      - {depth: {at_most: 38 mm}, reason: Too deep.}\n",
                   "      - {clearance: {zone: canal, at_most: 2 mm}, reason: Far.}\n      - {depth: {at_most: 38 mm}, "
                   "reason: Too deep.}\n"
                   "      - {depth: {at_least: «38.1 mm»}, reason: Too shallow.}\n");
}

TEST(ReadProcedure, RefusesAParameterOutOfRangeAndSaysWhatToWrite) {
    expect_refused(text::Code::out_of_range, "diameter: 4 mm", "diameter: «65 mm»");
    text::Diagnostics diagnostics;
    read(replaced(faultless, "diameter: 4 mm", "diameter: 65 mm"), diagnostics);
    EXPECT_EQ(
        to_text(diagnostics),
        "E0412 folder/hole.yaml:14:28: pilot.diameter is out of range: got 65 mm, expected 0.5 mm … 20 mm. Did the "
        "decimal point slip? Write `6.5 mm`.\n"
        "        parameters: {diameter: 65 mm, wear: 0.5}\n"
        "                               ^^^^^\n"
        "  because of kerf.drilling/twist_drill: diameter is declared from 0.5 mm to 20 mm, default 3.2 mm.\n");
}

TEST(ReadProcedure, ReportsAllErrorsInOneGo) {
    std::string text = faultless;
    text = replaced(text, "status: draft", "status: finished");
    text = replaced(text, "diameter: 4 mm", "diameter: 4");
    text = replaced(text, "spindle_speed", "spindel_speed");
    text = replaced(text, "reason: Too deep.", "reasons: Too deep.");
    text = replaced(text, "feed: 2 mm/s", "feed: 2 m");
    text = replaced(text, "time_limit: 60 s", "time_limit: 60 s\ntime_limit: 61 s");
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(text, diagnostics));

    std::vector<std::string> codes;
    for (const text::Diagnostic& d : diagnostics) codes.push_back(d.code);
    EXPECT_EQ(codes, (std::vector<std::string>{"E0108", "E0203", "E0207", "E0402", "E0305", "E0404"}))
        << to_text(diagnostics);
}

TEST(ReadProcedure, WithoutAnyPluginSaysSo) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_procedure_text("hole.yaml", faultless, {}).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::unknown_plugin));
}

TEST(ReadProcedure, AMissingFileIsOneError) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read_procedure("no/such/file.yaml", drilling_catalog()).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, text::code_text(text::Code::file_unreadable));
}

// ---- what the procedure needs of the anatomy

struct Needs : ::testing::Test {
    void SetUp() override {
        anatomy.axes = {{"pedicle", {}, {0, 0, 1}, 0.0}};
        anatomy.points = {{"midline", {}, 0.0}};
        anatomy.zones = {{"canal", {}}};
        anatomy.tissues = {{"cortical", 1850.0, 0.0, ""}};
    }

    /// Expects one complaint at the mark that `to` carries; `to` without its marks must be what `faultless` says.
    void expect_missing(text::Code code, std::string_view from, std::string_view to) {
        const MarkedText marked(replaced(faultless, from, to));
        text::Diagnostics diagnostics;
        const std::optional<Procedure> procedure = read(marked.text, diagnostics);
        ASSERT_TRUE(procedure) << to_text(diagnostics);
        check_needs(*procedure, anatomy, diagnostics);
        expect_only(code, marked, diagnostics);
    }

    Anatomy anatomy;
};

TEST_F(Needs, AreMetByAnAnatomyThatHasThemAll) {
    text::Diagnostics diagnostics;
    const std::optional<Procedure> procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure);
    check_needs(*procedure, anatomy, diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

TEST_F(Needs, AMissingLandmarkIsReported) {
    anatomy.axes[0].id = "pedicles";
    expect_missing(text::Code::missing_landmark, "[pedicle,", "[«pedicle»,");
}

TEST_F(Needs, AMissingZoneIsReported) {
    anatomy.zones.clear();
    expect_missing(text::Code::missing_zone, "[canal]", "[«canal»]");
}

TEST_F(Needs, AMissingTissueIsReported) {
    anatomy.tissues[0].id = "enamel";
    expect_missing(text::Code::missing_tissue, "[cortical]", "[«cortical»]");
}

TEST_F(Needs, APointIsNoAxis) {
    anatomy.axes.clear();
    anatomy.points.push_back({"pedicle", {}, 0.0});
    expect_missing(text::Code::axis_is_a_point, "axis: pedicle", "axis: «pedicle»");
}

TEST_F(Needs, AShiftTowardsTheMidlineNeedsTheMidlineAsAPoint) {
    anatomy.points.clear();
    anatomy.axes.push_back({"midline", {}, {0, 0, 1}, 0.0});
    expect_missing(text::Code::missing_midline, "[ {depth: -5 mm, medial", "[ «{»depth: -5 mm, medial");
}

}  // namespace
}  // namespace kerf::documents
