// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/stability/finding.h"
#include "studies/stability/scope.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// The stiffest sampled spring f = K x on which a mass let go at 1 mm does not swing further out [N/m], by bisection.
[[nodiscard]] double stiffest_wall(const PortSettings& settings);
/// What theory says of it, without hand, friction and quantisation: K = b/(T/2 + t_d).
/// Source: [gil-2004], [hulin-2014].
[[nodiscard]] double stiffest_wall_in_theory(const PortSettings& settings) noexcept;

/// S-02 a stiff wall, S-03 the same with latency.   [main]
void check_walls(const Scope& scope, const Report& report);
/// S-02 with a hand that pushes on a stiff wall. `check_walls` has it, too.   [main]
void check_contact(const Scope& scope, const Report& report);

}  // namespace kerf::stability
