// Layer porosity from drying history, and what a batch of granules amounts to.
#include "granum/base/error.hpp"
#include "granum/base/random.hpp"
#include "granum/product/aggregate.hpp"
#include "granum/product/all.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace granum;
using namespace granum::product;

TEST(LinearDryingPotential, falls_with_the_drying_potential_and_stays_a_porosity)
{
    LinearDryingPotential const model{.zero = 0.70, .slope = -0.50, .band = 0.07};
    EXPECT_NEAR(model({0.71749, 0, 0}).mean, 0.70 - 0.5 * 0.71749, 1e-12);
    EXPECT_GT(model({0.3, 0, 0}).mean, model({0.8, 0, 0}).mean);
    EXPECT_EQ(model({5, 0, 0}).mean, 0);
    EXPECT_EQ(model({-5, 0, 0}).mean, 0.95);
    EXPECT_EQ(model({0.5, 0, 0}).element, 0.07);
    EXPECT_EQ(model({0.5, 0, 0}).common, 0.07);
}

TEST(PropertyModels, are_found_by_their_names)
{
    for (auto const& name : product::All::names()) EXPECT_TRUE(product::All::make(name).has_value()) << name;
    EXPECT_FALSE(product::All::make("no such model").has_value());
}

TEST(LayerSum, is_the_mean_over_solids_and_averages_out_only_what_is_independent)
{
    LayerSum sum;
    for (int i = 0; i < 100; ++i) sum.add(2, {0.4, 0.1, 0.03});
    EXPECT_NEAR(sum.prediction().mean, 0.4, 1e-12);
    EXPECT_NEAR(sum.prediction().element, 0.1 / std::sqrt(100.0), 1e-12);
    EXPECT_NEAR(sum.prediction().common, 0.03, 1e-12);

    LayerSum uneven;
    uneven.add(3, {0.2, 0, 0});
    uneven.add(1, {0.6, 0, 0});
    EXPECT_NEAR(uneven.prediction().mean, 0.3, 1e-12);
    EXPECT_EQ(LayerSum{}.prediction().mean, 0);
}

TEST(LayerSum, has_the_scatter_of_elements_drawn_at_random)
{
    // 2000 granules of elements of uneven mass, each element drawn about its mean: the spread of the granules' means.
    base::Random random(11, base::Purpose::test, 2, 0);
    double square = 0;
    LayerSum predicted;
    for (int granule = 0; granule < 2000; ++granule) {
        double solids = 0, weighted = 0;
        for (int element = 0; element < 10; ++element) {
            double const mass = 1 + element;
            solids += mass;
            weighted += mass * (0.4 + 0.07 * random.normal());
            if (granule == 0) predicted.add(mass, {0.4, 0.07, 0});
        }
        square += std::pow(weighted / solids - 0.4, 2);
    }
    EXPECT_NEAR(std::sqrt(square / 2000), predicted.prediction().element, 0.06 * predicted.prediction().element);
}

TEST(LayerSum, of_parts_is_the_sum_of_the_whole)
{
    LayerSum left, right, whole;
    for (int i = 1; i < 9; ++i) {
        Prediction const p{0.1 * i, 0.01 * i, 0.02};
        (i % 2 ? left : right).add(i, p);
        whole.add(i, p);
    }
    left += right;
    EXPECT_NEAR(left.prediction().mean, whole.prediction().mean, 1e-14);
    EXPECT_NEAR(left.prediction().element, whole.prediction().element, 1e-14);
    EXPECT_NEAR(left.prediction().common, whole.prediction().common, 1e-14);
}

TEST(Percentile, of_many_equal_weights_is_the_sorted_share)
{
    std::vector<double> values, weights;
    for (int i = 0; i < 1000; ++i) values.push_back((i * 389 % 1000 + 0.5) / 1000), weights.push_back(2);
    auto const p = percentiles(values, weights);
    EXPECT_NEAR(p.p10, 0.1, 1e-12);
    EXPECT_NEAR(p.p50, 0.5, 1e-12);
    EXPECT_NEAR(p.p90, 0.9, 1e-12);
}

