// SPDX-License-Identifier: Apache-2.0
#include "documents/patch.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "documents/read_procedure.h"
#include "documents/yaml/document.h"
#include "kerf/units.hpp"
#include "tests/documents/catalog.h"
#include "tests/documents/every_key.h"
#include "tests/documents/marked_text.h"
#include "tests/support/temporary_folder.h"
#include "text/codes.h"
#include "text/printable_lines.h"

namespace kerf::documents {
namespace {

using namespace literals;

// A procedure with two steps. Each test gives it a variant.
const std::string base = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft}
needs: {landmarks: [pedicle], zones: [canal]}
anatomy: bone.yaml
haptics: {device: touch}
instruments:
  drill: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting, parameters: {diameter: 4 mm}}
steps:
  - {id: enter, title: Enter, instrument: drill, axis: pedicle, goals: [{entry: {}}]}
  - id: deepen
    title: Deepen
    instrument: drill
    axis: pedicle
    goals: [{depth: {at_least: 30 mm}}]
    limits: [{depth: {at_most: 38 mm}, reason: Too deep.}]
)";

std::string with_patch(const std::string& patch) {
    return base + "variants:\n  other:\n    patch:\n      " + patch + "\n";
}

std::optional<Procedure> read(const std::string& text, text::Diagnostics& found,
                              const ProcedureChanges& changes = {"other", {}}) {
    return read_procedure_text("hole.yaml", text, drilling_catalog(), changes).take(found);
}

Procedure patched(const std::string& patch) {
    text::Diagnostics found;
    const auto procedure = read(with_patch(patch), found);
    EXPECT_TRUE(procedure && found.empty()) << to_text(found);
    return procedure.value_or(Procedure{});
}

TEST(Patch, SetsAValueByItsPath) {
    EXPECT_EQ(patched("instruments.drill.parameters.diameter: 5 mm").instruments.at(0).tool_parameters.at(0), 5.0_mm);
}
TEST(Patch, MergesMapsKeyByKey) {
    const Procedure p = patched("instruments: {drill: {parameters: {point_angle: 90 deg}}}");
    EXPECT_EQ(p.instruments.at(0).tool_parameters, (std::vector<double>{4.0_mm, 90.0_deg}));
}
TEST(Patch, FindsItemsByTheirIds) {
    const Procedure p = patched("steps.deepen.title: Go on");
    EXPECT_EQ(p.steps.at(1).title, "Go on");
    EXPECT_EQ(p.steps.at(0).title, "Enter");
}
TEST(Patch, MergesListsWithIdsItemByItemAndAddsNewItems) {
    const Procedure p = patched("steps: [{id: enter, title: Begin}, {id: more, title: More, instrument: drill, axis: "
                                "pedicle, goals: [{entry: {}}]}]");
    ASSERT_EQ(p.steps.size(), 3u);
    EXPECT_EQ(p.steps[0].title, "Begin");
    EXPECT_EQ(p.steps[0].goals.size(), 1u);
    EXPECT_EQ(p.steps[2].id, "more");
}
TEST(Patch, ReplacesOtherListsAsAWhole) {
    const Procedure p = patched("steps.deepen.goals: [{depth: {at_least: 20 mm}}]");
    ASSERT_EQ(p.steps.at(1).goals.size(), 1u);
    EXPECT_EQ(p.steps.at(1).goals[0].bound.at_least, 20.0_mm);
}
TEST(Patch, RemovesWithATilde) {
    const Procedure p = patched("{steps.deepen.limits: ~, steps.enter: ~}");
    ASSERT_EQ(p.steps.size(), 1u);
    EXPECT_EQ(p.steps[0].id, "deepen");
    for (const Limit& limit : p.steps[0].limits) EXPECT_EQ(limit.quantity, "damage") << "that of the tool remains";
}
TEST(Patch, AddsWhatIsNotThereAndTheMapsOnTheWay) {
    EXPECT_EQ(patched("accuracy.spacing: 0.5 mm").spacing, 0.5_mm);
    EXPECT_EQ(patched("time_limit: 30 s").time_limit, 30.0_s);
}
TEST(Patch, KnowsNamesWithDots) {
    std::string text = with_patch("instruments.a.b.parameters.diameter: 5 mm");
    for (const char* from : {"  drill: {plugin", "instrument: drill,", "instrument: drill\n"}) {
        std::string to = from;
        to.replace(to.find("drill"), 5, "a.b");
        text = replaced(text, from, to);
    }
    text::Diagnostics found;
    const auto procedure = read(text, found);
    ASSERT_TRUE(procedure) << to_text(found);
    EXPECT_EQ(procedure->instruments.at(0).tool_parameters.at(0), 5.0_mm);
}

