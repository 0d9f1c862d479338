// granum map fit|predict|show: a property of the product from the conditions under which its deposits dried.
#include "verbs.hpp"

#include "granum/base/error.hpp"
#include "granum/map/lab.hpp"
#include "granum/map/trend.hpp"
#include "granum/report/map_page.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>

namespace granum::app
{
namespace
{
void print_comparison(map::Map const& map)
{
    fmt::print("{:<18} {:>12} {:>10} {:>8} {:>10}\n", "left-out runs", "missed (rms)", "+-", "R2", "/expected");
    for (auto const& one : map.comparisons)
        fmt::print("{:<18} {:>12.4g} {:>10.2g} {:>8.2f} {:>10.2f}{}\n", one.model, one.rms, one.error, one.r2,
                   std::sqrt(one.chi2), one.model == map.comparisons[map.chosen].model ? "  <- predicts" : "");
}

void print_windows(std::vector<map::RunDeposits> const& runs)
{
    for (auto const& run : runs) {
        auto const& w = run.window;
        fmt::print("{}: deposits of {:.3g} to {:.3g} s, log10 of the drying time {:.4f} +- {:.4f}\n", run.folder,
                   w.from, w.to, w.mean, w.error);
        if (!w.settled) fmt::print("  warning: the drying time has not settled within the run: let it run longer\n");
    }
}

int fit(std::string const& path, std::string const& out)
{
    auto const lab = map::read_lab(path);
    std::vector<map::RunDeposits> runs;
    auto const map = map::fit(lab, &runs);
    print_windows(runs);
    print_comparison(map);
    if (auto const found = map::trend(map)) fmt::print("{} {}\n", map.property, found->words());
    map::write_map(map, lab.wanted, out);
    auto const page = std::filesystem::path(out).replace_extension(".html").string();
    report::write_map_page(map, lab.title, page);
    fmt::print("map: {}\npage: {}\n", out, page);
    return 0;
}

int predict(std::string const& path, std::vector<std::string> const& folders, bool json)
{
    auto const map = map::read_map(path);
    std::vector<std::pair<map::Features, double>> points;
    std::vector<map::RunDeposits> runs;
    for (auto const& folder : folders) {
        runs.push_back(map::read_deposits(folder));
        points.emplace_back(map::features(map.known.axes, runs.back().deposits), runs.back().potential);
    }
    auto const answer = map::predict(map, points);
    auto const granules = map::over_granules(map, runs.front().deposits);
    if (json) {
        nlohmann::ordered_json out{{"property", map.property},
                                   {"unit", map.unit},
                                   {"mean", answer.mean},
                                   {"interval_low", answer.low},
                                   {"interval_high", answer.high},
                                   {"deviation", answer.deviation()},
                                   {"deviation_regression", answer.regression},
                                   {"deviation_sampling", answer.sampling},
                                   {"deviation_parameters", answer.parameters},
                                   {"extrapolation_index", answer.extrapolation}};
        if (granules) out["granules"] = {{"p10", granules->p10}, {"p50", granules->p50}, {"p90", granules->p90}};
        fmt::print("{}\n", out.dump(2));
        return 0;
    }
    print_windows(runs);
    fmt::print("{} {:.4g}{}, 95 % interval {:.4g} to {:.4g}\n", map.property, answer.mean,
               map.unit == "1" ? "" : " " + map.unit, answer.low, answer.high);
    if (granules)
        fmt::print("  over granules: p10 {:.4g}, p50 {:.4g}, p90 {:.4g}\n", granules->p10, granules->p50,
                   granules->p90);
    fmt::print("  deviations: {:.2g} of the map, {:.2g} of the length of the run", answer.regression, answer.sampling);
    if (folders.size() > 1) fmt::print(", {:.2g} between the runs", answer.parameters);
    fmt::print("\n  extrapolation index {:.2f}{}\n", answer.extrapolation,
               answer.extrapolation > 0.3 ? ": MUCH of this layer comes of deposits that the lab has not seen" : "");
    return 0;
}

int show(std::string const& path, std::string const& out)
{
    auto const map = map::read_map(path, true);
    print_comparison(map);
    if (auto const found = map::trend(map)) fmt::print("{} {}\n", map.property, found->words());
    report::write_map_page(map, "", out);
    fmt::print("page: {}\n", out);
    return 0;
}
}

void add_map(CLI::App& program, Action& action)
{
    auto* verb = program.add_subcommand("map", "from the conditions of a run's deposits to a property of the product");
    verb->require_subcommand(1);
    auto path = std::make_shared<std::string>(), out = std::make_shared<std::string>();
    auto folders = std::make_shared<std::vector<std::string>>();
    auto json = std::make_shared<bool>(false);

    auto* fitting =
        verb->add_subcommand("fit", "fit a map to the runs of a lab and what was measured on their products");
    fitting->add_option("LAB", *path, "file of the lab")->required();
    fitting->add_option("-o,--output", *out, "map to write (default: LAB with the ending .map)");
    fitting->callback([path, out, &action] {
        action = [path, out] {
            return fit(*path, out->empty() ? std::filesystem::path(*path).replace_extension(".map").string() : *out);
        };
    });
    auto* predicting = verb->add_subcommand("predict", "the property of a run's product, with its uncertainty");
    predicting->add_option("MAP", *path, "written by granum map fit")->required();
    predicting->add_option("RUN", *folders, "run folder; several of one operating point: with other model parameters")
        ->required();
    predicting->add_flag("--json", *json, "print JSON");
    predicting->callback(
        [path, folders, json, &action] { action = [path, folders, json] { return predict(*path, *folders, *json); }; });
    auto* showing = verb->add_subcommand("show", "write the page of a map");
    showing->add_option("MAP", *path, "written by granum map fit")->required();
    showing->add_option("-o,--output", *out, "page to write (default: MAP with the ending .html)");
    showing->callback([path, out, &action] {
        action = [path, out] {
            return show(*path, out->empty() ? std::filesystem::path(*path).replace_extension(".html").string() : *out);
        };
    });
}
}
