// The force of the history: a sphere released from rest against its Laplace transform, the kernel against 1/sqrt(t),
// and steps that change on the way.
#include "granum/law/force/basset.hpp"
#include "granum/math/constants.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace
{
using namespace granum;
using law::force::BassetWindow;
using math::Vec3;

// A sphere in a liquid at rest, pushed by a constant force from rest: Stokes' drag, half the virtual mass, Basset.
class Sphere
{
  public:
    //! kappa = 9 rho / (2 rho_p + rho); times in units of tau = (2 rho_p + rho) a^2 / (9 mu).
    Sphere(double kappa, BassetWindow const& window) : window_(window), state_(window.size())
    {
        double const d = 1e-3, a = d / 2, viscosity = 1e-3, volume = math::pi / 6 * d * d * d;
        density_ = kappa > 0 ? 1000.0 : 0.0;
        double const twice = kappa > 0 ? 9 * density_ / kappa : 9000;  // 2 rho_p + rho
        double const particle = (twice - density_) / 2;
        tau_ = twice * a * a / (9 * viscosity);
        stokes_ = 3 * math::pi * viscosity * d;
        mass_ = (particle + 0.5 * density_) * volume;
        history_ = law::force::basset_coefficient(d, density_, viscosity);
        push_ = stokes_;  // terminal speed 1 m/s
        change_ = push_ / mass_;
        window_.begin(state_, {0, 0, -change_});
    }

    double tau() const { return tau_; }
    double speed() const { return speed_; }

    void go(double step)
    {
        Vec3 const known = window_.known(state_);
        double const half = speed_ + 0.5 * step * change_;
        // The slip is -v: the force on the granule is history (newest g + known), g = -dv/dt; drag at the new speed.
        change_ = (push_ - stokes_ * half + history_ * known.z) /
                  (mass_ + 0.5 * step * stokes_ + history_ * window_.newest());
        speed_ = half + 0.5 * step * change_;
        window_.advance(state_, {0, 0, -change_});
    }

    void take(BassetWindow const& window)
    {
        window.resample(state_, window_);
        window_ = window;
    }

  private:
    BassetWindow window_;
    std::vector<double> state_;
    double density_, tau_, stokes_, mass_, history_, push_, speed_ = 0, change_;
};

struct Row
{
    double kappa;
    std::array<double, 6> speed;  // over the terminal speed at `times`
};
constexpr std::array<double, 6> times{0.1, 0.5, 1, 2, 5, 10};  // over tau
// U(s) = 1 / (s (s + sqrt(kappa s) + 1)), inverted numerically by an independent program.
constexpr std::array<Row, 5> released{{{0, {0.09516, 0.39347, 0.63212, 0.86466, 0.99326, 0.99995}},
                                       {0.01, {0.09301, 0.37626, 0.59922, 0.81935, 0.95970, 0.97970}},
                                       {0.5, {0.08163, 0.29620, 0.45445, 0.62248, 0.79051, 0.86324}},
                                       {1, {0.07700, 0.26821, 0.40676, 0.55811, 0.72683, 0.81308}},
                                       {3, {0.06731, 0.21649, 0.32205, 0.44375, 0.60342, 0.70603}}}};

double tau_of(double kappa)
{
    return Sphere(kappa, BassetWindow(1, 1)).tau();
}

TEST(Basset, lets_a_sphere_speed_up_as_the_closed_form)
{
    for (auto const& row : released) {
        double const step = 0.005 * tau_of(row.kappa);
        Sphere sphere(row.kappa, BassetWindow(50, step));
        int done = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            for (; done < std::lround(times[i] / 0.005); ++done) sphere.go(step);
            EXPECT_NEAR(sphere.speed(), row.speed[i], 2.5e-4) << "kappa " << row.kappa << ", time " << times[i];
        }
    }
}

TEST(Basset, does_so_with_a_window_of_a_few_steps)
{
    for (auto const& row : released) {
        double const step = 0.01 * tau_of(row.kappa);
        Sphere sphere(row.kappa, BassetWindow(20, step));
        int done = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            for (; done < std::lround(times[i] / 0.01); ++done) sphere.go(step);
            EXPECT_NEAR(sphere.speed(), row.speed[i], 0.01 * row.speed[i]) << "kappa " << row.kappa << " " << times[i];
        }
    }
}

