// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/record_checksum.h"
#include "session/recording.h"

namespace kerf::session {

/// The inputs of a session that a replay needs: all inputs of each tick, and the hash at the end.
struct RecordedInputs {
    std::string procedure_text;
    std::string variant;    ///< of the procedure; empty for none
    std::string rehearsal;  ///< that the hand followed
    bool is_examination = false;
    std::string assist;  ///< as in SessionConditions; empty in a session of an earlier version
    std::uint64_t anatomy_hash = 0;
    std::vector<Pose> device_from_handle;  ///< one per tick, in order
    /// Ticks after which the loop took over separated bodies, in order.
    std::vector<std::uint64_t> adoptions;
    std::vector<std::pair<std::uint64_t, std::string>>
        hand_inputs;  ///< other inputs of the hand, each with the tick before which it came
    std::vector<std::pair<std::uint64_t, std::uint32_t>>
        missed;                                        ///< numbers of missed ticks, each with the next tick, in order
    std::vector<std::pair<std::uint64_t, bool>> lost;  ///< ticks at which the device was lost (true) or back, in order
    std::vector<std::pair<std::uint64_t, std::string>>
        late_changes;    ///< numbers of changes that the loop took over late or refused, each with the next tick
    std::string device;  ///< id of the connected device; empty: a hand without one
    std::vector<std::pair<std::string, double>> device_values;  ///< of the connected device [SI]
    std::string uuid;                                           ///< of the session; empty: the file has none
    std::string hash;                         ///< sixteen hexadecimal digits; empty for a run that was cut short
    RecordCheck rows = RecordCheck::unknown;  ///< result of the checksum
    bool is_old = false;                      ///< written by a version without checksums
};

/// Reads a session file without changing it. Error: not a session, another schema, gaps in the ticks, an invalid pose
/// or an invalid count of missed ticks; `error` is a text for people.   [main]
[[nodiscard]] std::optional<RecordedInputs> read_session(const std::string& path, std::string& error);

}  // namespace kerf::session