TEST(Patch, LeavesTheProcedureAsItIsUnlessItIsChosen) {
    text::Diagnostics found;
    const std::string text = with_patch("time_limit: 30 s");
    const auto procedure = read(text, found, {});
    ASSERT_TRUE(procedure) << to_text(found);
    EXPECT_EQ(procedure->time_limit, 120.0_s);
    EXPECT_EQ(procedure->text, text);
    EXPECT_EQ(procedure->variant, "");
    ASSERT_EQ(procedure->variants.size(), 1u);
    EXPECT_EQ(procedure->variants[0].id, "other");
}

void expect_refused(text::Code code, const std::string& patch) {
    SCOPED_TRACE(patch);
    const MarkedText marked(with_patch(patch));
    text::Diagnostics found;
    EXPECT_FALSE(read(marked.text, found));
    expect_only(code, marked, found);
}

TEST(Patch, RefusesAPathThatLeadsNowhere) {
    expect_refused(text::Code::patch_nowhere, "«steps.deepn.title»: Go on");
    expect_refused(text::Code::patch_nowhere, "«metadata.title.text»: A hole");
    expect_refused(text::Code::patch_nowhere, "«steps.deepen.goals.depth»: {at_least: 20 mm}");
}
TEST(Patch, RefusesAPathThroughAnUnknownName) {
    expect_refused(text::Code::patch_nowhere, "«instruments.dril.drives.spindle_speed»: 900 rpm");
    expect_refused(text::Code::patch_nowhere, "instruments: {«pilot»: {parameters: {diameter: 5 mm}}}");
    expect_refused(text::Code::patch_nowhere, "steps: [{id: «deepn», title: Go on}]");
    text::Diagnostics found;
    EXPECT_FALSE(read(with_patch("instruments.pilot.drives.spindle_speed: 900 rpm"), found));
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found[0].write, "instruments.drill.drives.spindle_speed:") << "the only name that there is";
}
TEST(Patch, AddsAWholeInstrument) {
    text::Diagnostics found;
    const auto p =
        read(with_patch("{instruments.thin: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting}, "
                        "steps.enter.instrument: thin}"),
             found);
    ASSERT_TRUE(p) << to_text(found);
    EXPECT_EQ(p->instruments.size(), 2u);
}
TEST(Patch, RefusesToRemoveWhatIsNotThere) { expect_refused(text::Code::nothing_to_remove, "«steps.deepen.limit»: ~"); }
TEST(Patch, RefusesAPathWithoutEnd) {
    std::string path = "a";
    for (int i = 0; i < 400; ++i) path += ".a";
    expect_refused(text::Code::nested_too_deep, "«" + path + "»: 1");
}

