#include "common/io/svg_geometry.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>

namespace talus::io {
namespace {

// A whole number of tenths or hundredths as SVG takes it shortest: -35 tenths are "-3.5".
std::string decimal(long value, long parts) {
  std::string digits = std::to_string(std::labs(value) % parts);
  digits.insert(0, std::to_string(parts).size() - 1 - digits.size(), '0');
  digits.erase(digits.find_last_not_of('0') + 1);
  const long whole = std::labs(value) / parts;
  std::string text = whole > 0 || digits.empty() ? std::to_string(whole) : "";
  if (!digits.empty()) text += "." + digits;
  return (value < 0 ? "-" : "") + text;
}

// Two numbers; a sign parts as well as a space does.
std::string pair(long x, long y) {
  const std::string second = decimal(y, 10);
  return decimal(x, 10) + (y < 0 ? "" : " ") + second;
}

// Path data of absolute moves and lines, relative from the second point on, or nothing if there is
// anything else in it.
std::optional<std::string> relative_path(const std::string& data) {
  std::string result;
  long x = 0, y = 0;
  char command = 0, last = 0;  // of the data; written last
  const char* at = data.c_str();
  const auto skip = [&] { at += std::strspn(at, " \n,"); };
  const auto number = [&]() -> std::optional<long> {  // in tenths
    skip();
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) return {};
    at = end;
    return std::lround(10 * value);
  };
  for (skip(); *at != 0; skip()) {
    if (*at == 'Z' || *at == 'z') {  // only at the end: what follows would start elsewhere
      ++at;
      skip();
      return *at == 0 ? std::optional(result + 'z') : std::nullopt;
    }
    if (*at == 'M' || *at == 'L') command = *at++;
    const std::optional<long> next_x = number(), next_y = number();
    if (command == 0 || !next_x || !next_y) return {};
    const long dx = *next_x - x, dy = *next_y - y;
    x = *next_x;
    y = *next_y;
    if (command == 'L' && dx == 0 && dy == 0) continue;
    const char next = result.empty()   ? 'M'
                      : command == 'M' ? 'm'
                      : dy == 0        ? 'h'
                      : dx == 0        ? 'v'
                                       : 'l';
    if (next != 'l' || last != 'l')
      result += next;
    else if (dx >= 0)
      result += ' ';
    result += next == 'h' ? decimal(dx, 10) : next == 'v' ? decimal(dy, 10) : pair(dx, dy);
    last = next;
    command = 'L';  // what further points after a move are
  }
  return result;
}

// `text` with what is between `from` and `to` replaced, wherever there is a replacement.
std::string replaced(const std::string& text, const std::string& from, const std::string& to,
                     const std::function<std::optional<std::string>(const std::string&)>& by) {
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, done)) {
    const std::size_t begin = at + from.size(), end = text.find(to, begin);
    if (end == std::string::npos) break;
    const std::string inside = text.substr(begin, end - begin);
    result += text.substr(done, begin - done) + by(inside).value_or(inside);
    done = end;
  }
  return result + text.substr(done);
}

// <polygon points='...'/> as a closed path.
std::string polygons_as_paths(const std::string& svg) {
  std::string result = svg;
  for (std::size_t at = result.find("<polygon "); at != std::string::npos;
       at = result.find("<polygon ", at)) {
    const std::size_t points = result.find(" points='", at), end = result.find("'/>", at);
    if (points == std::string::npos || end == std::string::npos || points > end) return svg;
    result.insert(end, "Z");
    result.replace(points, 9, " d='M");
    result.replace(at, 8, "<path");
  }
  return result;
}

// A mark: a line of its own, alone or the next of several.
struct Mark {
  char shape[16] = "", colour[16] = "";
  double x = 0, y = 0, scale = 0;

  static std::optional<Mark> of(const std::string& line) {
    Mark mark;
    int length = 0;
    const int found = std::sscanf(
        line.c_str(),
        "<use xlink:href='#%15[^']' transform='translate(%lf,%lf) scale(%lf)' color='%15[^']'/>%n",
        mark.shape, &mark.x, &mark.y, &mark.scale, mark.colour, &length);
    if (found != 5 || length != static_cast<int>(line.size())) return {};
    return mark;
  }
  std::string group() const {
    char text[80];
    std::snprintf(text, sizeof text, "<g transform='scale(%g)' color='%s'>", scale, colour);
    return text;
  }
  std::string placed() const {
    return std::string("<use xlink:href='#") + shape + "' x='" +
           decimal(std::lround(100 * x / scale), 100) + "' y='" +
           decimal(std::lround(100 * y / scale), 100) + "'/>";
  }
};

std::string with_grouped_marks(const std::string& svg) {
  std::string result, open;
  for (std::size_t at = 0; at < svg.size();) {
    const std::size_t end = std::min(svg.find('\n', at), svg.size());
    const std::string line = svg.substr(at, end - at);
    const std::optional<Mark> mark = Mark::of(line);
    const std::string group = mark ? mark->group() : "";
    if (group != open) {
      if (!open.empty()) result += "</g>\n";
      if (!group.empty()) result += group + "\n";
      open = group;
    }
    result += mark ? mark->placed() : line;
    if (end < svg.size()) result += '\n';
    at = end + 1;
  }
  return result;
}

// A text in a group that does nothing but place it, as a text at that place.
std::string with_placed_texts(const std::string& svg) {
  static const std::string start = "<g transform=\"translate(", text = ">\n<text>",
                           end = "</text>\n</g>";
  std::string result;
  std::size_t done = 0;
  for (std::size_t at = svg.find(start); at != std::string::npos; at = svg.find(start, at + 1)) {
    double x = 0, y = 0;
    int length = 0;
    const std::size_t closed = svg.find(text, at), ends = svg.find(end, at);
    if (std::sscanf(svg.c_str() + at + start.size(), "%lf,%lf)\"%n", &x, &y, &length) != 2 ||
        length == 0 || ends == std::string::npos || closed != svg.find(">\n", at))
      continue;
    const std::size_t attributes = at + start.size() + static_cast<std::size_t>(length);
    result += svg.substr(done, at - done) + "<text x='" + decimal(std::lround(10 * x), 10) +
              "' y='" + decimal(std::lround(10 * y), 10) + "'" +
              svg.substr(attributes, closed - attributes) + ">" +
              svg.substr(closed + text.size(), ends - closed - text.size()) + "</text>";
    done = ends + end.size();
  }
  return result + svg.substr(done);
}

}  // namespace

std::string with_short_geometry(const std::string& svg) {
  static const std::string end_of_marks = "</defs>";
  const std::size_t defined = svg.find(end_of_marks);
  const std::size_t from = defined == std::string::npos ? 0 : defined + end_of_marks.size();
  const std::string drawn =
      replaced(polygons_as_paths(svg.substr(from)), " d='", "'", relative_path);
  return svg.substr(0, from) + with_placed_texts(with_grouped_marks(drawn));
}

}  // namespace talus::io
