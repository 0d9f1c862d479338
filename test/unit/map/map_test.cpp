// The pieces of the map against what follows by hand.
#include "granum/map/fit.hpp"

#include "granum/base/error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace granum;
using namespace granum::map;
using Eigen::VectorXd;

Axes time_and_moisture()
{
    return {{{.variable = "drying_time", .logarithmic = true, .low = 0.1, .high = 10, .nodes = 5},
             {.variable = "moisture_at_impact", .logarithmic = false, .low = 1, .high = 3, .nodes = 3}}};
}

TEST(Axes, share_a_deposit_among_the_nodes_around_it)
{
    auto const axes = time_and_moisture();
    EXPECT_EQ(axes.nodes(), 15u);
    EXPECT_NEAR(axes.axes[0].node(1), std::sqrt(0.1), 1e-12);
    VectorXd nodes = VectorXd::Zero(15);
    // Half way between the nodes 1 and 2 in log10, a quarter of the way from the node 0 to 1 in moisture.
    double const values[] = {std::pow(10.0, -0.25), 1.25};
    axes.spread(values, 8, nodes);
    EXPECT_NEAR(nodes[1], 3, 1e-12);
    EXPECT_NEAR(nodes[2], 3, 1e-12);
    EXPECT_NEAR(nodes[6], 1, 1e-12);
    EXPECT_NEAR(nodes[7], 1, 1e-12);
    EXPECT_NEAR(nodes.sum(), 8, 1e-12);
}

TEST(Axes, give_back_what_is_linear_between_nodes_and_the_last_node_beyond)
{
    auto const axes = time_and_moisture();
    VectorXd plane(15);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 3; ++j) plane[i + 5 * j] = 2 * std::log10(axes.axes[0].node(i)) + axes.axes[1].node(j);
    double const inside[] = {0.37, 2.61}, beyond[] = {100, 0};
    EXPECT_NEAR(axes.at(inside, plane), 2 * std::log10(0.37) + 2.61, 1e-12);
    EXPECT_NEAR(axes.at(beyond, plane), 2 * 1 + 1, 1e-12);
}

TEST(Axes, over_values_have_a_margin_and_leave_out_the_last_thousandth)
{
    double const values[] = {1, 100, std::nan(""), -3, 1e9}, weights[] = {1, 1, 1, 1, 1e-4};
    auto const axis = axis_over("drying_time", true, values, weights, 12);
    EXPECT_NEAR(axis.low, std::pow(10, -0.2), 1e-12);
    EXPECT_NEAR(axis.high, std::pow(10, 2.2), 1e-9);
    double const same[] = {2, 2};
    EXPECT_THROW(axis_over("x", false, same, same, 12), base::NumericsError);
}

Deposits deposits(std::vector<double> times, std::vector<double> moistures)
{
    Deposits out;
    out.names = {"drying_time", "moisture_at_impact", "mean_drying_potential"};
    auto const count = times.size();
    for (std::size_t k = 0; k < count; ++k) out.time.push_back(static_cast<double>(k));
    out.solids.assign(count, 2.0);
    out.granule.assign(count, 0.0);
    out.values = {std::move(times), std::move(moistures), std::vector<double>(count, 0.5)};
    return out;
}

TEST(Features, are_weighted_sums_block_by_block)
{
    auto given = deposits({0.1, 1, 10, 1}, {1, 2, 3, 2});
    given.solids[2] = 6;
    auto const both = features(time_and_moisture(), given, 2);
    ASSERT_EQ(both.blocks.size(), 2u);
    EXPECT_EQ(both.blocks[0].solids, 4);
    auto const total = both.total();
    EXPECT_EQ(total.solids, 12);
    EXPECT_NEAR(total.potential / total.solids, 0.5, 1e-15);
    auto const three = scores(total);
    EXPECT_NEAR(three[0], (-1 * 2 + 1 * 6) / 12.0, 1e-14);
    EXPECT_NEAR(three[1], (1 * 2 + 2 * 2 + 3 * 6 + 2 * 2) / 12.0, 1e-14);
    EXPECT_NEAR(three[2], std::sqrt(8 / 12.0 - 1 / 9.0), 1e-14);
    EXPECT_NEAR(histogram(total).sum(), 1, 1e-14);
    EXPECT_NEAR(histogram(total)[14], 0.5, 1e-14);
    EXPECT_EQ(score_names(time_and_moisture())[2], "standard deviation of log10 drying_time");
}

