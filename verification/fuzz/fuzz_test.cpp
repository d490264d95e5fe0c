// What the fuzz stands on; and the fuzz on programs that are broken, each in some ways: it has to
// say so, and only then.
#include <fstream>
#include <set>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "verification/fuzz/campaign.hpp"
#include "verification/fuzz/folder.hpp"

BOOST_AUTO_TEST_SUITE(fuzz_test)

using namespace talus;
namespace fs = std::filesystem;

namespace {

fs::path programs() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

using Faults = std::vector<fuzz::Finding>;

long times(const std::string& fault, const Faults& faults) {
  return std::ranges::count_if(faults, [&](const fuzz::Finding& finding) {
    return finding.fault.find(fault) != std::string::npos;
  });
}

// The programs behind scripts that do something to them: `script` finds the real program in $real.
// Of the others there is the help alone.
class Broken {
 public:
  Broken(const std::string& which, const std::string& script) {
    const std::string refusal = "echo 'not here: the help is all there is' >&2; exit 2";
    std::string name = (fs::temp_directory_path() / "talus_fuzz_test_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    for (const char* each : {"chute", "bagnold", "heap", "cylinder", "manufactured", "verify"}) {
      std::ofstream(folder_ / each)
          << "#!/bin/bash\nreal=" << (programs() / each).string() << "\nname=" << each
          << "\n[ \"${!#}\" = --help ] && exec $real --help\n"
          << (which.find(each) == std::string::npos ? refusal : script) << '\n';
      fs::permissions(folder_ / each, fs::perms::owner_all);
    }
  }
  ~Broken() { fs::remove_all(folder_); }
  Broken(const Broken&) = delete;
  Broken& operator=(const Broken&) = delete;

  Faults faults(const std::string& kind, int count) const {
    fuzz::CampaignOptions options;
    options.seed = 2;
    for (const fuzz::Kind& each : fuzz::kinds())
      if (each.name == kind) options.kinds.push_back(each);
    options.count = count;
    options.jobs = 1;
    options.time_limit = 200;  // sanitised programs are slow; one that hangs has a limit of its own
    std::ostringstream out;
    return fuzz::campaign(options, folder_, out).faults;
  }

 private:
  fs::path folder_;
};

// What a script does to the programs, and all that is to be said of it.
struct Damage {
  const char* script;
  std::vector<std::string> faults;
};

// The programs as they are must be blamed for none of it.
void check_that_it_tells(const std::string& kind, int count, const std::string& which,
                         const std::vector<Damage>& damages) {
  const Faults blamed = Broken(which, "exec $real \"$@\"").faults(kind, count);
  for (const auto& [script, told] : damages) {
    const Faults faults = Broken(which, script).faults(kind, count);
    for (const std::string& fault : told) {
      BOOST_TEST(times(fault, faults) > 0, kind << ": '" << fault << "' is not told of " << script);
      BOOST_TEST(times(fault, blamed) == 0,
                 kind << ": '" << fault << "' is told of honest programs");
    }
  }
}

// After the real program, in the folder of its run; its exit code is $code.
#define AFTER(commands) "$real \"$@\"; code=$?; { " commands "; } 2>&-; exit $code"

}  // namespace

BOOST_AUTO_TEST_CASE(options_are_read_from_the_help_of_a_program) {
  const auto options = fuzz::options_in(
      "Flow\nUsage: flow [OPTIONS]\n\nOptions:\n"
      "  -h,--help                   Print this help message and exit\n"
      "  --elements INT=40           Quadratic elements [1 ... 100000]\n"
      "  --angle ANGLE=0.41 Excludes: --flow-rate\n"
      "                              Inclination [0.001 ... 1.57]\n"
      "  --method TEXT=newton        Newton or not [newton, interior-point]\n"
      "  --loading FLOAT=[0.054] ... Excludes: --sweep\n"
      "                              Loadings, one or several [each 1e-06 ... 0.07]\n"
      "  --no-inertia{false}         Leave it out\n");
  BOOST_REQUIRE(options.size() == 5);
  BOOST_TEST(options[0].name == "--elements");
  BOOST_TEST((options[0].form == fuzz::Form::whole && options[0].upper == 100000));
  BOOST_TEST((options[1].form == fuzz::Form::real && options[1].lower == 0.001));
  BOOST_TEST(options[1].standard == "0.41");
  BOOST_TEST((options[2].form == fuzz::Form::choice && options[2].choices.size() == 2));
  BOOST_TEST((options[3].form == fuzz::Form::reals && options[3].standard == "0.054"));
  BOOST_TEST((options[4].name == "--no-inertia" && options[4].form == fuzz::Form::flag));
}

