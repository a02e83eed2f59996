// SPDX-License-Identifier: Apache-2.0
// A build without hidapi compiles this file instead of hidapi_transport.cpp.
#include "devices/hid/hid_transport.h"

namespace kerf::hid {

std::unique_ptr<HidTransport> make_hidapi_transport() { return nullptr; }
std::string hidapi_version() { return {}; }

}  // namespace kerf::hid
