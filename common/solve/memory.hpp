// How much memory there is, and what is thrown when it is not enough.
#pragma once

#include <new>
#include <string>

namespace talus::solve {

/// Bytes that the process can still take: the least of what the machine has to give (MemAvailable)
/// and what is left of its control groups, of RLIMIT_AS and of RLIMIT_DATA. Infinite where nothing
/// of that can be read.
double available_memory();

/// "1.3 GB", two digits.
std::string in_gigabytes(double bytes);

/// What memory was wanted for, how much of it, and how much there is. Not an end that a solver
/// returns: nothing that it could still try takes less.
class OutOfMemory : public std::bad_alloc {
 public:
  OutOfMemory(const std::string& purpose, double bytes);
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

/// Throws OutOfMemory if so many bytes are more than there are. The system would hand them out all
/// the same, and end the process once they are used.
void require_memory(const std::string& purpose, double bytes);

}  // namespace talus::solve
