#include "granum/population/balance.hpp"

#include "granum/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace granum::population
{
namespace
{
constexpr double courant = 0.4;
constexpr double joined = 0.05;  // of the granules of a class, in a step

//! Koren's limiter of the ratio of successive slopes.
double koren(double r)
{
    return std::max(0.0, std::min({2 * r, (1 + 2 * r) / 3, 2.0}));
}

//! Granules per m at the upper edge of class k, seen from below.
double at_upper_edge(Classes const& classes, std::size_t k)
{
    double const here = classes.number[k] / classes.width(k);
    if (k == 0 || k + 1 == classes.size()) return here;
    double const below = classes.number[k - 1] / classes.width(k - 1),
                 above = classes.number[k + 1] / classes.width(k + 1);
    double const slope = here - below;
    if (slope == 0) return here;
    return here + 0.5 * koren((above - here) / slope) * slope;
}

//! Growth at the upper edges of classes, not yet scaled: granules per second for a speed of 1 m/s.
std::vector<double> fluxes(Classes const& classes, std::function<double(double)> const& growth)
{
    std::vector<double> out(classes.size());
    for (std::size_t k = 0; k + 1 < classes.size(); ++k)
        out[k] = growth(classes.edges[k + 1]) * at_upper_edge(classes, k);
    return out;
}

//! Where the unions of the granules of two classes go: to class `to` by `share`, else to the next.
struct Unions
{
    struct Pair
    {
        double rate, share;
        std::size_t to;
    };
    std::vector<Pair> pairs;  //!< i <= j, row by row

    Unions(Classes const& classes, Rates const& rates)
    {
        if (!rates.agglomeration) return;
        std::vector<double> pivots;
        for (std::size_t k = 0; k < classes.size(); ++k) pivots.push_back(classes.volume(k));
        pairs.reserve(pivots.size() * (pivots.size() + 1) / 2);
        for (std::size_t i = 0; i < pivots.size(); ++i)
            for (std::size_t j = i; j < pivots.size(); ++j) {
                double const volume = pivots[i] + pivots[j];
                auto const above = std::upper_bound(pivots.begin(), pivots.end(), volume);
                Pair one{.rate = rates.agglomeration(classes.centre(i), classes.centre(j)),
                         .share = 1,
                         .to = static_cast<std::size_t>(above - pivots.begin()) - 1};
                base::require(one.rate >= 0 && std::isfinite(one.rate), "a rate of agglomeration is {}", one.rate);
                // Beyond the last class number gives way to volume; no run gets there, see require_room.
                if (above == pivots.end())
                    one.share = volume / pivots.back();
                else
                    one.share = (*above - volume) / (*above - pivots[one.to]);
                pairs.push_back(one);
            }
    }
};

struct Change
{
    std::vector<double> number;  //!< 1/s
    Passed rates;                //!< m3/s
    double speed = 0;            //!< m/s, where the growth of size is 1
    double leaving = 0;          //!< 1/s, of the class that leaves fastest
    double joining = 0;          //!< 1/s, of the class that joins others fastest
};

//! Speed for which the fluxes raise the sum of `measure` over granules by `wanted` per second.
template <class Measure>
double speed_for(std::vector<double> const& flux, Classes const& classes, double wanted, Measure const& measure)
{
    double gain = 0;
    for (std::size_t k = 0; k + 1 < classes.size(); ++k) gain += flux[k] * (measure(k + 1) - measure(k));
    return gain > 0 ? wanted / gain : 0;
}

//! Deaths and births of granules that join.
void join(Classes const& classes, Unions const& unions, std::vector<double>& change, double& fastest)
{
    std::vector<double> deaths(classes.size());
    auto pair = unions.pairs.begin();
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (classes.number[i] == 0) {
            pair += static_cast<std::ptrdiff_t>(classes.size() - i);
            continue;
        }
        for (std::size_t j = i; j < classes.size(); ++j, ++pair) {
            double const rate = (i == j ? 0.5 : 1.0) * pair->rate * classes.number[i] * classes.number[j];
            if (rate == 0) continue;
            deaths[i] += rate, deaths[j] += rate;
            change[pair->to] += rate * pair->share;
            if (pair->to + 1 < classes.size()) change[pair->to + 1] += rate * (1 - pair->share);
        }
    }
    for (std::size_t k = 0; k < classes.size(); ++k) {
        change[k] -= deaths[k];
        if (classes.number[k] > 0) fastest = std::max(fastest, deaths[k] / classes.number[k]);
    }
}

Change change_of(Classes const& classes, Rates const& rates, Unions const& unions)
{
    Change out;
    out.number.assign(classes.size(), 0.0);
    auto const flux = fluxes(classes, rates.growth);
    out.speed = speed_for(flux, classes, rates.layer, [&](std::size_t k) { return classes.volume(k); });
    for (std::size_t k = 0; k + 1 < classes.size(); ++k) {
        out.number[k] -= out.speed * flux[k];
        out.number[k + 1] += out.speed * flux[k];
    }
    out.rates.grown = out.speed > 0 ? rates.layer : 0;
    auto const enter = [&](double count, double diameter, double& volume) {
        if (count <= 0) return;
        Classes one{classes.edges, std::vector<double>(classes.size())};
        one.add(diameter, count);
        for (std::size_t k = 0; k < classes.size(); ++k) out.number[k] += one.number[k];
        volume = one.total_volume();
    };
    enter(rates.nuclei, rates.nuclei_diameter, out.rates.born);
    enter(rates.feed, rates.feed_diameter, out.rates.fed);
    double leaving = 0;
    std::vector<double> leaves(classes.size());
    for (std::size_t k = 0; k < classes.size(); ++k) {
        leaves[k] = rates.discharge(classes.centre(k)) * classes.number[k];
        leaving += leaves[k] * classes.volume(k);
    }
    double scale = 1;
    if (rates.hold_up > 0 && leaving > 0) scale = (out.rates.grown + out.rates.born + out.rates.fed) / leaving;
    for (std::size_t k = 0; k < classes.size(); ++k) {
        out.number[k] -= scale * leaves[k];
        out.rates.number_discharged += scale * leaves[k];
        if (classes.number[k] > 0) out.leaving = std::max(out.leaving, scale * leaves[k] / classes.number[k]);
    }
    out.rates.discharged = scale * leaving;
    if (!unions.pairs.empty()) join(classes, unions, out.number, out.joining);
    return out;
}

double fastest(Classes const& classes, Rates const& rates)
{
    double most = 0;
    for (double const edge : classes.edges) most = std::max(most, rates.growth(edge));
    return most;
}

void require_room(Classes const& classes)
{
    double const last = classes.number.back(), all = classes.total();
    base::require(std::isfinite(all), "a number of granules is not finite");
    base::require(last <= 1e-9 * all, "granules have grown to the last class, {} m: give more classes",
                  classes.edges.back());
}

//! Strong-stability-preserving third order of Shu and Osher: each stage is a mean of Euler steps.
template <class Slope>
void step(std::vector<double>& number, double dt, Slope const& slope)
{
    auto const start = number;
    constexpr double kept[] = {0, 0.75, 1.0 / 3};
    for (double const share : kept) {
        auto const rate = slope();
        for (std::size_t k = 0; k < number.size(); ++k)
            number[k] = share * start[k] + (1 - share) * (number[k] + dt * rate[k]);
    }
}
}