TEST(Patch, RefusesMoreThanAPersonWouldWrite) {
    std::string variants = "variants:\n";
    for (int i = 0; i < 33; ++i)
        variants +=
            (i == 32 ? "  «v" : "  v") + std::to_string(i) + (i == 32 ? "»" : "") + ": {patch: {time_limit: 3 s}}\n";
    const MarkedText many(base + variants);
    text::Diagnostics found;
    EXPECT_FALSE(read(many.text, found, {}));
    expect_only(text::Code::out_of_range, many, found);

    std::string keys;
    for (int i = 0; i < 50'000; ++i) keys += (i > 0 ? ", k" : "k") + std::to_string(i) + ": 1";
    found.clear();
    EXPECT_FALSE(read(with_patch("{" + keys + "}"), found));
    EXPECT_EQ(found.at(0).code, "E0412");
}

TEST(Patch, AMistakeInItIsShownWhereItStandsTogetherWithWhatItReplaces) {
    text::Diagnostics found;
    EXPECT_FALSE(read(with_patch("instruments.drill.parameters: {diameter: 5}"), found));
    EXPECT_EQ(
        to_text(found),
        "E0402 hole.yaml:20:48: drill.diameter has no unit: got `5`, expected a length in mm. Write `5 mm`.\n"
        "          instruments.drill.parameters: {diameter: 5}\n"
        "                                                   ^\n"
        "  because of hole.yaml:8:98: it replaces this.\n"
        "      drill: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting, parameters: {diameter: 4 mm}}\n"
        "                                                                                                     ^^^^\n");
}
TEST(Patch, AnUnknownKeyInItIsShownWhereItStands) {
    expect_refused(text::Code::unknown_key, "«acuracy».spacing: 0.5 mm");
}

// ---- a value set twice

TEST(Patch, RefusesAValueSetTwice) {
    const auto refused = [](const char* patch) { expect_refused(text::Code::patched_twice, patch); };
    refused("{instruments.drill.parameters.diameter: 6 mm, instruments: {drill: {parameters: {«diameter»: 8 mm}}}}");
    refused("{instruments: {drill: {parameters: {diameter: 8 mm}}}, «instruments.drill.parameters.diameter»: 6 mm}");
    refused("{budget.tick: 15 us, budget: {«tick»: 20 us}}");
    refused("{steps.enter.title: Go, steps: [{id: enter, «title»: Begin}]}");
    refused("{steps: [{id: enter, title: Go}, {id: enter, «title»: Begin}]}");
}
TEST(Patch, RefusesEqualValuesToo) {
    expect_refused(text::Code::patched_twice, "{accuracy.spacing: 1 mm, accuracy: {«spacing»: 1 mm}}");
}
TEST(Patch, RefusesAValueAndAPartOfIt) {
    const auto refused = [](const char* patch) { expect_refused(text::Code::patched_twice, patch); };
    refused("{steps.deepen: {limits: ~}, steps.deepen.«limits»: [{depth: {at_most: 38 mm}, reason: Deep.}]}");
    refused("{steps.deepen.title: On, steps: {«deepen»: ~}}");
    refused("{steps.deepen.limits: ~, steps: [{id: deepen, «limits»: []}]}");
    refused("{instruments.drill: {drives: {spindle_speed: 900 rpm}}, «instruments.drill.drives»: ~}");
}
TEST(Patch, ShowsBothPositionsOfAValueSetTwice) {
    text::Diagnostics found;
    EXPECT_FALSE(read(with_patch("{budget.tick: 15 us, budget: {tick: 20 us}}"), found));
    EXPECT_EQ(to_text(found),
              "E0214 hole.yaml:20:37: The patch sets `budget.tick` twice: got `15 us` and `20 us`, expected one value. "
              "Remove one of the two.\n"
              "          {budget.tick: 15 us, budget: {tick: 20 us}}\n"
              "                                        ^^^^\n"
              "  because of hole.yaml:20:15: it is set here first.\n"
              "          {budget.tick: 15 us, budget: {tick: 20 us}}\n"
              "                  ^^^^\n");
}
TEST(Patch, SetsDifferentPartsOfOneMap) {
    const Procedure p = patched("{steps.enter.title: Go, steps: [{id: deepen, title: On}], "
                                "instruments.drill.parameters.diameter: 5 mm, "
                                "instruments: {drill: {parameters: {point_angle: 90 deg}}}}");
    EXPECT_EQ(p.steps.at(0).title, "Go");
    EXPECT_EQ(p.steps.at(1).title, "On");
    EXPECT_EQ(p.instruments.at(0).tool_parameters.at(0), 5.0_mm);
}

TEST(Patch, RefusesAVariantThatIsNotThere) {
    text::Diagnostics found;
    EXPECT_FALSE(read(with_patch("time_limit: 30 s"), found, {"othr", {}}));
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found[0].code, "E0311");
    EXPECT_EQ(found[0].write, "other");
    found.clear();
    EXPECT_FALSE(read(base, found, {"other", {}}));
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found[0].code, "E0311");
}

