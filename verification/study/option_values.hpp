// Lists and ranges of option values, as `study` takes them for any option of a scene.
#pragma once

#include <string>
#include <vector>

namespace talus::study {

/// The values that a text stands for, in its order, as they are typed for one case:
///   5,10,20      a list; every part may itself be a range
///   A:B:N        N values from A to B
///   A:B:+d       A, A + d, A + 2d ... up to B (d may be negative: A:B:-d)
///   A:B:xk       A, A k, A k² ... up to B; of meshes (9x13:72x104:x2) each count
///   A:B:/k       A, A/k, A/k² ... down to B
/// `type` is that of --describe: INT, FLOAT and ANGLE have ranges, MESH has those by factors, NAME
/// lists alone; anything else is one value. Throws io::UserError naming the option for a range that
/// leads nowhere or gives a value twice.
std::vector<std::string> values_of(const std::string& option, const std::string& type,
                                   const std::string& text);

}  // namespace talus::study
