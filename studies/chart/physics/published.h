// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studies/chart/drill/methods.h"
#include "studies/chart/physics/awl_ways.h"

/// Laws of drilling against published measurements. For training and research; not for diagnosis, planning or deciding
/// treatment.
namespace kerf::chart {

/// One mean of a published series.
struct PublishedMean {
    double speed;              ///< [1/s]
    double thrust, thrust_sd;  ///< [N]; sd 0: not reported
    double torque, torque_sd;  ///< [N·m]
};
struct PublishedSeries {
    const char* source;  ///< key in docs/references.md
    const char* tissue;
    double feed_rate;                  ///< [m/s]; 0: not seen
    std::vector<PublishedMean> means;  ///< by rising speed
    [[nodiscard]] double feed(const PublishedMean& mean) const noexcept { return feed_rate / mean.speed; }
};
/// [macavelia-2012] human and artificial femurs, [orelaja-2020] bovine, porcine and artificial bone.
[[nodiscard]] std::vector<PublishedSeries> published_series();

/// A law of one quantity over the feed per revolution [m].
struct FeedLaw {
    const char* name;
    std::vector<std::size_t> calibrated_on;  ///< indices of means: as many as it has constants
    std::function<double(double)> at;
};
/// Proportional (one constant, from the slowest spindle), edge + chip and power (two, from the slowest and the
/// fastest).
[[nodiscard]] std::vector<FeedLaw> fitted_laws(const PublishedSeries& series, bool of_torque);

/// Thrust [N] or torque [N·m] of the shared law's exact integral over all edges of a drill, 3.2 mm if not said.
[[nodiscard]] double shared_law_at(const CuttingLaw& law, double feed, bool of_torque, double diameter = 3.2e-3);

/// One prediction of a mean that its law was not calibrated on. "Kerf" was, on the line through all three of the human
/// femur; of the bovine femur it knows nothing.
struct Prediction {
    std::string source{}, tissue{}, law{}, quantity{};
    double speed = 0.0, predicted = 0.0, measured = 0.0, sd = 0.0;  ///< SI
    bool is_feed_known = true;  ///< false: of the study it is not, and 1 mm/s is assumed
    [[nodiscard]] double off_in_sd() const noexcept { return sd > 0.0 ? (predicted - measured) / sd : 0.0; }
};
[[nodiscard]] std::vector<Prediction> predictions(const CuttingLaw& law);

/// A statement that a law of drilling must bear out.
struct Check {
    std::string id{}, what{}, found{}, wanted{};
    bool passes = false;
    std::string remark{};
};
/// B1-a … B1-f. `awl`: all of `awl_ways()`.
[[nodiscard]] std::vector<Check> published_checks(const CuttingLaw& law, std::span<const AwlWay> awl);

}  // namespace kerf::chart