// ---- --set

TEST(Setting, ComesAfterTheVariant) {
    text::Diagnostics found;
    const auto p = read(with_patch("{time_limit: 30 s, accuracy.spacing: 0.5 mm}"), found,
                        {"other", {"time_limit=20 s", "steps.deepen.limits=~"}});
    ASSERT_TRUE(p) << to_text(found);
    EXPECT_EQ(p->time_limit, 20.0_s);
    EXPECT_EQ(p->spacing, 0.5_mm);
    for (const Limit& limit : p->steps.at(1).limits) EXPECT_EQ(limit.quantity, "damage");
}
TEST(Setting, ShowsItsMistakesInItself) {
    text::Diagnostics found;
    EXPECT_FALSE(read(base, found, {"", {"time_limit=20"}}));
    EXPECT_EQ(to_text(found),
              "E0402 --set:1:13: time_limit has no unit: got `20`, expected a time in s. Write `20 s`.\n    "
              "time_limit: 20\n                ^^\n");
    for (const char* wrong :
         {"time_limit=", "time_limit=[", "time_limit=&a 3 s", "time_limit=\"", "steps.none=3", "time_limit.x=3 s", "=",
          "a", "", "time_limit=20 s\nsteps: ~", "time_limit={", "nothing=~"}) {
        found.clear();
        EXPECT_FALSE(read(base, found, {"", {wrong}})) << wrong;
        EXPECT_TRUE(text::has_error(found)) << wrong;
    }
}

TEST(Setting, NamesTheIdInPlaceOfANumber) {
    const auto found_by = [](const std::string& setting) {
        text::Diagnostics found;
        EXPECT_FALSE(read(base, found, {"", {setting}})) << setting;
        EXPECT_EQ(found.size(), 1u) << to_text(found);
        return found.empty() ? text::Diagnostic{} : found.front();
    };
    EXPECT_EQ(found_by("steps[1].feed=1 mm/s").code, "E0212");
    EXPECT_EQ(found_by("steps[1].feed=1 mm/s").write, "steps.deepen.feed=1 mm/s");
    for (const char* wrong : {"steps[2].feed=1 mm/s", "steps[x].feed=1 mm/s", "steps[].feed=1 mm/s", "steps[=1 mm/s"}) {
        EXPECT_EQ(found_by(wrong).write, "") << wrong;
        EXPECT_NE(found_by(wrong).message.find("expected `enter` or `deepen`"), std::string::npos) << wrong;
    }
    EXPECT_EQ(found_by("needs[0].x=1").write, "");
}

TEST(Setting, NamesThePathOfAKeyThatLiesDeeper) {
    for (const auto& [setting, path] : {std::pair{"spacing=0.5 mm", "accuracy.spacing"},
                                        {"instruments.drill.diameter=3 mm", "instruments.drill.parameters.diameter"},
                                        {"haptics.time_limit=20 s", "time_limit"}}) {
        text::Diagnostics found;
        EXPECT_FALSE(read(base, found, {"", {setting}})) << setting;
        ASSERT_EQ(found.size(), 1u) << to_text(found);
        EXPECT_EQ(found.front().write, path) << to_text(found);
    }
}

