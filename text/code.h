// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace kerf::text {

/// The number of an error or warning: 412 is `E0412`, as a warning `W0412`. text/codes.h lists the enumerators; a new
/// one then compiles only the files that name a code.
enum class Code : int;

}  // namespace kerf::text