Passed advance(Classes& classes, Rates const& rates, double dt)
{
    Passed out;
    double const factor = fastest(classes, rates);
    Unions const unions(classes, rates);
    for (double left = dt; left > 0;) {
        auto const first = change_of(classes, rates, unions);
        double width = classes.width(0);
        for (std::size_t k = 1; k < classes.size(); ++k) width = std::min(width, classes.width(k));
        double h = left;
        if (first.speed > 0) h = std::min(h, courant * width / (first.speed * factor));
        if (first.leaving > 0) h = std::min(h, courant / first.leaving);
        if (first.joining > 0) h = std::min(h, joined / first.joining);
        // Weights of the stages in the sum that the three of them make.
        constexpr double share[] = {1.0 / 6, 1.0 / 6, 2.0 / 3};
        std::size_t stage = 0;
        step(classes.number, h, [&] {
            auto const change = change_of(classes, rates, unions);
            double const weight = h * share[stage++];
            out.grown += weight * change.rates.grown, out.born += weight * change.rates.born;
            out.fed += weight * change.rates.fed, out.discharged += weight * change.rates.discharged;
            out.number_discharged += weight * change.rates.number_discharged;
            return change.number;
        });
        left = h >= 0.999999 * left ? 0 : left - h;
        require_room(classes);
    }
    return out;
}

void advance_by_speed(Classes& classes, double speed, double dt)
{
    double width = classes.width(0);
    for (std::size_t k = 1; k < classes.size(); ++k) width = std::min(width, classes.width(k));
    auto const steps = static_cast<long>(std::ceil(dt * speed / (courant * width)));
    for (long n = 0; n < steps; ++n) {
        step(classes.number, dt / static_cast<double>(steps), [&] {
            std::vector<double> rate(classes.size());
            auto const flux = fluxes(classes, [](double) { return 1.0; });
            double const own =
                speed_for(flux, classes, speed * classes.total(), [&](std::size_t k) { return classes.centre(k); });
            for (std::size_t k = 0; k + 1 < classes.size(); ++k) rate[k] -= own * flux[k], rate[k + 1] += own * flux[k];
            return rate;
        });
        require_room(classes);
    }
}
}