TEST(Setting, RefusesAValueSetTwice) {
    for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
             {"time_limit=20 s", "time_limit=30 s"},
             {"time_limit=20 s", "time_limit=20 s"},
             {"instruments.drill.parameters={diameter: 5 mm}", "instruments.drill.parameters.diameter=6 mm"},
             {"steps.enter={title: Go}", "steps=[{id: enter, title: Begin}]"}}) {
        text::Diagnostics found;
        EXPECT_FALSE(read(base, found, {"", settings})) << settings.back();
        ASSERT_EQ(found.size(), 1u) << to_text(found);
        EXPECT_EQ(found[0].code, "E0214");
        EXPECT_TRUE(found[0].reason);
    }
}
TEST(Setting, ProgramsOverrideIt) {
    std::vector<std::string> settings{"time_limit=20 s", "accuracy.spacing=0.5 mm"};
    override_setting(settings, "time_limit", "10 s");
    EXPECT_EQ(settings, (std::vector<std::string>{"accuracy.spacing=0.5 mm", "time_limit=10 s"}));
}

// ---- as text

bool is_same(const Node& a, const Node& b) {
    if (a.kind != b.kind || a.text != b.text || a.key != b.key || a.children.size() != b.children.size()) return false;
    for (std::size_t i = 0; i < a.children.size(); ++i)
        if (!is_same(a.children[i], b.children[i])) return false;
    return true;
}

void expect_same_when_read_back(const std::string& text) {
    Document document = read_again("a.yaml", text);
    std::erase_if(document.root.children, [](const Node& child) { return child.key == "variants"; });  // chosen already
    for (const bool is_annotated : {false, true}) {
        text::Diagnostics found;
        const auto back = parse_document("b.yaml", emitted(document, is_annotated)).take(found);
        ASSERT_TRUE(back) << to_text(found) << emitted(document, is_annotated);
        EXPECT_TRUE(is_same(document.root, back->root)) << emitted(document, is_annotated);
    }
}

TEST(PatchFile, ComesBetweenTheVariantAndTheSettings) {
    const test::TemporaryFolder folder;
    const std::string file = folder / "more.yaml";
    std::ofstream(file) << "# more hands\ntime_limit: 20 s\naccuracy.spacing: 1 mm\n"
                           "steps: [{id: deepen, title: Deeper}]\n";
    text::Diagnostics found;
    const auto p = read(with_patch("time_limit: 30 s"), found, {"other", {"accuracy.spacing=0.5 mm"}, {file}});
    ASSERT_TRUE(p) << to_text(found);
    EXPECT_EQ(p->time_limit, 20.0_s);
    EXPECT_EQ(p->spacing, 0.5_mm);
    EXPECT_EQ(p->steps.back().title, "Deeper");
    EXPECT_NE(emitted(*p->document, true).find(file + ":2"), std::string::npos);
}

TEST(PatchFile, ShowsItsMistakesInItself) {
    const test::TemporaryFolder folder;
    const auto said_of = [&](const std::string& text) {
        const std::string file = folder / "more.yaml";
        std::ofstream(file) << text;
        text::Diagnostics found;
        EXPECT_FALSE(read(base, found, {"", {}, {file}})) << text;
        return to_text(found);
    };
    const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    const std::string nowhere = said_of("\ntime_limit: 20 s\nsteps.deepn.title: Deeper\n");
    EXPECT_TRUE(has(nowhere, "E0212") && has(nowhere, "more.yaml:3:1")) << nowhere;
    const std::string whole = said_of("apiVersion: kerf/v1\nkind: Procedure\n");
    EXPECT_TRUE(has(whole, "more.yaml:2:1: This file is a document of its own.")) << whole;
    EXPECT_TRUE(has(said_of("- a\n"), "more.yaml:1:1"));
    EXPECT_TRUE(has(said_of("a: [b\n"), "more.yaml"));
    text::Diagnostics found;
    EXPECT_FALSE(read(base, found, {"", {}, {folder / "none.yaml"}}));
    EXPECT_TRUE(has(to_text(found), "none.yaml")) << to_text(found);
}

