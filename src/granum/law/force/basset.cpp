#include "granum/law/force/basset.hpp"

#include "granum/base/error.hpp"
#include "granum/math/constants.hpp"

#include <algorithm>
#include <cmath>

namespace granum::law::force
{
namespace
{
// Times over the window's, and weights, of the exponentials that stand for the kernel.
constexpr std::array<double, BassetWindow::tails> times{0.1, 0.3, 1, 3, 10, 40, 190, 1000, 6500, 50000};
constexpr std::array<double, BassetWindow::tails> weights{
    0.23477481312586, 0.28549576238194, 0.28479416718255, 0.26149775537574, 0.32056200511938,
    0.35354490689146, 0.39635904496921, 0.42253908596514, 0.48317384225265, 0.63661146557001};

math::Vec3 load(std::span<double const> state, std::size_t slot)
{
    double const* const at = state.data() + 1 + 3 * slot;
    return {at[0], at[1], at[2]};
}

void store(std::span<double> state, std::size_t slot, math::Vec3 const& value)
{
    double* const at = state.data() + 1 + 3 * slot;
    at[0] = value.x, at[1] = value.y, at[2] = value.z;
}

//! (1 - (1 + h) exp(-h)) / h^2, the share of the older end of an interval under exp(-h x), without cancellation.
double older_share(double h)
{
    if (h < 0.01) return 1.0 / 2 + h * (-1.0 / 3 + h * (1.0 / 8 + h * (-1.0 / 30 + h / 144)));
    return (1 - (1 + h) * std::exp(-h)) / (h * h);
}
}

double basset_coefficient(double diameter, double density, double viscosity)
{
    return 1.5 * diameter * diameter * std::sqrt(math::pi * density * viscosity);
}

BassetWindow::BassetWindow(std::size_t intervals, double step) : intervals_(intervals), window_(intervals)
{
    GRANUM_EXPECT(intervals > 0);
    double const length = static_cast<double>(intervals) * step;
    for (std::size_t i = 0; i < tails; ++i)
        tail_[i] = {0.5 / (times[i] * length), weights[i] * std::exp(0.5) / std::sqrt(times[i] * length)};
    set_step(step);
}

void BassetWindow::set_step(double step)
{
    step_ = step;
    double const root = std::sqrt(step);
    for (std::size_t j = 0; j < intervals_; ++j) {
        double const a = static_cast<double>(j), b = a + 1, roots = std::sqrt(b) - std::sqrt(a);
        double const cubes = 2.0 / 3 * (b * std::sqrt(b) - a * std::sqrt(a));
        window_[j] = {root * (2 * b * roots - cubes), root * (cubes - 2 * a * roots)};
    }
    for (std::size_t i = 0; i < tails; ++i) {
        decay_[i] = std::exp(-tail_[i].rate * step);
        leaving_[i] = exponential(tail_[i], static_cast<double>(intervals_) * step, step);
    }
}

//! Weights of g at the ends of the interval between the ages `age` and `age` + `length` in the integral with `tail`.
BassetWindow::Weights BassetWindow::exponential(Tail const& tail, double age, double length)
{
    double const h = tail.rate * length, older = older_share(h);
    double const scale = tail.weight * std::exp(-tail.rate * age) * length;
    return {scale * (-std::expm1(-h) / h - older), scale * older};
}

void BassetWindow::begin(std::span<double> state, math::Vec3 const& change) const
{
    std::fill(state.begin(), state.end(), 0.0);
    store(state, 0, change);
}

double BassetWindow::newest() const
{
    return window_[0].newer;
}

math::Vec3 BassetWindow::known(std::span<double const> state) const
{
    GRANUM_EXPECT(state.size() == size());
    // What is k steps old now is k + 1 steps old then, and a full window drops its last interval.
    std::size_t const after = std::min(held(state) + 1, intervals_);
    math::Vec3 sum = window_[0].older * load(state, 0);
    for (std::size_t j = 1; j < after; ++j)
        sum += window_[j].newer * load(state, j - 1) + window_[j].older * load(state, j);
    for (std::size_t i = 0; i < tails; ++i) sum += decay_[i] * load(state, intervals_ + 1 + i);
    if (held(state) == intervals_)
        for (auto const& weight : leaving_)
            sum += weight.newer * load(state, intervals_ - 1) + weight.older * load(state, intervals_);
    return sum;
}

void BassetWindow::advance(std::span<double> state, math::Vec3 const& change) const
{
    GRANUM_EXPECT(state.size() == size());
    bool const full = held(state) == intervals_;
    for (std::size_t i = 0; i < tails; ++i) {
        math::Vec3 tail = decay_[i] * load(state, intervals_ + 1 + i);
        if (full) tail += leaving_[i].newer * load(state, intervals_ - 1) + leaving_[i].older * load(state, intervals_);
        store(state, intervals_ + 1 + i, tail);
    }
    for (std::size_t k = intervals_; k > 0; --k) store(state, k, load(state, k - 1));
    store(state, 0, change);
    if (!full) state[0] += 1;
}

BassetWindow BassetWindow::with_step(double step) const
{
    BassetWindow other = *this;
    other.set_step(step);
    return other;
}

void BassetWindow::resample(std::span<double> state, BassetWindow const& before) const
{
    GRANUM_EXPECT(state.size() == size() && before.intervals_ == intervals_);
    std::size_t const old_held = before.held(state);
    std::vector<math::Vec3> old(old_held + 1);
    for (std::size_t k = 0; k <= old_held; ++k) old[k] = load(state, k);
    auto const at = [&](double age) {
        double const place = std::min(age / before.step_, static_cast<double>(old_held));
        std::size_t const k = std::min(static_cast<std::size_t>(place), std::max<std::size_t>(old_held, 1) - 1);
        double const part = place - static_cast<double>(k);
        return old_held == 0 ? old[0] : (1 - part) * old[k] + part * old[k + 1];
    };

    // Rounding must not lose the last of equally many steps.
    double const reach = static_cast<double>(old_held) * before.step_;
    std::size_t const new_held = std::min(intervals_, static_cast<std::size_t>(reach / step_ * (1 + 1e-12)));
    double const kept = static_cast<double>(new_held) * step_;
    for (std::size_t k = 0; k < old_held; ++k) {
        double const young = std::max(kept, static_cast<double>(k) * before.step_);
        double const aged = static_cast<double>(k + 1) * before.step_;
        if (aged - young < 1e-12 * before.step_) continue;
        for (std::size_t i = 0; i < tails; ++i) {
            Weights const weight = exponential(tail_[i], young, aged - young);
            std::size_t const slot = intervals_ + 1 + i;
            store(state, slot, load(state, slot) + weight.newer * at(young) + weight.older * old[k + 1]);
        }
    }
    for (std::size_t k = 0; k <= intervals_; ++k)
        store(state, k, k <= new_held ? at(static_cast<double>(k) * step_) : math::Vec3{});
    state[0] = static_cast<double>(new_held);
}
}
