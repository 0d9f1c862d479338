// The force of the history of a granule's slip (Basset): a window of recent steps integrated exactly, and ten decaying
// integrals for all that is older.
//
//   F = c I,   I = integral over the past of g(s) / sqrt(t - s) ds,   g = d(u - v)/ds,   c = 3/2 d^2 sqrt(pi rho mu)
//
// In the window of N steps g is a straight line between the ends of steps, and each line is integrated against the
// kernel exactly. Beyond it the kernel is replaced by a sum of ten exponentials, so that each integral goes on by a
// recursion. The sum is within 0.7 % of the kernel from half a window to 100 windows of age, within 1.4 % to 500
// and 11 % to 10 000: choose a window of at least a twentieth of the granule's response time.
//
// The step is implicit in the newest g. With everything else in R, m dv/dt = R + c I, and
// I = newest() g + known(state):
//   dv/dt = (R + c (newest() du/dt + known)) / (m + c newest()),   then advance(state, du/dt - dv/dt).
// Collisions jerk g; a step that does not resolve them sees only their mean.
//
// Source: van Hinsberg, ten Thije Boonkkamp, Clercx, J. Comput. Phys. 230 (2011) 1465: times and weights of the
// exponentials compared with public codes that hold them; the recursion derived anew.
#pragma once

#include "granum/base/type_list.hpp"
#include "granum/math/vec3.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace granum::law::force
{
//! c of F = c I, kg/s^0.5: diameter of the real granule, m; density, kg/m3, and viscosity, Pa s, of the gas.
double basset_coefficient(double diameter, double density, double viscosity);

//! The window and its weights, which all granules with the same step share. The state of one granule, `size()` doubles:
//!   0                     steps that the window holds by now, 0 to N
//!   1 + 3 k + i           component i of g at k steps ago, m/s2, k = 0 to N
//!   1 + 3 (N + 1 + j) + i component i of the tail integral j, m/s^1.5, j = 0 to 9
//! All zeros is the state of a granule whose slip has not changed before now.
class BassetWindow
{
  public:
    static constexpr base::Card card{
        .name = "basset",
        .title = "Basset, by a window and ten exponentials",
        .source =
            "Basset, A Treatise on Hydrodynamics 2 (1888) (recalled); van Hinsberg, ten Thije Boonkkamp, Clercx, "
            "J. Comput. Phys. 230 (2011) 1465 (coefficients compared with public codes)",
        .valid = "one sphere, Reynolds number of the slip far below 1; a few per cent of a transient in gas"};
    static constexpr std::size_t tails = 10;

    //! A window of `intervals` >= 1 steps of `step` s.
    BassetWindow(std::size_t intervals, double step);

    std::size_t size() const { return 1 + 3 * (intervals_ + 1 + tails); }
    double step() const { return step_; }

    //! The state of a granule whose history begins now with the change of slip `change`, m/s2.
    void begin(std::span<double> state, math::Vec3 const& change) const;

    //! Weight of the newest g in I one step from now, s^0.5.
    double newest() const;

    //! The rest of I one step from now, m/s^1.5.
    math::Vec3 known(std::span<double const> state) const;

    //! Goes one step on, to where the slip changes at the rate `change`, m/s2.
    void advance(std::span<double> state, math::Vec3 const& change) const;

    //! The same window for steps of another length: as many of them, and the same exponentials, so that a state can be
    //! carried over by `resample`. From half the first step to several times it the force stays within a per cent;
    //! for a lasting change beyond that build a new window and begin anew.
    BassetWindow with_step(double step) const;

    //! Carries a state of `before`, a window that differs from this one in its step alone, over: g at the ends of the
    //! new steps is read from the lines between the old ones, and what the new window does not reach goes to the tails.
    //! Where it reaches farther than the old one it is filled by the steps to come.
    void resample(std::span<double> state, BassetWindow const& before) const;

  private:
    struct Weights
    {
        double newer, older;  //!< of g at the ends of an interval
    };
    struct Tail
    {
        double rate;    //!< of decay, 1/s
        double weight;  //!< of the exponential, 1/s^0.5
    };

    std::size_t held(std::span<double const> state) const { return static_cast<std::size_t>(state[0]); }
    static Weights exponential(Tail const& tail, double age, double length);
    void set_step(double step);

    std::size_t intervals_;
    double step_ = 0;
    std::vector<Weights> window_;  //!< of the interval from j to j + 1 steps ago, s^0.5
    std::array<Tail, tails> tail_{};
    std::array<double, tails> decay_{};     //!< of a tail over a step
    std::array<Weights, tails> leaving_{};  //!< of the interval that leaves a full window, s^0.5
};
}