TEST(Features, leave_out_deposits_without_a_value_and_refuse_to_have_none)
{
    auto given = deposits({0, 1}, {1, 2});
    EXPECT_EQ(features(time_and_moisture(), given).total().solids, 2);
    given.values[0][1] = -1;
    EXPECT_THROW(features(time_and_moisture(), given), base::NumericsError);
    EXPECT_THROW(features({{{.variable = "weber"}}}, given), base::NumericsError);
}

// One unknown of prior variance 4, measured as 10 with variance 1: mean 8, variance 0.8, evidence N(10; 0, 5).
TEST(Posterior, of_one_number_is_known_in_closed_form)
{
    auto const one = posterior(Eigen::MatrixXd::Ones(1, 1), VectorXd::Constant(1, 10.0), VectorXd::Constant(1, 1.0),
                               Eigen::MatrixXd::Constant(1, 1, 4.0));
    EXPECT_NEAR(one.mean[0], 8, 1e-12);
    EXPECT_NEAR(one.covariance(0, 0), 0.8, 1e-12);
    EXPECT_NEAR(log_evidence(Eigen::MatrixXd::Constant(1, 1, 5.0), VectorXd::Constant(1, 10.0)),
                -0.5 * (100 / 5.0 + std::log(2 * M_PI * 5)), 1e-12);
    EXPECT_NEAR(weights({-10, -10 + std::log(3.0)})[1], 0.75, 1e-12);
}

// The same with prior variances 4 and 1: N(1; 0, 5) and N(1; 0, 2) weigh 0.3614 to 0.4394 / ... and the means are 0.8
// and 0.5.
TEST(Posterior, of_several_choices_is_weighted_with_their_evidence)
{
    double const first = std::exp(-0.1) / std::sqrt(5.0), second = std::exp(-0.25) / std::sqrt(2.0);
    double const share = first / (first + second), mean = share * 0.8 + (1 - share) * 0.5;
    auto const both = averaged(Eigen::MatrixXd::Ones(1, 1), VectorXd::Ones(1), VectorXd::Ones(1), 2, [](std::size_t k) {
        return Eigen::MatrixXd::Constant(1, 1, k == 0 ? 4.0 : 1.0).eval();
    });
    EXPECT_NEAR(both.mean[0], mean, 1e-12);
    EXPECT_NEAR(both.covariance(0, 0),
                share * (0.8 + std::pow(0.8 - mean, 2)) + (1 - share) * (0.5 + std::pow(0.5 - mean, 2)), 1e-12);
}

// In the plain metric the point (0, 0) goes to the nearest one with x >= 1 and x + y >= 3: (1.5, 1.5).
TEST(NearestWithin, finds_the_corner_or_the_foot_of_the_perpendicular)
{
    Eigen::MatrixXd rows(2, 2);
    rows << 1, 0, 1, 1;
    auto const foot =
        nearest_within(VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2), rows, Eigen::Vector2d(1, 3), 1e-12);
    EXPECT_NEAR(foot[0], 1.5, 1e-9);
    EXPECT_NEAR(foot[1], 1.5, 1e-9);
    auto const corner =
        nearest_within(VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2), rows, Eigen::Vector2d(2, 3), 1e-12);
    EXPECT_NEAR(corner[0], 2, 1e-9);
    EXPECT_NEAR(corner[1], 1, 1e-9);
    // Where x may move further than y, it does.
    Eigen::MatrixXd const wide = Eigen::Vector2d(2, 1).asDiagonal();
    auto const stretched = nearest_within(VectorXd::Zero(2), wide, rows.row(1), VectorXd::Constant(1, 3.0), 1e-12);
    EXPECT_NEAR(stretched[0], 2, 1e-9);
}