TEST(Emitted, ReadsBackToTheSameTree) {
    for (const char* file :
         {"/procedures/pedicle-screw.yaml", "/procedures/anatomy/vertebra-phantom.yaml", "/tests/real-data/l3.yaml"})
        expect_same_when_read_back(test::contents_of(KERF_SOURCE_DIR + std::string(file)));
    for (std::size_t choice = 0; choice < EveryKey::choices; ++choice)
        expect_same_when_read_back(EveryKey{.choice = choice}.document(shapes::anatomy));
    for (const char* odd : {"a: \"\"",
                            "a: ' b'",
                            "a: \"x: y\"",
                            "a: 'x #y'",
                            "a: -5 mm",
                            "a: '- b'",
                            "a: \"l1\\nl2\\tx\"",
                            "a: [[1, 2], [], {}, [{b: [c]}]]",
                            "a: '~'",
                            "a: \"ä “ü”\"",
                            "'a: b': c",
                            "a: '\"'",
                            "a: '\\'",
                            "a: '`x`'",
                            "a: '@x'",
                            "a: 'null'",
                            "a: b:c",
                            "a: ''",
                            "a: |\n  one\n  two\n",
                            "- a\n- [b]\n- c: d\n  e: f",
                            "a: '%'",
                            "a: 7 %",
                            "a: 'x:'",
                            "a: --x",
                            "a: '---'",
                            "a: '? x'",
                            "a: x,y"})
        expect_same_when_read_back(odd);
}

TEST(Emitted, EscapesControlCharactersOfFileNames) {
    text::Diagnostics found;
    const auto document = parse_document("a\033[2J.yaml", "a: b\n").take(found);
    ASSERT_TRUE(document) << to_text(found);
    const std::string text = emitted(*document, true);
    EXPECT_EQ(text, text::printable_lines(text));
    EXPECT_NE(text.find("# a\\x1b[2J.yaml:1"), std::string::npos) << text;
}

TEST(Emitted, SaysOfEveryValueWhereItComesFrom) {
    text::Diagnostics found;
    const auto p = read(with_patch("time_limit: 30 s"), found, {"other", {"accuracy.spacing=0.5 mm"}});
    ASSERT_TRUE(p) << to_text(found);
    const std::string text = emitted(*p->document, true);
    const auto has_line = [&](const std::string& value, const std::string& origin) {
        const std::size_t at = text.find(value);
        return at != std::string::npos && text.substr(at, text.find('\n', at) - at).ends_with("  # " + origin);
    };
    EXPECT_TRUE(has_line("device: touch", "hole.yaml:6")) << text;
    EXPECT_TRUE(has_line("time_limit: 30 s", "hole.yaml:20")) << text;
    EXPECT_TRUE(has_line("spacing: 0.5 mm", "--set")) << text;
    EXPECT_EQ(text.find("variants"), std::string::npos) << text;
}

TEST(Emitted, TheTextOfAVariantIsAProcedureByItself) {
    text::Diagnostics found;
    const auto p = read(with_patch("time_limit: 30 s"), found);
    ASSERT_TRUE(p) << to_text(found);
    const auto again = read(p->text, found, {});
    ASSERT_TRUE(again) << to_text(found) << p->text;
    EXPECT_EQ(again->time_limit, 30.0_s);
    EXPECT_EQ(emitted(*again->document, false), p->text);
}

TEST(DamagedVariant, CutOffOrChangedAnywhereIsAnsweredWithoutAThrow) {
    const std::string whole = with_patch(
        "{time_limit: 30 s, steps.deepen.limits: ~, steps: [{id: enter, title: Begin}], accuracy.spacing: 1 mm}");
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char damage : {'\0', '~', '.', '[', '\n', ':'}) {
            std::string damaged = whole;
            damaged[at] = damage;
            if (damage == '\0') damaged.resize(at);
            text::Diagnostics found;
            std::optional<Procedure> p;
            ASSERT_NO_THROW(p = read(damaged, found));
            ASSERT_EQ(p.has_value(), !text::has_error(found)) << to_text(found);
        }
}

}  // namespace
}  // namespace kerf::documents
