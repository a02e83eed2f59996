// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/view/viewed_run.h"

namespace kerf::window {

/// A run of which a test makes each tick.
class MadeRun final : public run::ViewedRun {
public:
    void pass_to(double end) {
        for (; state_.time < end - 1e-9;) {
            state_.time += 1e-3;
            ++state_.tick;
            rows_.push_back({state_.time, static_cast<float>(10.0 * state_.time), 0, static_cast<float>(state_.time),
                             static_cast<float>(6.0 * state_.time), 0, state_.step});
            if (state_.tick % 16 == 0) moments_.push_back({state_, nullptr});
        }
    }
    run::ViewedState state_;
    std::optional<run::ViewedResult> result_;
    run::ViewedScene scene_;

    [[nodiscard]] const run::ViewedScene& scene() const noexcept override { return scene_; }
    bool take(run::ViewedState& state) noexcept override {
        state = state_;
        return true;
    }
    void take(std::vector<run::ViewedRow>& rows) override { move(rows_, rows); }
    void take(std::vector<run::ViewedEvent>&) override {}
    void take(std::vector<run::ViewedMoment>& moments) override { move(moments_, moments); }
    [[nodiscard]] std::shared_ptr<const run::ViewedSurface> surface() const override { return nullptr; }
    [[nodiscard]] std::optional<double> duration() const noexcept override { return std::nullopt; }
    [[nodiscard]] std::string next_action() const override { return {}; }
    [[nodiscard]] std::optional<run::ViewedResult> result() const override { return result_; }
    [[nodiscard]] bool is_closed() const noexcept override { return false; }
    [[nodiscard]] bool is_led_by_mouse() const noexcept override { return false; }
    void lead(const run::MouseTotals&) noexcept override {}
    void stop() noexcept override {}

private:
    template <class T>
    static void move(std::vector<T>& from, std::vector<T>& to) {
        to.insert(to.end(), from.begin(), from.end());
        from.clear();
    }
    std::vector<run::ViewedRow> rows_;
    std::vector<run::ViewedMoment> moments_;
};

}  // namespace kerf::window
