// Row P33: a map from eight synthetic runs of a lab recovers a property of known making, and knows how well.
//
// Each run's deposits have a drying time (log-normal) and a moisture at impact (normal); the property of the product is
// the mean of a known function of both over the layer, measured with 3 % noise. Truths, noise and deposits are drawn
// anew for each repeat.
#include "verify/table.hpp"

#include "granum/map/fit.hpp"

#include <array>
#include <cmath>
#include <functional>

namespace
{
using namespace granum;
using namespace granum::map;

constexpr int repeats = 1000;
constexpr int deposits_of_a_run = 600;
constexpr double noise = 0.03;

struct Setting
{
    double log_time, moisture;  //!< means of an operating point
};
//! The lab: four spray rates by two pressures of the atomising air, which let droplets land wetter or drier.
constexpr std::array<Setting, 8> lab{{{-0.55, 1.40},
                                      {-0.35, 1.50},
                                      {-0.15, 1.60},
                                      {0.05, 1.70},
                                      {-0.50, 1.85},
                                      {-0.30, 1.95},
                                      {-0.10, 2.00},
                                      {0.10, 2.10}}};
constexpr Setting pilot{-0.05, 1.72}, outside{0.9, 2.6};

double potential_of(Setting const& at)
{
    return 0.75 - 0.5 * at.log_time;
}

using Truth = std::function<double(double log_time, double moisture)>;

struct Layer
{
    Deposits deposits;
    double property = 0;
};

Layer layer_of(Setting const& at, Truth const& truth, base::Random& random)
{
    Layer out;
    auto& deposits = out.deposits;
    deposits.names = {"drying_time", "moisture_at_impact", "mean_drying_potential"};
    deposits.values.resize(3);
    for (int k = 0; k < deposits_of_a_run; ++k) {
        double const log_time = at.log_time + 0.3 * random.normal(), moisture = at.moisture + 0.2 * random.normal();
        deposits.time.push_back(k);
        deposits.solids.push_back(1);
        deposits.granule.push_back(0);
        deposits.values[0].push_back(std::pow(10, log_time));
        deposits.values[1].push_back(moisture);
        deposits.values[2].push_back(potential_of(at));
        out.property += truth(log_time, moisture) / deposits_of_a_run;
    }
    return out;
}

//! Over the deposits of all runs, whatever the repeat: means and four deviations.
Axes axes()
{
    return {{{.variable = "drying_time",
              .logarithmic = true,
              .low = std::pow(10, -1.75),
              .high = std::pow(10, 1.3),
              .nodes = 12},
             {.variable = "moisture_at_impact", .logarithmic = false, .low = 0.6, .high = 2.8, .nodes = 8}}};
}

//! A smooth rise with the drying time, somewhere and of some steepness, and some slope along the moisture.
Truth any_truth(base::Random& random, double along_moisture)
{
    double const rise = 0.1 + 0.15 * random.uniform(), steep = 0.8 + 1.2 * random.uniform();
    double const middle = -0.3 + 0.6 * random.uniform(), slope = along_moisture * (2 * random.uniform() - 1);
    return [=](double log_time, double moisture) {
        return 0.4 + rise * std::tanh(steep * (log_time - middle)) + slope * (moisture - 1.7);
    };
}

std::vector<LabRun> lab_runs(Truth const& truth, base::Random& random)
{
    std::vector<LabRun> runs;
    for (std::size_t k = 0; k < lab.size(); ++k) {
        auto const layer = layer_of(lab[k], truth, random);
        LabRun run;
        run.name = fmt::format("A{}", k + 1);
        run.error = noise * layer.property;
        run.value = layer.property + run.error * random.normal();
        run.potential = potential_of(lab[k]);
        run.features = features(axes(), layer.deposits);
        runs.push_back(std::move(run));
    }
    return runs;
}

TEST(MapRecovery, predicts_a_shifted_operating_point_and_knows_how_well)
{
    int within_two = 0, within_interval = 0;
    double least_outside = 1, most_inside = 0;
    for (int n = 0; n < repeats; ++n) {
        base::Random random(33, base::Purpose::test, static_cast<std::uint64_t>(n), 0);
        auto const truth = any_truth(random, 0.08);
        auto const map = fit("porosity", "1", {.axes = axes()}, lab_runs(truth, random),
                             {.models = {"additive"}, .compare = false, .seed = static_cast<std::uint32_t>(n)});
        auto const shifted = layer_of(pilot, truth, random), far = layer_of(outside, truth, random);
        auto const answer = predict(map, {{features(axes(), shifted.deposits), potential_of(pilot)}});
        within_two += std::abs(answer.mean - shifted.property) < 2 * answer.deviation();
        within_interval += answer.low < shifted.property && shifted.property < answer.high;
        most_inside = std::max(most_inside, answer.extrapolation);
        auto const beyond = predict(map, {{features(axes(), far.deposits), potential_of(outside)}});
        least_outside = std::min(least_outside, beyond.extrapolation);
    }
    verify::absolute("P33", "map recovery: share of 1,000 shifted points within two deviations, %", 95.5,
                     100.0 * within_two / repeats, 2);
    verify::absolute("P33", "map recovery: share of 1,000 shifted points within their 95 % interval, %", 95,
                     100.0 * within_interval / repeats, 2);
    EXPECT_GT(least_outside, 0.3) << "the extrapolation index of a point outside the lab";
    EXPECT_LT(most_inside, 0.3) << "that of one within";
}

//! Root mean square over repeats of what a model misses at the shifted point, over that of the additive one.
double baseline_over_additive(std::function<Truth(base::Random&)> const& truths)
{
    double additive = 0, line = 0;
    for (int n = 0; n < 200; ++n) {
        base::Random random(34, base::Purpose::test, static_cast<std::uint64_t>(n), 0);
        auto const truth = truths(random);
        auto map =
            fit("porosity", "1", {.axes = axes()}, lab_runs(truth, random),
                {.models = {"additive", "linear-potential"}, .compare = false, .seed = static_cast<std::uint32_t>(n)});
        Setting const wetter{-0.2, 2.0};
        auto const shifted = layer_of(wetter, truth, random);
        auto const at = features(axes(), shifted.deposits);
        for (double* const sum : {&additive, &line}) {
            map.chosen = sum == &additive ? 0 : 1;
            *sum += std::pow(predict(map, {{at, potential_of(wetter)}}).mean - shifted.property, 2);
        }
    }
    return std::sqrt(line / additive);
}

TEST(MapRecovery, beats_the_line_in_the_potential_where_spreading_matters_and_matches_it_where_not)
{
    // A suspension: wetter droplets spread further before they gel and leave a smoother layer.
    double const suspension = baseline_over_additive([](base::Random& random) -> Truth {
        double const slope = 0.15 + 0.1 * random.uniform();
        return [=](double log_time, double moisture) { return 0.4 + 0.05 * log_time - slope * (moisture - 1.7); };
    });
    // A solution whose property is that line: 0.5 per log time is minus one per potential.
    double const solution = baseline_over_additive([](base::Random& random) -> Truth {
        double const slope = 0.1 + 0.1 * random.uniform();
        return [=](double log_time, double) { return 0.4 + slope * log_time; };
    });
    fmt::print("line over additive: suspension {:.2f}, solution {:.2f}\n", suspension, solution);
    EXPECT_GT(suspension, 1.5);
    EXPECT_GT(solution, 0.7) << "the line is true here, so it misses less, but not by much";
}
}
