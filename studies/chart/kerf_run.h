// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/chart/run.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A plugin's law on Kerf's fields, in Kerf's own loop.
class KerfRun : public Run {
public:
    enum class Way {
        direct,  ///< M4: at the rate of a prescribed motion
        solved,  ///< M9: the hand is led, coupling and law are balanced, the tool finds its motion
    };
    KerfRun(const Setting& setting, const Fineness& fineness, Way way);

    Felt tick(const Pose& next) override;
    void command_spindle(double revolutions_per_second) override {
        simulation_.command_drive(0, revolutions_per_second);
    }
    double removed_volume() override;

private:
    Body body_;
    Way way_;
    Simulation simulation_;
};

}  // namespace kerf::chart
