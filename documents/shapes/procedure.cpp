// SPDX-License-Identifier: Apache-2.0
#include "documents/made/bone_kind.h"
#include "documents/made/read_request.h"
#include "documents/shapes/shapes.h"
#include "documents/shapes/values.h"

namespace kerf::documents::shapes {
namespace {

/// The levels of all kinds of made bones. Only the reader of a request knows which ones its kind has.
struct LevelWord : ValueShape {};
void read_value(MapReader& map, const std::string& key, const LevelWord& /*shape*/, std::string& level) {
    level = map.text(key);
}

}  // namespace

const MapShape<Procedure> metadata{
    "metadata",
    "The name of the procedure, and its status.",
    {{required, "id", &Procedure::id, id(), "The name that files and results use.", "pilot-hole"},
     {required, "title", &Procedure::title, words(), "The name that people read.", "Pilot hole for a pedicle screw"},
     {required, "version", &Procedure::version, version(), "Increased with every change of the procedure.", "0.1.0"},
     {required, "status", &Procedure::status, word({"draft", "piloted", "validated"}),
      "How far it has been tested with people.", "draft"},
     {optional, "authors", list(text()), "The authors.", "[The Kerf authors]"}}};

const MapShape<Procedure> needs{
    "needs",
    "What the anatomy must have, by name: a procedure holds no coordinates.",
    {{optional, "landmarks", &Procedure::needs_landmarks, ids(), "Points, axes and planes.",
      "[right_pedicle, midline, resection, other_end, third_end]"},
     {optional, "zones", &Procedure::needs_zones, ids(), "Regions that limits name.", "[canal]"},
     {optional, "tissues", &Procedure::needs_tissues, ids(), "Tissues that the bone must be made of.",
      "[cortical, cancellous]"}}};

const MapShape<Procedure> accuracy{
    "accuracy",
    "The accuracy that the simulation needs.",
    {{optional, "spacing", &Procedure::spacing, length(0.05_mm, 2.0_mm),
      "Between the samples of the bone's distance field.", "0.25 mm", "0.25 mm"},
     {optional, "force", within(&Procedure::accuracy, &Accuracy::force), quantity(dimension::none, "%", 0.001, 0.5),
      "The largest error of force and torque that `kerf plan` may accept, against the finest field.", "7 %", "7 %"},
     {optional, "volume", within(&Procedure::accuracy, &Accuracy::volume), quantity(dimension::none, "%", 0.0005, 0.5),
      "The largest error of the removed volume that `kerf plan` may accept.", "2 %", "2 %"}}};

const MapShape<Procedure> budget{
    "budget",
    "The processor time that the simulation may use.",
    {{optional, "tick", within(&Procedure::budget, &Budget::tick), quantity(dimension::time, "us", 1e-6, 1.0_ms),
      "Processor time of 999 ticks of 1000; `kerf plan` searches for settings that keep it.", "300 us", "300 us"}}};

const MapShape<Procedure> haptics{
    "haptics",
    "The haptic device, and its coupling to the tool.",
    {{required, "device", &Procedure::device, id(),
      "The device whose inertia, friction and greatest force are simulated.", "touch"},
     {optional, "coupling", &Procedure::is_direct, choice<bool>({{"solved", false}, {"direct", true}}),
      "`solved`, or `direct` to apply the force law to the device's own motion, as published methods do.", "solved",
      "solved"},
     {optional, "force_scale", &Procedure::force_scale, number(1e-4, 10.0),
      "Device newton per bone newton; computed if not given, from `working_force` or from the steps.", "1/50"},
     {optional, "working_force", &Procedure::working_force, quantity(dimension::force, "N", 0.1_N, 1000.0_N),
      "The force of the bone that the device should hold with ease, at 0.6 of its continuous force; without it, "
      "that "
      "of the densest tissue at the steps' `feed`. `force_scale` has precedence.",
      "20 N"}}};

const MapShape<Variant> variant{
    "variant",
    "The procedure with a few values changed.",
    {{optional, "title", &Variant::title, words(), "The difference from the procedure.", "Osteoporotic bone"},
     {required, "patch", of_kind(Kind::patch),
      "Paths of values, and the new values; ids address the items of lists, `~` removes.",
      "{accuracy.spacing: 0.5 mm}"}}};

const MapShape<ZoneDisplay> zone_display{
    "zone_display",
    "When a zone is drawn, if `assist` allows it.",
    {{optional, "show", &ZoneDisplay::show,
      choice<ZoneDisplay::Show>({{"never", ZoneDisplay::Show::never},
                                 {"near", ZoneDisplay::Show::near},
                                 {"always", ZoneDisplay::Show::always},
                                 {"after", ZoneDisplay::Show::after}}),
      "`never`, `near` the tool, `always`, or `after` the operation.", "near", "always"},
     {optional, "within", &ZoneDisplay::within, length(0.1_mm, 100.0_mm), "The distance of the tool for `near`.",
      "5 mm", "5 mm"}}};

const MapShape<ScoredMetric> scored_metric{
    "scored_metric",
    "A metric of the results that the score counts.",
    {{required, "metric", text(), "Its id in `summary.json`, such as `insert.entry-offset`.", "drill.entry-offset"},
     {required, "full", of_kind(Kind::of_metric), "The value that earns all, in the metric's unit.", "1 mm"},
     {required, "none", of_kind(Kind::of_metric), "The value that earns nothing; between the two, in proportion.",
      "4 mm"},
     {optional, "target", of_kind(Kind::of_metric),
      "The planned value; `full` and `none` are then distances from it, to either side.", "35 mm"},
     {optional, "weight", &ScoredMetric::weight, number(0.0, 1000.0), "How much it counts beside the others.", "2",
      "1"}}};

const MapShape<MakeRequest> made_bone{
    "made_bone",
    "A bone made from published dimensions.",
    {{required, "make", &MakeRequest::kind, word(made_kinds()), "Its kind.", "vertebra"},
     {optional, "level", &MakeRequest::level, LevelWord{word(made_levels())}, "The level, for a kind that has levels.",
      "L3"},
     {optional, "sex", &MakeRequest::sex,
      choice<MakeRequest::Sex>({{"f", MakeRequest::Sex::female}, {"m", MakeRequest::Sex::male}}),
      "If not given, drawn; without a seed the mean of both.", "f"},
     {optional, "height", &MakeRequest::stature, quantity(dimension::length, "cm", 1.3_m, 2.2_m), "Of the person.",
      "165 cm"},
     {optional, "age", &MakeRequest::age, number(20.0, 100.0), "Of the person, in years; it sets the density.", "70",
      "45"},
     {optional, "osteoporosis", &MakeRequest::is_osteoporotic, yes_no(), "It sets the density.", "true", "false"},
     {optional, "seed", number(0.0, max_seed),
      "Number of the person: a whole number. Without it the bone has mean dimensions.", "7"},
     {optional, "set", of_kind(Kind::parameters),
      "Dimensions that are not drawn; `kerf describe vertebra` lists those of a vertebra.", "{pedicle.width: 8 mm}"}}};

const Shape procedure{
    "procedure",
    "An operation, in terms of an anatomy's names.",
    {{required, "apiVersion", word({"kerf/v1"}), api_version_help, "kerf/v1"},
     {required, "kind", word({"Procedure"}), "What this document describes.", "Procedure"},
     {required, "metadata", map(metadata), "Its name and status.",
      "{id: hole, title: A hole, version: 0.1.0, status: draft}"},
     {required, "needs", map(needs), "What the anatomy must have.",
      "{landmarks: [right_pedicle, midline, other_end], zones: [canal]}"},
     {required, "anatomy", path_or(made_bone),
      "The anatomy that it runs on without `--anatomy`: a file in this document's folder, a shipped one, or a bone to "
      "make.",
      "anatomy/vertebra-phantom.yaml"},
     {optional, "accuracy", map(accuracy), "The accuracy that the simulation needs.", "{spacing: 0.25 mm}"},
     {optional, "budget", map(budget), "The processor time that the simulation may use.", "{tick: 300 us}"},
     {required, "haptics", map(haptics), "The haptic device.", "{device: touch}"},
     {optional, "time_limit", quantity(dimension::time, "s", 1.0_s, 3600.0_s),
      "The simulated time after which the run ends.", "120 s", "120 s"},
     {required, "instruments", named(map(instrument)), "The tools, under names that steps use.",
      "{pilot: {plugin: example.drilling, tool: twist_drill, force: drill_cutting}}"},
     {optional, "implants", named(map(implant)), "Solids that waypoints bring in.",
      "{plate: {mesh: {file: plate.stl, unit: mm}}}"},
     {optional, "constructions", named(map(construction)),
      "Points, lines and planes that measures use, made of landmarks and of the bone.",
      "{way: {line: [midline, other_end]}}"},
     {optional, "measures", named(map(measure)),
      "Numbers that are measured on the bone, for results, goals and limits.",
      "{cortex: {thickness: {at: midline, along: right_pedicle}}}"},
     {required, "steps", list(map(step)), "What to do, in this order.",
      "[{id: drill, title: Drill, instrument: pilot, axis: right_pedicle, goals: [{entry: {}}]}]"},
     {optional, "assist", word({"off", "on-request", "stepwise", "full"}),
      "The help that the trainee gets with plan, zones, limits and hints: none, of a step when it is requested, of the "
      "running step, or of all steps.",
      "stepwise", "full"},
     {optional, "zones", named(map(zone_display)), "When zones of `needs.zones` are drawn.", "{canal: {show: near}}"},
     {optional, "scoring", list(map(scored_metric)),
      "The metrics from which the score follows; without it, steps and limits count in equal parts.",
      "[{metric: drill.entry-offset, full: 1 mm, none: 4 mm}]"},
     {optional, "paths", named(list(map(waypoint))), "Waypoints that several rehearsals follow.",
      "{approach: [{depth: -5 mm}, {depth: 5 mm}]}"},
     {optional, "rehearsals", list(map(rehearsal)), "Simulated hands, and their expected results.",
      "[{id: expert, expect: pass, path: [{depth: -5 mm}, {depth: 32 mm}]}]"},
     {optional, "variants", named(map(variant)), "The same with a few values changed, for `--variant`.",
      "{coarse: {patch: {accuracy.spacing: 0.5 mm}}}"}}};

}  // namespace kerf::documents::shapes
