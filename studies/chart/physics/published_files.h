// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "studies/chart/physics/published.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Thrust and torque over the feed per revolution, as measured and as four laws have it, and how far each prediction is
/// off; an awl's push over its depth.
[[nodiscard]] std::string published_svg(const CuttingLaw& law, std::span<const AwlWay> awl);
/// A row per prediction, then a row per check.
[[nodiscard]] std::string published_csv(const CuttingLaw& law, std::span<const Check> checks);
/// The same for the page: picture, checks, what was calibrated on what.
[[nodiscard]] std::string published_html(const CuttingLaw& law, std::span<const AwlWay> awl,
                                         std::span<const Check> checks);

}  // namespace kerf::chart
