// SPDX-License-Identifier: Apache-2.0
// In place of hidapi_transport.cpp, in a build without hidapi.
#include "devices/hid/hid_transport.h"

namespace kerf::hid {

std::unique_ptr<HidTransport> make_hidapi_transport() { return nullptr; }
std::string hidapi_version() { return {}; }

}  // namespace kerf::hid
