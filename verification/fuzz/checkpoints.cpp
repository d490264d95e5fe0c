// Damaged checkpoints, and those of other runs: refused, or of no effect on the digits.
#include <cmath>
#include <fstream>
#include <limits>

#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

Arguments draw_run(Random& random, const std::string& around) {
  const char* const loadings[] = {"0.01,0.02", "0.015,0.03", "0.02", "0.025,0.01"};
  const char* const laws[] = {"chauchat-medale", "papanastasiou", "barker-gray"};
  const char* const lambdas[] = {"1e-2", "1e-3"};
  const char* const ways[] = {"primal-dual", "arclength", "natural"};
  return {"--around",         around,
          "--loading",        random.one_of(loadings),
          "--regularisation", random.one_of(laws),
          "--lambda-r",       random.one_of(lambdas),
          "--continuation",   random.one_of(ways)};
}

void put_digit(std::string& bytes, std::size_t from, std::size_t to, Random& random) {
  for (int tries = 0; tries < 1000; ++tries) {
    char& c = bytes[from + random.below(to - from)];
    if (c < '0' || c > '9') continue;
    c = static_cast<char>('0' + (c - '0' + random.whole(1, 9)) % 10);
    return;
  }
}

// Damages the bytes in one of many ways, and says how.
std::string damage(std::string& bytes, Random& random) {
  const std::size_t size = bytes.size(), at = random.below(size);
  const std::size_t header = std::min(bytes.find('\n'), size - 1);
  const std::size_t number =
      header + 1 + 8 * random.below(std::max<std::size_t>((size - header - 1) / 8, 1));
  const auto put = [&](std::size_t place, double value) {
    if (place + sizeof value <= size)
      bytes.replace(place, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
  };
  switch (random.below(11)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
      return "a bit flipped at byte " + std::to_string(at);
    case 1: {
      const std::size_t place = random.below(std::min(header, size));
      bytes[place] = static_cast<char>(bytes[place] ^ (1 << random.below(8)));
      return "a bit flipped in the header at byte " + std::to_string(place);
    }
    case 2:
      bytes.resize(at);
      return "cut to " + std::to_string(at) + " bytes";
    case 3:
      bytes += std::string(static_cast<std::size_t>(random.whole(1, 64)),
                           random.chance(0.5) ? '\0' : 'x');
      return "bytes appended";
    case 4:
      std::swap(bytes[at], bytes[random.below(size)]);
      return "two bytes swapped";
    case 5:
      put_digit(bytes, 0, header, random);
      return "a digit of the header changed";
    case 6:
      put(number, std::numeric_limits<double>::quiet_NaN());
      return "a NaN at byte " + std::to_string(number);
    case 7:
      for (std::size_t place = header + 1; place + 8 <= size; place += 8)
        put(place, std::numeric_limits<double>::quiet_NaN());
      return "NaN throughout";
    case 8:
      put(number, random.chance(0.5) ? 1e300 : 1.0);
      return "another number at byte " + std::to_string(number);
    case 9:
      bytes.erase(at, static_cast<std::size_t>(random.whole(1, 16)));
      return "bytes lost at " + std::to_string(at);
    default:
      bytes = random.chance(0.3) ? "" : bytes.substr(0, header + 1);
      return "nothing left but its header";
  }
}

}  // namespace

void try_checkpoint(Trial& trial) {
  // 1. A run, whole; and the checkpoint of one that was interrupted.
  const Arguments run = draw_run(trial.random, "16");
  const Outcome whole = trial.run(trial.command("cylinder", run, "whole"));
  Arguments begun = run;
  const bool is_other = trial.random.chance(0.15);  // of another run
  if (is_other) begun = draw_run(trial.random, trial.random.chance(0.5) ? "24" : "16");
  begun.insert(begun.end(), {"--max-points", std::to_string(trial.random.whole(2, 6))});
  trial.run(trial.command("cylinder", begun, "resumed"));

  // 2. The damage.
  const fs::path file = trial.folder / "resumed/results/cylinder/checkpoint.bin";
  if (!fs::exists(file)) return trial.ended("no checkpoint");
  std::string bytes = contents_of(file);
  const std::string intact = bytes;
  std::string what = "none";
  if (!is_other && !trial.random.chance(0.1)) {
    what = damage(bytes, trial.random);
    std::ofstream(file, std::ios::binary) << bytes;
  }
  trial.note(": " + shell_word("checkpoint.bin: " + what));
  const auto before = listing(trial.folder / "resumed");

  // 3. Refused in a line, or the digits of the run that was not interrupted.
  Arguments again = run;
  again.push_back("--resume");
  const Outcome resumed = trial.run(trial.command("cylinder", again, "resumed"));
  const bool is_damaged = bytes != intact;
  if (resumed.code == 2) {
    trial.ended(is_other ? "other run refused" : "damage refused");
    judge_refusal(trial, resumed);
    trial.expect(is_other || is_damaged, "refused though intact: " + beginning(resumed.err));
    trial.expect(resumed.err.find("--resume") != std::string::npos ||
                     resumed.err.find("checkpoint") != std::string::npos,
                 "the refusal does not speak of the checkpoint: " + beginning(resumed.err));
    trial.expect(before == listing(trial.folder / "resumed"),
                 "refused, but files were written or removed");
    return;
  }
  trial.ended(std::string(is_damaged ? "damage"
                          : is_other ? "other run"
                                     : "intact") +
              (resumed.is_success() ? ", taken" : ", not solved"));
  if (!trial.expect(resumed.code == whole.code,
                    "exit code " + std::to_string(resumed.code) + ", " +
                        std::to_string(whole.code) +
                        " when not interrupted: " + beginning(resumed.err)))
    return;
  const auto results = [&](const char* subfolder) {
    return json_in(trial.folder / subfolder / "results/cylinder/summary.json");
  };
  const auto a = results("whole"), b = results("resumed");
  // Where only the way of continuation was another, the flow is the same, not its last digits.
  const auto drag = [](const nlohmann::json& summary) {
    return summary.is_object() ? summary["results"].value("drag", NAN) : NAN;
  };
  const bool same = is_other ? std::abs(drag(a) - drag(b)) < 1e-8 * drag(a)
                             : a.is_object() && b.is_object() && a["results"] == b["results"] &&
                                   a["sweep"] == b["sweep"];
  trial.expect(same, "other digits than when not interrupted (" + what + ")");
}

}  // namespace talus::fuzz
