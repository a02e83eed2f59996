// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/chart/measure.h"
#include "conformance/chart/methods.h"

/// Accuracy against speed. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// One method on one scene at one fineness.
struct Row {
    std::string scene{}, method{}, knob{};
    Fineness fineness{};
    Measured measured{};
    std::vector<std::string> fails{};  ///< tests of this marker and of its method, by id
};

/// What holds for a method wherever it stands.
struct Standing {
    std::string method{}, title{};
    bool is_as_printed = false;
    std::vector<std::string> fails{};  ///< by id
    std::string told{};                ///< what each test measured
    double stiffest = 0.0;             ///< K_max [N/m]
};

struct SceneTitle { std::string id{}, title{}; };

struct Chart {
    std::string processor{};  ///< what the costs were measured on
    std::vector<SceneTitle> scenes{};
    std::vector<Standing> methods{};
    std::vector<Row> rows{};
};

struct Request {
    std::string scene{};  ///< id; empty: all
    bool is_quick = false;
    std::function<void(const std::string&)> progress{};  ///< a line for people, as it goes
};

/// Runs every method through every scene. Error: no such scene, no drilling plugin.   [main]
[[nodiscard]] Chart make_chart(const Plugins& plugins, const Request& request, std::string& error);

}  // namespace kerf::chart
