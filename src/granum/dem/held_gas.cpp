#include "granum/dem/held_gas.hpp"

#include <algorithm>

namespace granum::dem
{
using particle::Store;

namespace
{
double moving_mass(Store const& granules, std::size_t row)
{
    return granules.mass[row] + (granules.groups.added_mass ? granules.added_mass[row] : 0);
}

double inertia(Store const& granules, std::size_t row)
{
    return 0.4 * granules.mass[row] * granules.radius[row] * granules.radius[row];
}

// A of the equations of motion; g to the bit where there is no gas.
Vec3 steady(Store const& granules, std::size_t row, double mass, double inverse_mass, Vec3 const& gravity)
{
    double const own = granules.mass[row], weight = mass == own ? 1 : own * inverse_mass;
    return weight * gravity + inverse_mass * granules.gas_force[row];
}

bool acts_on(Store const& granules, std::size_t row)
{
    return granules.drag_rate[row] != 0 || granules.gas_force[row] != Vec3{} ||
           (granules.groups.added_mass && granules.added_mass[row] != 0);
}

bool acts(Store const& granules)
{
    if (!granules.groups.gas) return false;
    for (std::size_t row = 0; row < granules.owned; ++row)
        if (acts_on(granules, row)) return true;
    return false;
}

bool has_spins(Store const& granules)
{
    return granules.groups.gas && granules.groups.turning;
}

bool turns(Store const& granules)
{
    if (!has_spins(granules)) return false;
    auto const first = granules.spin_rate.values.begin();
    return std::any_of(first, first + static_cast<std::ptrdiff_t>(granules.owned),
                       [](double rate) { return rate != 0; });
}

kernel::Drag drag_of(double rate, Vec3 const& towards, Vec3 const& pull, double push, double half)
{
    double const left = 1 / (1 + half * rate), share = half * rate * left;
    Vec3 const sum = share * towards + left * (half * pull);
    return {.pull = {sum.x, sum.y, sum.z}, .share = share, .given = {}, .push = push};
}

void set(double* to, Vec3 const& from)
{
    to[0] = from.x, to[1] = from.y, to[2] = from.z;
}
Vec3 given(kernel::Drag const& drag)
{
    return {drag.given[0], drag.given[1], drag.given[2]};
}
}

void HeldGas::begin(Store const& granules, Vec3 const& gravity, double half)
{
    gravity_ = gravity;
    half_ = half;
    load(granules, true);
}

// The columns of the impulses hold impulses `at_first`, else sums of what was given.
void HeldGas::load(Store const& granules, bool at_first)
{
    bool const turning = turns(granules);
    velocities_.resize(turning || acts(granules) ? granules.owned : 0);
    spins_.resize(turning ? granules.owned : 0);
    for (std::size_t row = 0; row < velocities_.size(); ++row) {
        double const rate = granules.drag_rate[row], mass = moving_mass(granules, row), inverse_mass = 1 / mass;
        auto& drag = velocities_[row];
        drag = drag_of(rate, granules.gas_velocity[row], steady(granules, row, mass, inverse_mass, gravity_),
                       half_ * inverse_mass, half_);
        if (rate != 0) set(drag.given, (at_first ? inverse_mass : 1) * granules.drag_impulse[row]);
    }
    for (std::size_t row = 0; row < spins_.size(); ++row) {
        double const rate = granules.spin_rate[row], radius = granules.radius[row];
        // As the motion without gas has it, to the bit.
        double const push = half_ * 2.5 * (1 / granules.mass[row]) / (radius * radius);
        auto& drag = spins_[row];
        drag = drag_of(rate, granules.gas_spin[row], {}, push, half_);
        if (rate != 0) set(drag.given, (at_first ? push / half_ : 1) * granules.spin_impulse[row]);
    }
}

void HeldGas::keep(Store& granules) const
{
    for (std::size_t row = 0; row < velocities_.size(); ++row)
        if (granules.drag_rate[row] != 0) granules.drag_impulse[row] = given(velocities_[row]);
    for (std::size_t row = 0; row < spins_.size(); ++row)
        if (granules.spin_rate[row] != 0) granules.spin_impulse[row] = given(spins_[row]);
}

void HeldGas::end(Store& granules, int kicks) const
{
    double const time = kicks * half_;
    for (std::size_t row = 0; row < velocities_.size(); ++row) {
        if (granules.drag_rate[row] == 0) continue;
        double const mass = moving_mass(granules, row);
        granules.drag_impulse[row] =
            mass * (given(velocities_[row]) - time * steady(granules, row, mass, 1 / mass, gravity_));
    }
    for (std::size_t row = 0; row < spins_.size(); ++row)
        if (granules.spin_rate[row] != 0) granules.spin_impulse[row] = inertia(granules, row) * given(spins_[row]);
}

void HeldGas::give_at_rest(Store& granules, double time)
{
    for (std::size_t row = 0; row < granules.owned && granules.groups.gas; ++row)
        granules.drag_impulse[row] += (moving_mass(granules, row) * granules.drag_rate[row] * time) *
                                      (granules.gas_velocity[row] - granules.velocity[row]);
    for (std::size_t row = 0; row < granules.owned && has_spins(granules); ++row)
        granules.spin_impulse[row] +=
            (inertia(granules, row) * granules.spin_rate[row] * time) * (granules.gas_spin[row] - granules.spin[row]);
}
}
