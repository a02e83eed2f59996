// SPDX-License-Identifier: Apache-2.0
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

std::vector<Command> study_commands() {
    std::vector<Command> rows;
    rows.push_back(
        {.name = "plan",
         .group = "Studies",
         .summary = "Find the coarsest settings that each step allows: spacing, elements, features",
         .arguments = {procedure_of<PlanOptions>()},
         .options = {anatomy_of<PlanOptions>(), variant_of<PlanOptions>(), patches_of<PlanOptions>(),
                     settings_of<PlanOptions>(),
                     out_of<PlanOptions>(folder(), "Folder for plan.txt and plan.csv", "none is written")},
         .when_missing = "which procedure? Write `kerf plan PROCEDURE.yaml`.",
         .examples = {{"kerf plan pedicle-screw.yaml", "prints a plan for a shipped procedure"}},
         .footer =
             "Keeps the procedure's `accuracy: {force: 7 %, volume: 2 %}` and `budget: {tick: 300 us}`; these are "
             "the defaults. Torque about the shaft counts as force. Without a `budget:` the result is the coarsest "
             "accurate setting.\nExit code: 0 a plan keeps both, 1 none does.",
         .defaults = PlanOptions{},
         .run = own_program("plan")});
    rows.push_back(
        {.name = "stability",
         .group = "Studies",
         .summary = "Test the haptic loop under conditions in which published methods fail",
         .options = {flag("--quick", "Test one device, two hands and one delay",
                          in<StabilityOptions>(&StabilityOptions::is_quick)),
                     {.name = "--plugin",
                      .value = text("PLUGIN", "the name of a plugin, as `kerf list` shows it"),
                      .help = "Plugin whose first tool and force are tested",
                      .default_value = "kerf.drilling",
                      .member = in<StabilityOptions>(&StabilityOptions::plugin)},
                     out_of<StabilityOptions>(folder(), "Folder for stability.csv and stability.svg", "out/stability")},
         .examples = {{"kerf stability --quick", "tests the drill in a few scenes"}},
         .footer = "Exit code: 0 Kerf passes all tests, 1 it fails one. Published methods may fail.",
         .defaults = StabilityOptions{},
         .run = own_program("stability")});
    rows.push_back(
        {.name = "chart",
         .group = "Studies",
         .summary = "Compare methods for the force of drill, burr and saw with exact ones, and plot error against cost",
         .options = {flag("--quick", "One scene, or that of --scene; two values of each setting; one grid",
                          in<ChartOptions>(&ChartOptions::is_quick)),
                     {.name = "--scene",
                      .value = text("SCENE", "the id of a scene"),
                      .help = "Only this scene",
                      .default_value = "all",
                      .member = in<ChartOptions>(&ChartOptions::scene)},
                     out_of<ChartOptions>(folder(), "Folder for chart.csv, chart.html and the pictures", "out/chart")},
         .examples = {{"kerf chart --quick", "draws one scene"}},
         .defaults = ChartOptions{},
         .run = own_program("chart")});
    return rows;
}

}  // namespace kerf::app::table