TEST(Basset, goes_on_through_steps_that_change)
{
    // Up and down between half and twice the first step, at uneven times, before, while and after the window fills.
    for (auto const& row : released) {
        double const tau = tau_of(row.kappa), first = 0.005 * tau;
        BassetWindow const window(40, first);
        Sphere sphere(row.kappa, window);
        std::array<double, 5> const lengths{1, 0.5, 1.7, 2, 0.8};
        double now = 0;
        std::size_t change = 0;
        for (std::size_t i = 0; i < times.size(); ++i)
            while (now < times[i] * tau * (1 - 1e-9)) {
                double const left = times[i] * tau - now;
                double const wanted = lengths[change++ % lengths.size()] * first;
                // Seventeen steps of each length, or what is left in steps of nearly that length.
                long const fit = std::max(1L, std::lround(left / wanted)), count = std::min(17L, fit);
                double const step = fit <= 17 ? left / static_cast<double>(fit) : wanted;
                sphere.take(window.with_step(step));
                for (long k = 0; k < count; ++k) sphere.go(step);
                now += step * static_cast<double>(count);
                if (count < fit) continue;
                EXPECT_NEAR(sphere.speed(), row.speed[i], 0.01 * row.speed[i])
                    << "kappa " << row.kappa << ", time " << times[i];
            }
    }
}

// The kernel that a state sees: g is a peak of area 1 m/s and two steps wide, long ago.
TEST(Basset, has_the_kernel_of_the_source)
{
    double const step = 1e-3;
    std::size_t const intervals = 50;
    BassetWindow const window(intervals, step);
    std::vector<double> state(window.size());
    window.advance(state, {1 / step, 0, 0});
    double age = step;  // of the peak at the time of which `known` tells
    auto const relative = [&](double windows) {
        for (; age < (windows * static_cast<double>(intervals) - 0.5) * step; age += step) window.advance(state, {});
        return window.known(state).x * std::sqrt(age) - 1;
    };
    EXPECT_NEAR(relative(0.5), 0, 3e-4);  // within the window only the width of the peak is seen
    // Ten exponentials over the kernel, summed by an independent program.
    EXPECT_NEAR(relative(2), -6.3e-4, 3e-5);
    EXPECT_NEAR(relative(10), -2.2e-3, 1e-4);
    EXPECT_NEAR(relative(100), -5.8e-3, 1e-4);
    EXPECT_NEAR(relative(1000), -3.3e-2, 1e-3);
    EXPECT_NEAR(relative(10000), -1.0e-1, 5e-3);
}

TEST(Basset, integrates_a_ramp_exactly_within_the_window_and_weighs_the_newest_step)
{
    // g = s from s = 0: the integral of s / sqrt(t - s) is 4/3 t^1.5.
    double const step = 0.02;
    BassetWindow const window(30, step);
    EXPECT_NEAR(window.newest(), 4.0 / 3 * std::sqrt(step), 1e-15);
    std::vector<double> state(window.size());
    for (int k = 1; k <= 30; ++k) {
        double const now = k * step, integral = window.newest() * now + window.known(state).y;
        EXPECT_NEAR(integral, 4.0 / 3 * std::pow(now, 1.5), 1e-12) << k;
        window.advance(state, {0, now, 0});
    }
}

TEST(Basset, keeps_a_state_that_is_carried_to_the_same_step)
{
    BassetWindow const window(8, 0.1), again = window.with_step(0.1);
    std::vector<double> state(window.size());
    for (int k = 0; k < 40; ++k) window.advance(state, {std::sin(0.3 * k), std::cos(0.2 * k), 0.1 * k});
    auto const before = state;
    again.resample(state, window);
    for (std::size_t i = 0; i < state.size(); ++i) EXPECT_NEAR(state[i], before[i], 1e-13) << i;
}

TEST(Basset, knows_a_smooth_past_whatever_steps_it_was_cut_into)
{
    auto const change = [](double time) { return std::sin(3 * time) + 0.3 * time; };
    BassetWindow const window(40, 0.01);
    for (double const other : {0.005, 0.0073, 0.02}) {
        std::vector<double> state(window.size());
        window.begin(state, {change(0), 0, 0});
        double now = 0;
        for (int k = 0; k < 300; ++k) window.advance(state, {change(now += 0.01), 0, 0});
        BassetWindow const next = window.with_step(other);
        next.resample(state, window);
        for (int k = 0; k < 20; ++k) next.advance(state, {change(now += other), 0, 0});
        now += other;
        double const found = next.newest() * change(now) + next.known(state).x;
        // The integral itself, by the midpoint rule in the root of the age.
        double expected = 0;
        int const parts = 100000;
        double const width = std::sqrt(now) / parts;
        for (int i = 0; i < parts; ++i) expected += 2 * width * change(now - std::pow((i + 0.5) * width, 2));
        EXPECT_NEAR(found, expected, 3e-3 * std::abs(expected)) << "step " << other;
    }
}
}
