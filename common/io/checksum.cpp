#include "common/io/checksum.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace talus::io {

std::string checksum(const std::string& contents) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : contents) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(hash));
  return digits.data();
}

}  // namespace talus::io
