// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/view/viewed_run.h"

/// All that the start page shows, and what a user chooses on it. Plain values, so that the page knows no other part of
/// Kerf.
namespace kerf::window {

/// An entry of a list: a variant, a rehearsal.
struct StartEntry {
    std::string id{}, title{};
};

struct StartProcedure {
    std::string file{}, id{}, title{};
    std::string summary{};  ///< one line: "4 steps with pilot, tap, screw"
    std::vector<StartEntry> variants{};
};

/// The chosen procedure with the chosen variant.
struct StartDetails {
    struct Step {
        std::string title{}, tool{};
        std::vector<std::string> goals{}, limits{};  ///< in words
    };
    std::string error{};  ///< the variant cannot be used; empty: it can
    std::vector<Step> steps{};
    std::vector<StartEntry> rehearsals{};
    std::string assist{};     ///< help of the procedure: "full"
    double time_limit = 0.0;  ///< [s]
};

struct StartDevice {
    std::string id{};               ///< as `--device` takes it; empty: a driver that has found no device
    std::string name{}, problem{};  ///< for people
    [[nodiscard]] bool is_ready() const { return !id.empty() && problem.empty(); }
};

/// An earlier attempt of a learner.
struct StartAttempt {
    std::string procedure{};  ///< id
    int number = 0;
    std::string folder{};
    std::string verdict{};                      ///< "pass"; "no result" if it has no readable summary
    std::optional<double> score{}, duration{};  ///< of 100; [s]
    bool is_demonstration = false;              ///< the simulated hand operated
    bool has_session = false, has_report = false;
};

struct StartPage {
    std::string folder{};  ///< of the procedures
    std::vector<StartProcedure> procedures{};
    std::vector<std::string> refused{};  ///< files of the folder that cannot be used, each with the reason
    std::vector<StartDevice> devices{};
    std::vector<std::string> assist_levels{};  ///< as `--assist` takes them
    StartDetails details{};
    std::vector<StartAttempt> attempts{};  ///< of the learner, newest first
    std::string attempts_folder{};
    std::string learner_refusal{};  ///< what is wrong with the learner's code; empty: nothing
    std::string message{};          ///< how the last action ended; empty: nothing to report
    bool is_message_bad = false;
};

/// What the user has chosen. It outlives the page, which returns after a run.
struct StartSelection {
    std::size_t procedure = 0;
    std::string variant{};    ///< id; empty: none
    std::string rehearsal{};  ///< id of the rehearsal that the simulated hand carries out; empty: the first
    std::string device{};     ///< that leads the tool; empty: the simulated hand
    std::string mode = "practice";
    std::string assist{};   ///< level of help; empty: that of the procedure
    std::string learner{};  ///< a code, or empty
    bool shows_all_attempts = false;
};

/// The scene of a procedure before its first tick.
struct StartPicture {
    run::ViewedScene scene{};
    run::ViewedState state{};
    std::shared_ptr<const run::ViewedSurface> surface{};
};

/// Where the page gets its contents.   [main]
class StartSource {
public:
    virtual ~StartSource() = default;

    /// Returns the contents for a selection, which is corrected if it fits no more. Valid until the next call.
    virtual const StartPage& page(StartSelection& selection) = 0;
    /// Returns the picture for a selection; null while it is made on another thread, or if it cannot be made.
    virtual std::shared_ptr<const StartPicture> picture(const StartSelection& selection) = 0;
    /// Returns why there is no picture yet, for people.
    [[nodiscard]] virtual std::string picture_state() const = 0;
    /// Reads the procedures of another folder; empty: the shipped ones.
    virtual void open_folder(const std::string& folder) = 0;
    /// Removes the message.
    virtual void forget_message() = 0;
};

/// What the user wants to do next.
struct StartAction {
    enum class Kind { none, start, watch, report } kind = Kind::none;
    std::size_t attempt = 0;  ///< of `watch` and `report`: index into StartPage::attempts
};

}  // namespace kerf::window
