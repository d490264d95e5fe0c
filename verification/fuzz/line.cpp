#include "verification/fuzz/line.hpp"

#include <algorithm>
#include <cctype>

namespace talus::fuzz {
namespace {

using Arguments = std::vector<std::string>;

// Where a parameter is not called like its option.
std::string key_of(const std::string& option) {
  const std::pair<const char*, const char*> others[] = {{"--loading", "loadings"},
                                                        {"--sweep", "loadings"}};
  for (const auto& [name, key] : others)
    if (option == name) return key;
  std::string key = option.substr(2);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

struct Flag {
  const char *name, *key;
  nlohmann::json value;
};
const Flag flags[] = {{"--full", "domain", "full"},
                      {"--no-inertia", "inertia", false},
                      {"--no-pressure-regularisation", "regularises_pressure", false}};

// What keeps a run short, where the line does not say otherwise.
struct Small {
  const char *program, *unless, *option, *value;
};
constexpr Small small[] = {{"heap", "--elements", "--elements", "4x5"},
                           {"manufactured", "--elements", "--elements", "3"},
                           {"cylinder", "--around", "--around", "16"},
                           {"cylinder", "--loading", "--loading", "0.02"},
                           {"cylinder", "--lambda-r", "--lambda-r", "1e-3"},
                           {"cylinder", "--max-points", "--max-points", "6"},
                           {"verify", "--list", "--list", nullptr}};

class Drawing {
 public:
  Drawing(const Program& program, Random& random) : program_(program), random_(random) {}

  void choose(std::size_t count) {
    for (const Option& option : program_.options) chosen_.push_back(&option);
    random_.shuffle(chosen_);
    chosen_.resize(std::min(count, chosen_.size()));
  }

  // The model decides what the other options may say.
  void choose_model_first() {
    std::ranges::stable_partition(chosen_, [](const Option* o) { return o->name == "--model"; });
  }
  void leave_out(const std::vector<std::string>& names) {
    std::erase_if(chosen_, [&](const Option* option) {
      return std::ranges::find(names, option->name) != names.end();
    });
  }

  // Each option with its value; `worst` for one of them, fair for the others.
  void give_values(Standing worst) {
    const std::size_t one = random_.below(std::max<std::size_t>(chosen_.size(), 1));
    for (std::size_t i = 0; i < chosen_.size(); ++i)
      give(*chosen_[i], i == one ? worst : Standing::fair);
  }

  // An option that is not there, or not as it should be.
  void add_mistake() {
    const Option& option = random_.one_of(program_.options);
    switch (random_.below(4)) {
      case 0: {
        const std::string name = misspelt(option.name, program_, random_);
        add({name}, Standing::wrong, {name, name == "--frobnicate" ? "" : option.name});
        break;
      }
      case 1: {
        const char* const strays[] = {"surplus", "results", "0.3x", "out.csv"};
        const std::string stray = random_.one_of(strays);
        add({stray}, Standing::wrong, {stray});
        break;
      }
      case 2:  // without its value, if it needs one
        if (option.form == Form::flag || option.name == "--align" || has(option)) return;
        add({option.name}, Standing::wrong, {option.name});
        break;
      default:  // with more of them than it takes
        if ((option.form != Form::whole && option.form != Form::real) || has(option)) return;
        const Value value = draw_value(option, program_, Standing::fair, model_, random_);
        if (random_.chance(0.5))
          add({option.name, value.text, "20", "40"}, Standing::wrong, {"20", "40"});
        else
          add({option.name, value.text, option.name, value.text}, Standing::wrong, {option.name});
    }
  }

  Line line() {
    for (const auto& [program, unless, option, value] : small) {
      const Option* known = program_.find(option);
      if (program_.name != program || !known || names(unless) ||
          (std::string(option) == "--loading" && names("--sweep")))
        continue;
      if (value == nullptr)
        add({option});
      else
        add({option, model_ == "space" && program_.name == "heap" ? "1x2x3" : value});
    }
    random_.shuffle(pieces_);
    for (const Arguments& piece : pieces_)
      line_.arguments.insert(line_.arguments.end(), piece.begin(), piece.end());
    return std::move(line_);
  }

 private:
  bool names(const std::string& option) const {
    return std::ranges::any_of(pieces_, [&](const Arguments& piece) {
      return piece.front() == option || piece.front().starts_with(option + "=");
    });
  }
  bool has(const Option& option) const { return names(option.name); }

  void add(Arguments piece, Standing standing = Standing::fair, Arguments fault = {}) {
    pieces_.push_back(std::move(piece));
    line_.standing = std::max(line_.standing, standing);
    if (!fault.empty()) line_.faults.push_back(std::move(fault));
  }

  void give(const Option& option, Standing standing) {
    if (option.form == Form::flag) {
      for (const auto& [name, key, value] : flags)
        if (option.name == name) line_.meant[key] = value;
      return add({option.name});
    }
    const Value value = draw_value(option, program_, standing, model_, random_);
    if (option.name == "--model") model_ = value.text;
    if (option.name == "--output") line_.output = value.text;
    if (!value.meaning.is_null() && value.standing != Standing::wrong)
      line_.meant[key_of(option.name)] = value.meaning;
    const bool apart = random_.chance(0.7);
    Arguments fault;
    if (value.standing != Standing::fair) {
      fault = {option.name};
      // Taken for an option, or for none, a value need not be named.
      const bool looks_like_option = apart && value.text.starts_with('-') &&
                                     (value.text.size() < 2 || !std::isdigit(value.text[1]));
      const bool is_printed =
          std::ranges::all_of(value.text, [](char c) { return c < 0 || c >= ' '; });
      const bool is_whole = option.form != Form::reals && option.form != Form::text;
      if (is_whole && is_printed && !looks_like_option && !value.text.empty()) {
        fault.push_back(value.text);
        fault.push_back(option.range);
      }
    }
    if (apart)
      add({option.name, value.text}, value.standing, fault);
    else
      add({option.name + "=" + value.text}, value.standing, fault);
  }

  const Program& program_;
  Random& random_;
  std::vector<const Option*> chosen_;
  std::vector<Arguments> pieces_;  // an option with its value, each
  std::string model_;
  Line line_;
};

}  // namespace

bool Line::has(const std::string& argument) const {
  return std::ranges::find(arguments, argument) != arguments.end();
}

Line draw_line(const Program& program, Random& random) {
  Drawing drawing(program, random);
  drawing.choose(random.below(6));
  drawing.choose_model_first();
  const double share = random.share();
  drawing.give_values(share < 0.45   ? Standing::fair
                      : share < 0.65 ? Standing::odd
                      : share < 0.85 ? Standing::wrong
                                     : Standing::fair);
  if (share >= 0.85) drawing.add_mistake();
  return drawing.line();
}

Line draw_fair_line(const Program& program, Random& random) {
  Drawing drawing(program, random);
  drawing.choose(random.below(5));
  drawing.leave_out({"--check-jacobian", "--tangent", "--output", "--resume", "--sweep"});
  drawing.choose_model_first();
  drawing.give_values(Standing::fair);
  return drawing.line();
}

}  // namespace talus::fuzz
