// Whether this processor can run what was built.
#pragma once

namespace talus::io {

/// Ends the process with one line and exit code 1 where the build uses vector instructions that the
/// processor does not have. Already done before main(): nothing else of the program could say so.
void require_processor();

}  // namespace talus::io
