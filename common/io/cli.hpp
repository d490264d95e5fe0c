// CLI11's names for our headers. Whoever calls it includes CLI/CLI.hpp, which takes seconds to
// translate.
#pragma once

namespace CLI {
class App;
class Option;
}  // namespace CLI
