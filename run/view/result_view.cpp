// SPDX-License-Identifier: Apache-2.0
#include "run/view/result_view.h"

#include <algorithm>

namespace kerf::run {

ViewedResult viewed_result(const session::RunSummary& summary, const std::string& folder) {
    ViewedResult result{.verdict = session::to_text(summary.verdict),
                        .score = summary.score,
                        .reasons = summary.reasons,
                        .deductions = {},
                        .folder = folder};
    for (const session::DeductionRow& row : summary.deductions)
        result.deductions.push_back({row.loss, row.at.value_or(-1.0),
                                     row.name.empty()     ? row.detail
                                     : row.detail.empty() ? row.name
                                                          : row.name + ": " + row.detail});
    std::stable_sort(result.deductions.begin(), result.deductions.end(),
                     [](const auto& a, const auto& b) { return a.points > b.points; });
    return result;
}

}  // namespace kerf::run