// A smooth curve whose ends lie beyond both limits, many nodes at them at once: within, and nearer than the curve cut
// off.
TEST(NearestWithin, bends_a_smooth_curve_into_its_limits)
{
    Eigen::Index const nodes = 60;
    Eigen::MatrixXd covariance(nodes, nodes), rows = Eigen::MatrixXd::Zero(2 * nodes, nodes);
    VectorXd middle(nodes), least(2 * nodes);
    for (Eigen::Index i = 0; i < nodes; ++i) {
        for (Eigen::Index j = 0; j < nodes; ++j)
            covariance(i, j) = std::exp(-std::pow(static_cast<double>(i - j) / 12.0, 2)) + (i == j ? 1e-7 : 0);
        middle[i] = 3.0 * static_cast<double>(i) / (nodes - 1) - 1;
        rows(i, i) = 1, rows(nodes + i, i) = -1;
        least[i] = 0, least[nodes + i] = -1;
    }
    auto const found = nearest_within(middle, covariance, rows, least, 1e-9);
    EXPECT_GT(found.minCoeff(), -1e-6);
    EXPECT_LT(found.maxCoeff(), 1 + 1e-6);
    auto const distance = [&](VectorXd const& x) { return (x - middle).dot(covariance.llt().solve(x - middle)); };
    EXPECT_LT(distance(found), distance(middle.cwiseMax(0).cwiseMin(1)));
    // No step towards any point within is shorter: the gradient is across the limits that are met.
    VectorXd const pull = covariance.llt().solve(found - middle);
    for (double const inner : {0.2, 0.5, 0.8})
        EXPECT_GT(pull.dot(VectorXd::Constant(nodes, inner) - found), -1e-3 * std::abs(distance(found)));
}

Axes time_alone()
{
    return {{{.variable = "drying_time", .logarithmic = true, .low = 0.1, .high = 10, .nodes = 12}}};
}

//! Runs whose deposits all dried about `times` s, with the property of `truth`.
template <class Truth>
std::vector<LabRun> runs_at(std::vector<double> const& times, Truth const& truth, double error)
{
    std::vector<LabRun> out;
    for (double const time : times) {
        std::vector<double> around;
        for (int k = -20; k <= 20; ++k) around.push_back(time * std::pow(10, 0.01 * k));
        LabRun run;
        run.name = std::to_string(time);
        run.error = error;
        run.potential = 0.9 - 0.1 * time;
        for (double const t : around) run.value += truth(t) / static_cast<double>(around.size());
        run.features = features(time_alone(), deposits(around, std::vector<double>(around.size(), 2.0)), 4);
        out.push_back(std::move(run));
    }
    return out;
}

TEST(Map, of_any_model_gives_back_a_property_that_it_can_hold)
{
    auto const truth = [](double t) { return 0.5 + 0.2 * std::log10(t); };
    auto const map = fit("porosity", "1", {.axes = time_alone()}, runs_at({0.2, 0.5, 1, 2, 4}, truth, 1e-3));
    ASSERT_EQ(map.models.size(), Models::size);
    auto const asked = runs_at({0.8}, truth, 0).front();
    for (std::size_t m = 0; m < map.models.size(); ++m) {
        if (map.comparisons[m].model == "linear-potential") continue;  // not linear in the time
        auto one = map;
        one.chosen = m;
        auto const answer = predict(one, {{asked.features, asked.potential}});
        EXPECT_NEAR(answer.mean, asked.value, 0.01) << map.comparisons[m].model;
        EXPECT_LT(map.comparisons[m].rms, 0.03) << map.comparisons[m].model;
        EXPECT_GT(map.comparisons[m].r2, 0.9) << map.comparisons[m].model;
    }
}

TEST(Map, by_drying_potential_is_a_line_with_the_errors_of_least_squares)
{
    auto runs = runs_at(
        {1, 2, 3}, [](double) { return 0.0; }, 0.1);
    for (std::size_t k = 0; k < 3; ++k)
        runs[k].potential = static_cast<double>(k), runs[k].value = 1 + 2.0 * static_cast<double>(k);
    auto const map = fit("p", "1", {.axes = time_alone()}, runs, {.models = {"linear-potential"}});
    auto const answer = predict(map, {{runs[0].features, 3.0}});
    EXPECT_NEAR(answer.mean, 7, 1e-12);
    // Variance of the line at x = 3 from x = 0, 1, 2: s^2 (1/3 + (3 - 1)^2 / 2).
    EXPECT_NEAR(answer.regression, 0.1 * std::sqrt(1 / 3.0 + 2), 1e-12);
}

TEST(Map, keeps_an_order_and_limits_that_are_known)
{
    auto const truth = [](double t) { return t < 1 ? 0.1 : 0.5; };
    auto runs = runs_at({0.2, 0.5, 1, 2, 4}, truth, 0.02);
    runs[0].value = -0.05, runs[1].value = -0.1;  // as noise may have it
    auto const free = fit("porosity", "1", {.axes = time_alone()}, runs);
    Known known{.axes = time_alone(), .low = 0, .high = 1, .along_first = Monotone::rising};
    auto const held = fit("porosity", "1", known, runs);
    auto const before = std::get<Additive>(free.models[0]).at_nodes(),
               after = std::get<Additive>(held.models[0]).at_nodes();
    EXPECT_LT(before.minCoeff(), 0) << "the case must test something";
    for (int k = 0; k + 1 < 12; ++k) EXPECT_GE(after[k + 1], after[k] - 1e-6) << k;
    EXPECT_GE(after.minCoeff(), -1e-6);
    EXPECT_TRUE(std::get<Additive>(held.models[0]).bound);
}

