// A checksum of contents, and a name made of them.
#pragma once

#include <string>

namespace talus::io {

/// FNV-1a of 64 bits, in hexadecimal: one changed byte always changes it.
std::string checksum(const std::string& contents);

}  // namespace talus::io
