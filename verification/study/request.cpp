#include "verification/study/request.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "common/io/options.hpp"
#include "verification/harness/process.hpp"
#include "verification/study/option_values.hpp"

namespace talus::study {
namespace {

using nlohmann::json;

std::filesystem::path folder_of_programs() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

// Programs that are no scene's.
const std::set<std::string> tools = {"verify", "fuzz", "mutants", "study"};

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_of_programs())) {
    const std::string name = entry.path().filename().string();
    if (!tools.contains(name) && name.find("test") == std::string::npos) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

const json* named(const json& list, const std::string& name) {
  const auto found =
      std::ranges::find_if(list, [&](const json& each) { return each.at("name") == name; });
  return found == list.end() ? nullptr : &*found;
}

process::Outcome ask(const Program& program, std::vector<std::string> words,
                     const std::string& question) {
  words.push_back(question);
  return process::run({program.path, std::move(words), std::filesystem::temp_directory_path()});
}

// "heap: --start: not used by ..." names the option that a case has no use for.
std::string unused_option(const std::string& complaint) {
  const std::size_t from = complaint.find("--"), to = complaint.find(": not used by ");
  return from < to && to != std::string::npos ? complaint.substr(from, to - from) : "";
}

// Cases run beside each other, not their parts.
const std::pair<std::string, std::string> threads{"--threads", "1"};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

const json* Program::option(const std::string& name) const {
  return named(description.at("options"), name);
}

const json* Program::quantity(const std::string& name) const {
  return named(description.at("quantities"), name);
}

Program program_of(const std::string& scene) {
  std::string known;
  const auto names = scenes();
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  if (std::ranges::find(names, scene) == names.end())
    throw io::UserError("SCENE: '" + scene + "' is none of: " + known +
                        io::did_you_mean(scene, names));
  Program program{folder_of_programs() / scene, {}};
  const process::Outcome outcome = ask(program, {}, "--describe");
  program.description = json::parse(outcome.out, nullptr, false);
  if (!outcome.is_success() || !program.description.is_object())
    throw io::UserError("SCENE: '" + scene + "' does not describe itself");
  return program;
}

std::vector<Varied> varied_options(const Program& program, const std::vector<std::string>& words) {
  std::vector<Varied> all;
  std::vector<std::string> names;
  for (const json& option : program.description.at("options")) names.push_back(option.at("name"));
  const std::set<std::string> ours = {"--record", "--output",  "--plot",    "--check-jacobian",
                                      "--resume", "--dry-run", "--describe"};
  for (std::size_t at = 0; at < words.size();) {
    const std::string& word = words[at++];
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const json* option = program.option(name);
    if (name.rfind("--", 0) != 0) throw io::UserError("'" + word + "' belongs to no option");
    if (!option)
      throw io::UserError(name + ": there is no such option of study, nor of " + program.name() +
                          io::did_you_mean(name, names));
    if (ours.contains(name)) throw io::UserError(name + ": a study has no use for it");
    if (std::ranges::any_of(all, [&](const Varied& each) { return each.name == name; }))
      throw io::UserError(name + ": it is given twice");
    if (option->at("type") == "FLAG") {
      if (equals != std::string::npos) throw io::UserError(name + ": it takes no value");
      all.push_back({name, {""}});
      continue;
    }
    if (equals == std::string::npos && at == words.size())
      throw io::UserError(name + ": its value is missing");
    const std::string text = equals == std::string::npos ? words[at++] : word.substr(equals + 1);
    all.push_back({name, values_of(name, option->at("type"), text)});
  }
  return all;
}

std::vector<Options> combinations(const std::vector<Varied>& varied) {
  constexpr std::size_t most = 10000;
  std::vector<Options> all{{}};
  for (const auto& [name, values] : varied) {
    if (all.size() * values.size() > most)
      throw io::UserError(name + ": more than " + std::to_string(most) + " cases in all");
    std::vector<Options> longer;
    for (const Options& options : all)
      for (const std::string& value : values) {
        longer.push_back(options);
        longer.back().emplace_back(name, value);
      }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::string> words_of(const Options& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : options) {
    words.push_back(name);
    if (!value.empty()) words.push_back(value);
  }
  return words;
}

std::vector<Options> possible(const Program& program, const std::vector<Options>& combinations) {
  std::vector<Options> all;
  std::set<std::string> used;
  std::set<std::pair<std::string, Options>> unused;  // a name, and the options beside it
  std::map<std::string, std::string> complaints;     // about those that are not used
  const auto without = [](Options options, const std::string& name) {
    std::erase_if(options, [&](const auto& each) { return each.first == name; });
    return options;
  };
  for (Options options : combinations) {
    const bool is_told =
        std::ranges::any_of(options, [](const auto& each) { return each.first == threads.first; });
    if (program.option(threads.first) && !is_told) options.push_back(threads);
    while (std::ranges::find(all, options) == all.end()) {
      // What an option that is not used would be does not matter.
      const auto known = std::ranges::find_if(options, [&](const auto& each) {
        return unused.contains({each.first, without(options, each.first)});
      });
      if (known != options.end()) {
        options.erase(known);
        continue;
      }
      const process::Outcome outcome = ask(program, words_of(options), "--dry-run");
      if (outcome.is_success()) {
        for (const auto& [name, _] : options) used.insert(name);
        all.push_back(options);
        break;
      }
      const std::string complaint = first_line(outcome.err), name = unused_option(complaint);
      const Options others = without(options, name);
      if (others.size() == options.size()) throw io::UserError(complaint);
      complaints[name] = complaint;
      unused.insert({name, others});
      options = others;
    }
  }
  for (const auto& [name, _] : combinations.front())
    if (!used.contains(name) && name != threads.first) throw io::UserError(complaints[name]);
  return all;
}

}  // namespace talus::study
