// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "studies/plan/plan.h"

/// A plan for people, and as a table. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::plan {

/// What was tried, what is chosen, what is left out and what that changes, and what to write in the procedure.
[[nodiscard]] std::string plan_text(const Task& task, const StepPlan& plan);

/// A row for each choice that was tried and each feature. The first line, a comment, says what it is not for.
[[nodiscard]] std::string plan_csv(std::span<const StepPlan> plans);

}  // namespace kerf::plan
