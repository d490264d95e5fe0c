#include "verification/fuzz/values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "common/io/table.hpp"

namespace talus::fuzz {
namespace {

using nlohmann::json;

// What makes a run long stays small.
double most_of(const Option& option, const std::string& program, const std::string& model) {
  struct Cap {
    std::string option, program, model;  // empty: any
    double most;
  };
  static const std::vector<Cap> caps = {{"--elements", "manufactured", "space", 3},
                                        {"--elements", "manufactured", "", 9},
                                        {"--elements", "", "plane", 20},
                                        {"--elements", "", "space", 20},
                                        {"--elements", "", "", 200},
                                        {"--around", "", "", 24},
                                        {"--threads", "", "", 4},
                                        {"--repeat", "", "", 3},
                                        {"--max-points", "", "", 12},
                                        {"--max-iterations", "", "", 500}};
  const auto fits = [](const std::string& cap, const std::string& asked) {
    return cap.empty() || cap == asked;
  };
  const auto cap = std::ranges::find_if(caps, [&](const Cap& each) {
    return each.option == option.name && fits(each.program, program) && fits(each.model, model);
  });
  return cap == caps.end() ? option.upper : cap->most;
}

std::string printed(const char* format, double number) {
  char text[500];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

double number_inside(const Option& option, Random& random) {
  const double lower = option.lower, upper = std::min(option.upper, option.most);
  if (random.chance(0.15)) return random.chance(0.5) ? lower : upper;
  if (option.form == Form::whole) {
    const int number = random.whole(static_cast<int>(lower), static_cast<int>(upper));
    return option.name == "--around" ? number / 8 * 8 : number;
  }
  if (lower > 0 && upper / lower > 100 && random.chance(0.7))
    return std::clamp(random.magnitude(lower, upper), lower, upper);
  return random.real(lower, upper);
}

json as_meant(const Option& option, double number) {
  return option.form == Form::whole ? json(std::lround(number)) : json(number);
}

Value fair_number(const Option& option, Random& random) {
  const double number = number_inside(option, random);
  if (option.form == Form::whole)
    return {io::rounded(number, 12), Standing::fair, as_meant(option, number)};
  const char* const formats[] = {"%.17g", "%.3g", "%.6g", "%.4e", "%.5E", "%.20f"};
  std::string text = printed(random.one_of(formats), number);
  if (const double read = std::stod(text); read < option.lower || read > option.upper)
    text = printed("%.17g", number);
  return {text, Standing::fair, as_meant(option, std::stod(text))};
}

Value odd_number(const Option& option, Random& random) {
  const double number = std::stod(fair_number(option, random).text);
  const std::string plain = printed("%.17g", number);
  std::vector<Value> forms = {{"+" + plain}, {" " + plain}, {plain + " "}, {printed("%a", number)}};
  if (number >= 0) forms.insert(forms.end(), {{"00" + plain}, {"0" + plain}, {"0" + plain}});
  if (option.form == Form::whole && number > 0)
    forms.insert(forms.end(), {{plain + ".0"}, {plain + "e0"}, {plain + "0e-1"}, {plain + "."}});
  for (Value& form : forms) form.meaning = as_meant(option, number);
  if (option.name == "--angle") {
    const int degrees = random.whole(1, 40);
    forms = {{std::to_string(degrees) + "deg", {}, degrees * std::numbers::pi / 180}};
  }
  if (option.lower <= 0 && random.chance(0.3)) forms = {{"-0", {}, as_meant(option, 0)}};
  Value drawn = random.one_of(forms);
  drawn.standing = Standing::odd;
  return drawn;
}

std::string number_outside(const Option& option, Random& random) {
  const bool above = random.chance(0.5);
  if (option.form == Form::whole) {
    const double far[] = {1, 2, 1e3, 1e9, 1e12};
    return printed("%.0f",
                   above ? option.upper + random.one_of(far) : option.lower - random.one_of(far));
  }
  const double bound = above ? option.upper : option.lower, sign = above ? 1 : -1;
  const double size = std::max(std::abs(bound), 1e-30);
  const double by[] = {4e-16 * size, 1e-6 * size, size, 1e9 * size, 1e300};
  const double outside = bound + sign * random.one_of(by);
  return printed("%.17g", outside == bound ? std::nextafter(bound, sign * HUGE_VAL) : outside);
}

const char* const no_numbers[] = {
    "",     "nan",   "NaN",   "inf", "-inf",  "infinity", "1e400", "-1e400", "1e",   "e5",
    "-",    "1_000", "1 2",   "1;2", "1.5.2", "ten",      "0x",    "½",      "٣",    "5\n",
    "%d",   "$(id)", "5mm",   "5--", "1e5e5", "..",       "{}",    "null",   "true", "'5'",
    "\x01", "1:2:3", "--all", "1/3", "1,,5",  "5;",       "*",     "~",      "5 m",  "0b11"};

std::string no_number(const Option& option, Random& random) {
  if (random.chance(0.4)) return number_outside(option, random);
  if (option.form == Form::whole && random.chance(0.2)) return random.chance(0.5) ? "2.5" : "1,5";
  if (random.chance(0.05)) return std::string(400, '7');
  return random.one_of(no_numbers);
}

std::string joined(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : separator) + parts[i];
  return text;
}

// `count` numbers in a row; a wrong one has one number, or its separators, wrong.
Value draw_row(const Option& each, std::size_t count, const std::string& separator,
               Standing standing, Random& random) {
  std::vector<std::string> parts;
  Value row{"", standing, json::array()};
  for (std::size_t i = 0; i < count; ++i) {
    const Value number = fair_number(each, random);
    parts.push_back(number.text);
    row.meaning.push_back(number.meaning);
  }
  const std::size_t i = random.below(count);
  if (standing == Standing::odd) {
    const Value number = odd_number(each, random);
    parts[i] = number.text;
    row.meaning[i] = number.meaning;
  }
  row.text = joined(parts, separator);
  if (standing != Standing::wrong) return row;
  const std::string faults[] = {"",
                                separator,
                                row.text + separator,
                                separator + row.text,
                                separator + separator,
                                joined(parts, separator + separator)};
  if (random.chance(0.5)) {
    parts[i] = no_number(each, random);
    if (parts[i].empty() && count == 1) parts[i] = "x";
    row.text = joined(parts, separator);
  } else {
    row.text = count == 1 ? separator : random.one_of(faults);
  }
  return row;
}

Option whole(int lower, int upper) {
  return {.name = "",
          .form = Form::whole,
          .lower = static_cast<double>(lower),
          .upper = static_cast<double>(upper)};
}

Value draw_mesh(bool is_space, Standing standing, Random& random) {
  const std::size_t count = is_space ? 3 : 2;
  if (standing == Standing::wrong && random.chance(0.3)) {  // another number of numbers
    const char* const few[] = {"7", "7x", "x7", "7X10", "7*10", "7 x 10", "2x2x2x2", "x", "7×10"};
    return {random.one_of(few), standing};
  }
  Value mesh = draw_row(whole(1, is_space ? 4 : 11), count, "x", standing, random);
  if (standing == Standing::wrong) return mesh;
  // Not all may be read as it stands: an element across is enough, two up are.
  return mesh;
}

Value draw_sweep(const Option& loading, Standing standing, Random& random) {
  Value ends = draw_row(loading, 2, ":", standing, random);
  const int count = random.whole(2, 3);
  ends.text += ":" + std::to_string(count);
  if (standing == Standing::wrong) {
    const std::string faults[] = {
        ends.text,      "0.03:0.04",   "0.03:0.04:1",   "0.03:0.04:2:2", "",
        "0.03:0.04:-2", "0.03,0.04,2", "0.03:0.04:2.5", "0.03:0.04:2:"};
    ends.text = random.one_of(faults);
    return ends;
  }
  const double a = ends.meaning[0], b = ends.meaning[1];
  ends.meaning = json::array();
  for (int i = 0; i < count; ++i) ends.meaning.push_back(a + (b - a) * i / (count - 1));
  return ends;
}

Value draw_choice(const Option& option, Standing standing, Random& random) {
  const std::string choice = random.one_of(option.choices);
  if (standing == Standing::fair) return {choice, standing, choice};
  std::string capital = choice;
  capital[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(capital[0])));
  if (standing == Standing::odd) return {capital, standing, choice};
  const std::string wrong[] = {"",  choice + "x", choice.substr(1), choice + "," + choice,
                               "0", "foo",        choice + " -",    "*"};
  return {random.one_of(wrong), standing};
}

}  // namespace