TEST(Percentile, does_not_change_when_a_sample_is_split_or_has_no_weight)
{
    std::vector<double> const values{3, 1, 2}, weights{1, 1, 2};
    std::vector<double> const more{3, 1, 2, 99}, with_zero{1, 1, 2, 0};
    EXPECT_EQ(percentile(values, weights, 0.5), 2);
    EXPECT_EQ(percentile(more, with_zero, 0.9), percentile(values, weights, 0.9));
    EXPECT_EQ(percentile(std::vector<double>{5}, std::vector<double>{7}, 0.1), 5);
    EXPECT_EQ(percentile(values, weights, 0), 1);
    EXPECT_EQ(percentile(values, weights, 1), 3);
}

TEST(Percentile, of_nothing_is_refused)
{
    EXPECT_THROW(percentile({}, {}, 0.5), base::NumericsError);
    EXPECT_THROW(percentile(std::vector<double>{1}, std::vector<double>{0}, 0.5), base::NumericsError);
    EXPECT_THROW(percentile(std::vector<double>{1, 2}, std::vector<double>{1}, 0.5), base::NumericsError);
}

TEST(Batch, weighs_its_mean_and_its_percentiles_with_the_solids_of_each_granule)
{
    // A heavy layer of porosity 0.2 and two light ones of 0.6; one granule got nothing.
    std::vector<LayerSum> granules(4);
    granules[0].add(8, {0.2, 0, 0.05});
    granules[1].add(1, {0.6, 0, 0.05});
    granules[2].add(1, {0.6, 0, 0.05});
    auto const batch = batch_property(granules);
    EXPECT_NEAR(batch.mean.mean, 0.28, 1e-12);
    // The heavy one stands at 0.4 of the weight, the light ones at 0.85 and 0.95: the median lies between.
    EXPECT_NEAR(batch.granules.p50, 0.2 + 0.4 * (0.5 - 0.4) / (0.85 - 0.4), 1e-12);
    EXPECT_NEAR(batch.granules.p90, 0.6, 1e-12);
    EXPECT_NEAR(batch.granules.p10, 0.2, 1e-12);
    EXPECT_NEAR(batch.high - batch.low, 2 * 1.959964 * 0.05, 1e-9);
    EXPECT_THROW(batch_property(std::vector<LayerSum>(2)), base::NumericsError);
}

TEST(Batch, interval_holds_the_truth_as_often_as_it_says)
{
    // The line is off by one common error per product and every element by its own: 95 of 100 intervals hold the mean
    // that the product then has.
    base::Random random(5, base::Purpose::test, 3, 0);
    int held = 0;
    int const products = 4000;
    for (int i = 0; i < products; ++i) {
        double const off = 0.03 * random.normal();
        std::vector<LayerSum> granules(3);
        double solids = 0, truth = 0;
        for (auto& granule : granules)
            for (int element = 0; element < 4; ++element) {
                double const mass = 1 + element % 3;
                granule.add(mass, {0.4, 0.08, 0.03});
                solids += mass;
                truth += mass * (0.4 + off + 0.08 * random.normal());
            }
        auto const batch = batch_property(granules);
        held += batch.low < truth / solids && truth / solids < batch.high;
    }
    EXPECT_NEAR(static_cast<double>(held) / products, 0.95, 4 * std::sqrt(0.05 * 0.95 / products));
}

TEST(Sizes, of_a_log_normal_batch_have_its_percentiles_by_number_and_by_volume)
{
    // Hatch and Choate: the volume median is exp(3 ln^2 s) times that of the number.
    base::Random random(9, base::Purpose::test, 4, 0);
    double const median = 0.6e-3, width = 0.2;
    std::vector<double> diameters(100000), counts(100000, 8.0);
    for (auto& d : diameters) d = median * std::exp(width * random.normal());
    auto const by_number = size_percentiles(diameters, counts, Weighting::number);
    auto const by_volume = size_percentiles(diameters, counts, Weighting::volume);
    EXPECT_NEAR(by_number.p50, median, 0.01 * median);
    EXPECT_NEAR(by_number.p10, median * std::exp(-1.281552 * width), 0.01 * median);
    EXPECT_NEAR(by_number.p90, median * std::exp(1.281552 * width), 0.01 * median);
    double const shifted = median * std::exp(3 * width * width);
    EXPECT_NEAR(by_volume.p50, shifted, 0.01 * shifted);
    EXPECT_NEAR(by_volume.p90, shifted * std::exp(1.281552 * width), 0.01 * shifted);
}
}
