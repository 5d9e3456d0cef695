#include "render/program/diff_arguments.h"

#include <CLI/CLI.hpp>

#include "render/program/option_groups.h"

namespace automorph::program {
namespace {

constexpr const char* kDiffExamples = R"(Examples:
  automorph diff golden.exr new.exr
      one line of verdict and a table of the tests; status 0: same, 1: different, 2: cannot be compared
  automorph diff golden/ new/ --side-by-side why/ --report diff.json || exit 1
      in a CI job: pictures are matched by their path; why/ shows those that differ
  automorph diff golden.exr new.exr --mode exact
      every bit of every channel
  automorph diff golden/ new/ --accept
      replaces the goldens that differ, on purpose only; those that are the same stay as they are
Modes:
  exact        all values of all channels have the same bits
  same-seed    same scene and seed, other compiler or machine: --rmse, --outlier, --outliers
  statistical  any seeds: tells noise from change by the pictures' own layers "variance" and "samples"
               ('automorph figure --layers' writes them). Of all runs on unchanged scenes at most the share
               --false-alarms is called different. Names the failed test, the place and the size of the change,
               and says how small a change it could have seen.
  auto         statistical where both pictures hold these layers, else same-seed; the output says which)";

}  // namespace

void add_diff(CLI::App& app, DiffArguments& arguments) {
    CLI::App* command = app.add_subcommand("diff", "Tells whether pictures have changed, and where");
    command->add_option("GOLDEN", arguments.golden, "Picture (EXR, PNG) or folder as it should be")
        ->type_name("PATH")
        ->required();
    command->add_option("NEW", arguments.found, "Picture or folder as it is")->type_name("PATH")->required();
    add_choice(*command, "--mode", arguments.mode, kDiffModes, "How they are compared, see below");
    command
        ->add_option("--heatmap", arguments.heatmap, "PNG of the differences; a folder of those, for folders")
        ->type_name("FILE");
    command
        ->add_option("--side-by-side", arguments.side_by_side,
                     "PNG of golden, new and differences; a folder of those, for folders")
        ->type_name("FILE");
    command->add_option("--report", arguments.report, "JSON: all tests with values, limits and places")
        ->type_name("FILE");
    command->add_flag("--accept", arguments.accept,
                      "Copy new pictures over the goldens from which they differ, and add those without one");
    command
        ->add_option("--false-alarms", arguments.statistical.false_alarm_rate,
                     "statistical: share of runs that may be wrong when nothing has changed")
        ->type_name("X")
        ->check(range(1e-12, 0.5))
        ->capture_default_str();
    const CLI::Validator radiance = range(0.0, 1e9);
    command
        ->add_option("--rmse", arguments.same_seed.rmse, "same-seed: largest root mean square, in radiance")
        ->type_name("X")
        ->check(radiance)
        ->capture_default_str();
    command
        ->add_option("--outlier", arguments.same_seed.outlier,
                     "same-seed: a pixel that differs by more is an outlier, in radiance")
        ->type_name("X")
        ->check(range(1e-9, 1e9))
        ->capture_default_str();
    command->add_option("--outliers", arguments.same_seed.outliers, "same-seed: so many are accepted")
        ->type_name("N")
        ->check(range(0, 1'000'000'000))
        ->capture_default_str();
    command->footer(kDiffExamples);
}

}  // namespace automorph::program
