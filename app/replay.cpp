// SPDX-License-Identifier: Apache-2.0
#include "app/replay.h"

#include <charconv>

#include "documents/yaml/document.h"
#include "text/printable.h"

namespace kerf::app {
namespace {

/// Returns the id in the text of a procedure; empty if there is none.
std::string id_in(const std::string& procedure_text) {
    const documents::Document document = documents::read_again("", procedure_text);
    const documents::Node* metadata = document.root.find("metadata");
    const documents::Node* id = metadata != nullptr ? metadata->find("id") : nullptr;
    return id != nullptr ? text::printable(id->text) : std::string();
}

}  // namespace

std::string refusal_of_replay(const session::RecordedInputs& recorded, const std::string& session,
                              const documents::Procedure& procedure) {
    if (recorded.variant != procedure.variant)
        return session + ": was recorded " +
               (recorded.variant.empty()
                    ? "without a variant. Leave out `--variant`."
                    : "with the variant `" + recorded.variant + "`. Write `--variant " + recorded.variant + "`.");
    if (recorded.procedure_text == procedure.text) return {};
    if (const std::string id = id_in(recorded.procedure_text); !id.empty() && id != procedure.id)
        return session + ": was recorded with the procedure `" + id + "`, and this is `" + procedure.id + "`. Name `" +
               id + "`, or another session.";
    return refusal_of_other_text(session);
}

std::string refusal_of_other_text(const std::string& session) {
    return session +
           ": was recorded with another text of this procedure or anatomy, or with another scan, so it cannot end the "
           "same. Name the files as they were, or record it again.";
}

std::string refusal_of_changed(const session::RecordedInputs& recorded, const std::string& session) {
    if (recorded.rows != session::RecordCheck::changed) return {};
    return session +
           ": was changed after its run wrote it: its rows do not give its checksum. Take an undamaged copy; or replay "
           "it with `kerf run --replay` to see what its inputs come to.";
}

std::string repeat(const session::RecordedInputs& recorded, const std::string& session, run::RunRequest& request) {
    request.rehearsal = recorded.rehearsal;
    request.mode = recorded.is_examination ? "exam" : request.is_examination() ? "practice" : request.mode;
    if (!recorded.assist.empty()) request.assist = documents::assist_of(recorded.assist);
    request.replay = recorded.device_from_handle;
    request.adoptions = recorded.adoptions;
    request.missed = recorded.missed;
    request.lost = recorded.lost;
    for (const auto& [tick, text] : recorded.hand_inputs) {
        const auto input = documents::hand_input(text);
        if (!input) return session + ": the hand requested `" + text + "`, which this Kerf does not know.";
        request.hand_inputs.emplace_back(tick, *input);
    }
    for (const auto& [tick, text] : recorded.late_changes) {
        run::LateChange late{.number = 0, .tick = tick, .is_refused = text.ends_with(" refused")};
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), late.number);
        if (status != std::errc{} || end != text.data() + text.size() - (late.is_refused ? sizeof " refused" - 1 : 0))
            return session + ": the late change `" + text + "` has no number. The file was changed.";
        request.late_changes.push_back(late);
    }
    return {};
}

std::string recorded_device(const session::RecordedInputs& recorded, const std::string& session,
                            std::unique_ptr<StatedDevice>& device) {
    if (recorded.device_values.empty()) return {};
    std::string fault;
    device = StatedDevice::of(recorded.device, recorded.device_values, fault);
    return device != nullptr ? std::string()
                             : session + ": the recorded device cannot be used: " + fault + ". The file was changed.";
}

}  // namespace kerf::app
