// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/record_checksum.h"
#include "session/recording.h"

namespace kerf {

/// What a replay needs of a session: every input of every tick, and the hash the run ended in.
struct RecordedInputs {
    std::string procedure_text;
    std::string variant;    ///< of the procedure; empty for none
    std::string rehearsal;  ///< that the hand followed
    std::uint64_t anatomy_hash = 0;
    std::vector<Pose> device_from_handle;  ///< one per tick, in order
    std::vector<std::uint64_t> adoptions;  ///< ticks after which the loop took over what had come apart, in order
    std::vector<std::pair<std::uint64_t, std::string>>
        hand_inputs;  ///< what else the hand asked for, and before which tick
    std::vector<std::pair<std::uint64_t, std::uint32_t>>
        missed;                               ///< ticks that did not run, and before which one, in order
    std::string hash;                         ///< sixteen hexadecimal digits; empty for a run that was cut short
    RecordCheck rows = RecordCheck::unknown;  ///< whether all that the session holds is what the run wrote
    bool is_old = false;                      ///< of a Kerf that wrote no checksum
};

/// Reads a session file without changing it. Error: not a session, another schema, gaps in the ticks, a pose that is
/// none, a count of missed ticks that is none; `error` is for people.   [main]
[[nodiscard]] std::optional<RecordedInputs> read_session(const std::string& path, std::string& error);

}  // namespace kerf
