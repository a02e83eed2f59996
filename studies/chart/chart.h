// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/chart/drill/measure.h"
#include "studies/chart/drill/methods.h"
#include "studies/chart/physics/published.h"
#include "studies/chart/surfaces/burr_surfaces.h"
#include "studies/chart/trial.h"

/// Accuracy against speed. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// One method on one scene at one fineness.
struct Row {
    std::string scene{}, method{}, knob{};
    Fineness fineness{};
    Measured measured{};
    std::vector<std::string> fails{};  ///< tests of this marker and of its method, by id
};

struct MethodNote {
    std::string id{}, title{};
    bool is_as_printed = false;
    double stiffest = 0.0;  ///< K_max [N/m]; 0: it was not looked for
    std::string cutter = "drill";
};

struct SceneTitle {
    std::string id{}, title{};
    bool is_oblique = false;       ///< what is solved walks there, and is held against its replay: by its thrust alone
    std::string cutter = "drill";  ///< whose methods are compared there
    bool has_torque = false;       ///< a torque is compared
    std::string note{};            ///< what the reference is, where that is not one thing
};

struct Chart {
    std::string processor{};      ///< what the costs were measured on
    CuttingLaw law{};             ///< that all but the papers share
    std::vector<AwlWay> awl{};    ///< into a pedicle and through its wall
    std::vector<Check> checks{};  ///< of the physics
    std::vector<SceneTitle> scenes{};
    std::vector<MethodNote> methods{};
    std::vector<Standing> standings{};  ///< of every method at every fineness
    std::vector<Row> rows{};
    std::vector<SurfaceRow> surfaces{};  ///< of the scenes with a burr
};

struct Request {
    std::string scene{};  ///< id; empty: all
    bool is_quick = false;
    std::function<void(const std::string&)> progress{};  ///< a line for people, as it goes
    FindStrategy strategies{};                           ///< for exact surfaces; empty: the chart goes without them
};

/// Runs every method of its cutter through every scene. Error: no such scene, a plugin is missing.   [main]
[[nodiscard]] Chart make_chart(const Plugins& plugins, const Request& request, std::string& error);

}  // namespace kerf::chart