Value draw_value(const Option& asked, const Program& program, Standing standing,
                 const std::string& model, Random& random) {
  Option option = asked;
  if (option.form == Form::whole) option.most = most_of(option, program.name, model);
  if (option.name == "--output") {
    const char* const folders[] = {"out", "a b", "deep/er/still", "it's", "µ(I)", "out/", "./out"};
    return {random.one_of(folders)};
  }
  switch (option.form) {
    case Form::choice:
      return draw_choice(option, standing, random);
    case Form::reals:
      return draw_row(option, 1 + random.below(2), ",", standing, random);
    case Form::whole:
    case Form::real:
      return standing == Standing::fair  ? fair_number(option, random)
             : standing == Standing::odd ? odd_number(option, random)
                                         : Value{no_number(option, random), standing};
    default:
      break;
  }
  // Text with a grammar of its own.
  if (option.name == "--elements") return draw_mesh(model == "space", standing, random);
  if (option.name == "--sweep") return draw_sweep(*program.find("--loading"), standing, random);
  if (option.name == "--friction") {
    Option each = option;
    each.form = Form::real;
    Value row = draw_row(each, 3, ",", standing, random);
    row.meaning = {{"mu_s", row.meaning[0]}, {"delta_mu", row.meaning[1]}, {"I0", row.meaning[2]}};
    if (standing == Standing::wrong && random.chance(0.2)) row.text = "0.4,0.3";
    return row;
  }
  return {random.one_of(no_numbers), Standing::odd};
}

std::string misspelt(const std::string& option, const Program& program, Random& random) {
  std::string name = option;
  for (int tries = 0; tries < 20 && program.find(name); ++tries) {
    name = option;
    const std::size_t i = 3 + random.below(std::max<std::size_t>(name.size() - 3, 1));
    switch (random.below(5)) {
      case 0:
        if (const auto dash = name.find('-', 2); dash != std::string::npos) name[dash] = '_';
        break;
      case 1:
        if (const auto s = name.find("isation"); s != std::string::npos) name[s + 1] = 'z';
        break;
      case 2:
        name[2] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[2])));
        break;
      case 3:
        if (i < name.size()) name.erase(i, 1);
        break;
      default:
        if (i < name.size()) name.insert(i, 1, name[i]);
    }
  }
  return program.find(name) ? "--frobnicate" : name;
}

}  // namespace talus::fuzz