TEST(Map, tells_how_much_of_a_layer_the_lab_has_not_seen)
{
    auto const truth = [](double t) { return t; };
    auto const map = fit("p", "1", {.axes = time_alone()}, runs_at({0.2, 0.3, 0.4}, truth, 0.02));
    auto const inside = runs_at({0.3}, truth, 0).front(), outside = runs_at({5.0}, truth, 0).front();
    EXPECT_LT(predict(map, {{inside.features, 0.5}}).extrapolation, 0.05);
    EXPECT_GT(predict(map, {{outside.features, 0.5}}).extrapolation, 0.95);
}

TEST(Map, tells_how_granules_differ_by_what_their_own_deposits_went_through)
{
    auto const truth = [](double t) { return 0.5 + 0.2 * std::log10(t); };
    auto map = fit("p", "1", {.axes = time_alone()}, runs_at({0.2, 0.5, 1, 2, 4}, truth, 1e-3));
    // Three granules: two of deposits of 0.5 s and one, half of 0.5 s and half of 2 s, with twice the layer of either.
    auto given = deposits({0.5, 0.5, 0.5, 2}, {2, 2, 2, 2});
    given.granule = {0, 1, 2, 2};
    auto const spread = over_granules(map, given);
    ASSERT_TRUE(spread);
    EXPECT_NEAR(spread->p10, truth(0.5), 0.01);
    EXPECT_NEAR(spread->p90, 0.5 * (truth(0.5) + truth(2)), 0.01);
    map.chosen = 1;  // of a line in the potential single deposits have none
    EXPECT_FALSE(over_granules(map, given));
}

TEST(Map, knows_a_shift_better_than_the_values_it_is_between)
{
    auto const truth = [](double t) { return 0.5 + 0.2 * std::log10(t); };
    auto map = fit("p", "1", {.axes = time_alone()}, runs_at({0.2, 0.5, 1, 2, 4}, truth, 0.02));
    auto const low = runs_at({0.8}, truth, 0).front(), high = runs_at({1.2}, truth, 0).front();
    std::pair const from{low.features, low.potential}, to{high.features, high.potential};
    for (map.chosen = 0; map.chosen < map.models.size(); ++map.chosen) {
        auto const& name = map.comparisons[map.chosen].model;
        auto const a = predict(map, {from}), b = predict(map, {to});
        auto const moved = shift(map, from, to), still = shift(map, from, from);
        EXPECT_NEAR(moved.mean, b.mean - a.mean, 1e-12) << name;
        EXPECT_EQ(still.mean, 0) << name;
        EXPECT_LT(moved.deviation, std::hypot(a.deviation(), b.deviation())) << name;
        EXPECT_LT(still.deviation, 1.5 * a.sampling + 1e-7) << name << ": what is left is that runs are short";
    }
    // Of a line, the error of the shift is that of the slope times the way.
    map.chosen = 1;
    auto const& line = std::get<LinearPotential>(map.models[1]);
    EXPECT_NEAR(shift(map, from, to).deviation,
                std::sqrt(line.covariance(1, 1)) * std::abs(high.potential - low.potential), 1e-9);
}

TEST(Map, adds_up_what_makes_it_uncertain)
{
    auto const truth = [](double t) { return 0.5 + 0.2 * std::log10(t); };
    auto const map = fit("p", "1", {.axes = time_alone()}, runs_at({0.2, 0.5, 1, 2, 4}, truth, 1e-3));
    auto const low = runs_at({0.8}, truth, 0).front(), high = runs_at({1.2}, truth, 0).front();
    auto const both = predict(map, {{low.features, 0.5}, {high.features, 0.5}});
    EXPECT_NEAR(both.parameters, (high.value - low.value) / std::sqrt(2.0), 0.005);
    EXPECT_GT(both.sampling, 0);
    EXPECT_NEAR(both.high - both.low, 2 * 1.959964 * both.deviation(), 1e-9);
    EXPECT_THROW(predict(map, {}), base::NumericsError);
    EXPECT_THROW(fit("p", "1", {.axes = time_alone()}, runs_at({0.2, 0.5}, truth, 0.1)), base::NumericsError);
}
}
