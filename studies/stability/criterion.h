// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::stability {

/// What the hand puts into the port, less what it gets back.
///
///     W ← min(W + f Δx, V)
///
/// with f the force against the depth that the device made while it went Δx deeper, and V the most that may be given
/// back. V is unlimited where nothing is cut; where work is spent on bone it is what the coupling's spring holds, as
/// a plain sum would hide a fault behind the work of drilling.
class PortEnergy {
public:
    void see(double force, double deeper, double ceiling = 1e300) noexcept { add(force * deeper, ceiling); }
    /// The same with the work f Δx of the hand [J].
    void add(double work, double ceiling = 1e300) noexcept;
    /// From here on: how low it has been is forgotten.
    void begin() noexcept { least_ = energy_; }
    [[nodiscard]] double now() const noexcept { return energy_; }   ///< [J]
    [[nodiscard]] double least() const noexcept { return least_; }  ///< [J]

private:
    double energy_ = 0.0, least_ = 0.0;
};

/// The most often a force turned back within 100 ms, turns of at most 0.05 N not counted. More than ten: it alternates
/// faster than 50 Hz.
[[nodiscard]] int max_turns(const std::vector<double>& force, double period);

/// One sample a tick of a run at the port.
struct Trace {
    double period = 1e-3;       ///< [s]
    std::vector<double> depth;  ///< [m] as it is, not as the encoder says
    std::vector<double> force;  ///< [N] the device made
    PortEnergy energy;
};

struct Judged {
    double counts = 0.0;      ///< [–] encoder counts from peak to peak after half a second
    int turns = 0;            ///< within 100 ms
    double min_energy = 0.0;  ///< [J]

    /// Returns whether it gives no energy and does not alternate, wherever the hand is.
    [[nodiscard]] bool is_calm() const noexcept { return turns <= 10 && min_energy >= -1e-4; }
    [[nodiscard]] bool is_stable() const noexcept { return counts < 3.0 && is_calm(); }
};
[[nodiscard]] std::string in_figures(const Judged& judged);
inline constexpr const char* calm_means = "<=10 turns in 100 ms, >=-0.1 mJ";
inline constexpr const char* stable_means = "<3 counts p-p after 0.5 s, <=10 turns in 100 ms, >=-0.1 mJ";

/// Stable: after 0.5 s less than 3 counts from peak to peak, no alternation above 50 Hz and 0.05 N, never more than
/// 0.1 mJ out of the port. Where the tool advances (`moves`) the counts are taken about the straight line through each
/// 100 ms.
///
/// Source: D.4 of the project's accuracy reference.
[[nodiscard]] Judged judge(const Trace& trace, double resolution, bool moves);

}  // namespace kerf::stability