BOOST_AUTO_TEST_CASE(a_line_is_drawn_from_its_seed_kind_and_number_alone) {
  const fuzz::Program heap = fuzz::read_program(programs() / "heap");
  const auto line = [&](std::uint64_t seed, const char* kind, int number) {
    fuzz::Random random(seed, kind, number);
    return fuzz::draw_line(heap, random).arguments;
  };
  for (int i = 0; i < 20; ++i) BOOST_TEST(line(1, "commands", i) == line(1, "commands", i));
  std::set<std::vector<std::string>> lines;
  for (int i = 0; i < 50; ++i)
    lines.insert({line(1, "commands", i), line(2, "commands", i), line(1, "cross", i)});
  BOOST_TEST(lines.size() > 100);  // all that there are if seed or kind did not count
}

BOOST_AUTO_TEST_CASE(a_script_can_be_pasted_into_a_shell) {
  const std::vector<std::string> words = {"plain", "", "it's", "a b", "$HOME", "new\nline\\'", "µ"};
  std::string command = "printf '<%s>'", expected;
  for (const std::string& word : words) {
    command += " " + fuzz::shell_word(word);
    expected += "<" + word + ">";
  }
  BOOST_TEST(process::run({"/bin/bash", {"-c", command}, "/"}).out == expected);
}

BOOST_AUTO_TEST_CASE(a_word_is_told_from_a_number_that_is_none) {
  for (const char* text :
       {"velocity nan", "1,2,NaN\n", "-inf", "gap inf.\n", "<x>nan</x>", "(nan)"})
    BOOST_TEST(fuzz::has_no_number(text));
  for (const char* text : {"nanometres", "information", "at infinite", "finance", "1e300", ""})
    BOOST_TEST(!fuzz::has_no_number(text));
}

BOOST_AUTO_TEST_CASE(every_fault_of_a_command_line_is_told) {
  check_that_it_tells(
      "commands", 40, "chute bagnold",
      {{"case $# in 5|6|7|8) ulimit -St 1; while :; do :; done;; 3|4) kill -SEGV $$;; esac; exec "
        "$real "
        "\"$@\"",
        {"did not end", "crashed"}},
       {AFTER("[ $code = 0 ] && echo velocity nan; cd results/$name || exit $code;"
              "sed -i 's/\"error_l2\": .*/\"error_l2\": null,/' summary.json;"
              "sed -i '/\"parameters\"/,/^  }/s/: \\([0-9]\\)/: 7\\1/' summary.json;"
              "truncate -s -5 newton.csv; echo x >.x.part;"
              "sed -i '$s/^[^,]*,/inf,/' profile.csv; touch -d '2 hours ago' profile.csv"),
        {"nan or inf on stdout", "null in", "misread", "torn file", "left behind", "nan or inf in",
         "stale"}},
       {"$real \"$@\"; exit 0", {"wrong input, exit code 0"}},
       {"$real \"$@\" && exit 1; touch left; echo another line >&2; exit 2",
        {"named end", "files were written", "without one line"}}});
}

BOOST_AUTO_TEST_CASE(two_runs_that_should_agree_and_do_not_are_told) {
  check_that_it_tells(
      "cross", 14, "chute bagnold heap",
      {{AFTER("for table in results/*/*.csv; do echo $RANDOM >>$table; done;"
              "case \"$*\" in *interior-point*|*e-10*|*newton*) sed -i "
              "'s/_velocity\": [1-9]/&1/; s/flow_rate\": [1-9]/&1/' results/*/summary.json;; esac"),
        {"two runs that are the same differ", "further apart"}}});
}

BOOST_AUTO_TEST_CASE(what_a_killed_program_leaves_is_told) {
  check_that_it_tells("kills", 1, "chute heap cylinder",
                      {{"sleep 100 & $real \"$@\"; truncate -s -9 results/$name/summary.json",
                        {"runs on", "torn file"}}});
}

BOOST_AUTO_TEST_CASE(a_crash_and_a_damage_that_is_believed_are_told) {
  check_that_it_tells(
      "checkpoints", 1, "cylinder",
      {{"case \"$*\" in *--resume*) kill -SEGV $$;; esac; exec $real \"$@\"", {"crashed"}},
       {"case \"$*\" in *--resume*) cp -r ../whole/results .; sed -i 's/\"drag\": ./\"drag\": 9/' "
        "results/*/summary.json; exit 0;; esac; exec $real \"$@\"",
        {"other digits"}}});
}

BOOST_AUTO_TEST_CASE(a_disk_two_runs_and_a_gnuplot_that_go_unnoticed_are_told) {
  const std::string all = "chute bagnold heap cylinder";
  check_that_it_tells("disk", 10, all,
                      {{"$real \"$@\" 2>&-; exit 0", {"success without summary.json"}},
                       {AFTER("[ $code = 2 ] && code=1"), {"for a folder"}}});
  check_that_it_tells("neighbours", 1, all, {{"$real \"$@\" 2>&-; exit 0", {"both ran"}}});
  check_that_it_tells("gnuplot", 1, all, {{AFTER("touch results/$name/x.png"), {"and there are"}}});
}

BOOST_AUTO_TEST_SUITE_END()
